"""Recompute the flights of a finished run from the table of its events."""

import math
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, inlined_source
from vibroimpact.exact.engine.contact import common_velocity
from vibroimpact.exact.engine.flow import advance
from vibroimpact.exact.engine.motion import APPROACH, PHASE, drift_balls, mode_of, pair, with_velocity
from vibroimpact.exact.engine.phase import TWO_PI, advance_phase
from vibroimpact.system.state import IMPACT, RELEASE, STICK

LENGTH, WALLS, FORCING, BEFORE, AFTER, COLUMNS = 0, 1, 3, 4, 12, 20
"""Indices in a flight's row: its length, the wall (or 0) that each ball sticks to, the forcing phase and the state (8,)
at its start, the state (8,) at its end. States are ordered [boxes, balls]."""


@compiled
def replayed(flow, start, events, start_phase, duration):
    """Return the flights of a run, rows (m + 1, COLUMNS): one before each event and one to the end.

    The events are rows of the log; start (8,) is in public order. The flight before the stick that completes a chatter
    is empty, because the stick is applied at the last impact of the chatter, ahead of its time.
    """
    flights = departures(flow.coefficients, start, events, start_phase, duration)
    for n in range(len(flights)):
        land(flow, flights[n])
    return flights


class Departure(NamedTuple):
    """Start of a flight: boxes and balls, the wall (or 0) each ball sticks to, the time and the forcing phase."""

    boxes: tuple[float, float, float, float]
    balls: tuple[float, float, float, float]
    walls: tuple[int, int]
    time: float
    phase: float


@inlined_source
def departures(q, start, events, start_phase, duration):
    """Return the flights of a run (see `replayed`) without the states at their ends."""
    flights = np.zeros((len(events) + 1, COLUMNS))
    leaving = first_departure(start, start_phase)
    for n in range(len(flights)):
        flight = flights[n]
        flight[WALLS], flight[WALLS + 1], flight[FORCING] = leaving.walls[0], leaving.walls[1], leaving.phase
        for k in range(4):
            flight[BEFORE + k], flight[BEFORE + 4 + k] = leaving.boxes[k], leaving.balls[k]
        following = next_departure(q, events, n, leaving, (duration, start_phase))
        flight[LENGTH] = _length(q, following.time - leaving.time, following.phase - leaving.phase)
        leaving = following
    return flights


@inlined
def first_departure(start, phase):
    """Return the first departure of a run from a state (8,), in public order."""
    return Departure(
        (start[0], start[2], start[4], start[6]), (start[1], start[3], start[5], start[7]), (0, 0), 0.0, phase
    )


@inlined
def next_departure(q, events, n, leaving, end):
    """Return the departure after event n; after the last one, with time and phase of the end of the run."""
    if n == len(events):
        return Departure(leaving.boxes, leaving.balls, leaving.walls, end[0], end[1])
    event, walls = events[n], leaving.walls
    i = int(event[1]) - 1
    if event[3] != IMPACT:
        walls = pair(walls, i, int(event[2]) if event[3] == STICK else 0)
    if completes_chatter(events, n):  # box and ball move together from here on
        boxes, balls = leaving.boxes, leaving.balls
        common = common_velocity(q, boxes[2 + i], balls[2 + i])
        boxes, balls = with_velocity(boxes, i, common), with_velocity(balls, i, common)
        return Departure(boxes, balls, walls, leaving.time, leaving.phase)
    boxes, balls = (event[4], event[6], event[8], event[10]), (event[5], event[7], event[9], event[11])
    return Departure(boxes, balls, walls, event[0], event[PHASE])


@inlined_source
def _length(q, lapse, turned):
    """Return the time between two events, as accurate as the difference of their phases."""
    more = turned - q.omega * lapse
    return max(lapse + (more - TWO_PI * math.floor(more / TWO_PI + 0.5)) / q.omega, 0.0)


@inlined_source
def land(flow, flight):
    """Write the state at the end of a flight."""
    boxes, balls, walls = start_of(flight)
    left, phase, tail = flight[LENGTH], flight[FORCING], 0.0
    while left > 0.0:
        t = min(left, flow.longest)
        later, _, _ = advance(flow, mode_of(walls), boxes, math.sin(phase), math.cos(phase), t)
        boxes, balls = later, drift_balls(balls, walls, later, t)
        phase, tail = advance_phase(phase, tail, flow.coefficients.omega, t)
        left -= t
    for k in range(4):
        flight[AFTER + k], flight[AFTER + 4 + k] = boxes[k], balls[k]


@inlined
def start_of(flight):
    """Return (boxes, balls, walls) at the start of a flight."""
    s = flight[BEFORE:AFTER]
    return (s[0], s[1], s[2], s[3]), (s[4], s[5], s[6], s[7]), (int(flight[WALLS]), int(flight[WALLS + 1]))


@inlined
def end_of(flight):
    """Return (boxes, balls) at the end of a flight."""
    s = flight[AFTER:]
    return (s[0], s[1], s[2], s[3]), (s[4], s[5], s[6], s[7])


@inlined
def completes_chatter(events, n):
    """Return True if event n is the stick that completes a chatter, recorded at its last impact."""
    return events[n, 3] == STICK and events[n, APPROACH] > 0.0


@inlined
def walls_after(events, n, walls):
    """Return the walls that the balls stick to after all events at the instant of event n."""
    for k in range(n + 1, len(events)):
        if events[k, 0] != events[n, 0]:
            break
        if events[k, 3] == RELEASE:
            walls = pair(walls, int(events[k, 1]) - 1, 0)
    return walls
