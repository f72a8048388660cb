"""The course of a run: the flights between its events, flown once more for those who ask what happened on the way."""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, unfolded
from vibroimpact.exact.engine.event_log import APPROACH, PHASE
from vibroimpact.exact.engine.flow import advance
from vibroimpact.exact.engine.motion import carry, mode_of, pair
from vibroimpact.exact.engine.phase import TWO_PI, ahead
from vibroimpact.system.state import IMPACT, RELEASE, STICK

LENGTH, WALLS, FORCING, BEFORE, AFTER, COLUMNS = 0, 1, 3, 4, 12, 20
"""Places in a flight's row: its length, the wall (or 0) each ball sticks to, the forcing phase and the state (8,) at
its start, the state (8,) at its end. States are ordered [boxes, balls]."""


@compiled
def replayed(flow, start, events, start_phase, duration):
    """The flights of a run, rows (m + 1, COLUMNS): one before each of its events (rows of the log), one to its end.

    start (8,) in public order. The flight before the stick that completes a chatter is empty: it is carried out at the
    chatter's last impact, ahead of the time it ends.
    """
    flights = departures(flow.coefficients, start, events, start_phase, duration)
    for n in range(len(flights)):
        land(flow, flights[n])
    return flights


@unfolded
def departures(q, start, events, start_phase, duration):
    """The flights of a run (see `replayed`) without the states at their ends."""
    flights = np.zeros((len(events) + 1, COLUMNS))
    state, walls, now, phase = np.empty(8), (0, 0), 0.0, start_phase
    to_internal(start, state)
    for n in range(len(flights)):
        flight = flights[n]
        flight[WALLS], flight[WALLS + 1] = walls
        flight[FORCING] = phase
        _put(state, flight, BEFORE)
        completes = n < len(events) and completes_chatter(events, n)
        if not completes:
            stop = events[n, 0] if n < len(events) else duration
            there = events[n, PHASE] if n < len(events) else start_phase
            flight[LENGTH] = _length(q, stop - now, there - phase)
            now, phase = stop, there
        if n == len(events):
            break
        i, wall, kind = int(events[n, 1]) - 1, int(events[n, 2]), events[n, 3]
        if kind != IMPACT:
            walls = pair(walls, i, wall if kind == STICK else 0)
        if completes:  # box and ball go on together
            state[2 + i] = state[6 + i] = (state[2 + i] + q.epsilon * state[6 + i]) * q.inverse_mass
        else:
            to_internal(events[n, 4:PHASE], state)
    return flights


@unfolded
def _length(q, lapse, turned):
    """The time between two events: a difference of times, with the digits that the difference of phases has."""
    more = turned - q.omega * lapse
    return max(lapse + (more - TWO_PI * math.floor(more / TWO_PI + 0.5)) / q.omega, 0.0)


@unfolded
def land(flow, flight):
    """Fill in the state at the end of a flight."""
    boxes, balls, walls = start_of(flight)
    left, phase, tail = flight[LENGTH], flight[FORCING], 0.0
    while left > 0.0:
        t = min(left, flow.longest)
        later, _, _ = advance(flow, mode_of(walls), boxes, math.sin(phase), math.cos(phase), t)
        boxes, balls = later, carry(balls, walls, later, t)
        phase, tail = ahead(phase, tail, flow.coefficients.omega, t)
        left -= t
    for k in range(4):
        flight[AFTER + k], flight[AFTER + 4 + k] = boxes[k], balls[k]


@inlined
def _put(state, flight, place):
    for k in range(8):
        flight[place + k] = state[k]


@inlined
def start_of(flight):
    """(boxes, balls, walls) at the start of a flight."""
    s = flight[BEFORE:AFTER]
    return (s[0], s[1], s[2], s[3]), (s[4], s[5], s[6], s[7]), (int(flight[WALLS]), int(flight[WALLS + 1]))


@inlined
def end_of(flight):
    """(boxes, balls) at the end of a flight."""
    s = flight[AFTER:]
    return (s[0], s[1], s[2], s[3]), (s[4], s[5], s[6], s[7])


@inlined
def completes_chatter(events, n):
    """Whether event n is the stick that completes a chatter, noted at the chatter's last impact."""
    return events[n, 3] == STICK and events[n, APPROACH] > 0.0


@inlined
def walls_after(events, n, walls):
    """Walls that the balls stick to once all that happens in the instant of event n is done, releases that is."""
    for k in range(n + 1, len(events)):
        if events[k, 0] != events[n, 0]:
            break
        if events[k, 3] == RELEASE:
            walls = pair(walls, int(events[k, 1]) - 1, 0)
    return walls


@inlined
def to_internal(public, state):
    """Write a public state (8,) in the order [boxes, balls]."""
    for k in range(4):
        state[k], state[4 + k] = public[2 * k], public[2 * k + 1]
