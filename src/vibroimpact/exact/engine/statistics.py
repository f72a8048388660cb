"""Summary statistics after a transient: impacts, displacements of the boxes, speeds of the balls."""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import in_place, inlined, inlined_source
from vibroimpact.exact.engine.energy import add_potential_drops, add_potentials, energy_stored, impact_loss
from vibroimpact.exact.engine.flow import half_curvature, jet_at, slope, value
from vibroimpact.exact.engine.motion import (
    APPROACH,
    COSINE,
    KIND,
    MODULE,
    SINE,
    TIME,
    Motion,
    free_flight,
    mode_of,
    with_velocity,
)
from vibroimpact.exact.engine.replay import next_departure
from vibroimpact.system.state import IMPACT, STICK

IMPACTS, STICKS, LARGEST, LOST, STORED, PATH, INTEGRALS, STATISTICS = 0, 2, 4, 6, 8, 9, 11, 18
"""Indices of the statistics of a run: for each module impacts, sticks, the largest |X_i| and the energy lost in
impacts; the change of the stored energy; the length of each ball's path; integrals (`energy.OBSERVED`); their
number."""

PIECE = 4  # spacings of the flow table, over which a box turns at most once, except for 1e-5 of its path
STEPS = 4  # Newton steps to find a turn
NODES, WEIGHTS = (tuple(part.tolist()) for part in np.polynomial.legendre.leggauss(8))


@in_place
def accumulate_statistics(flow, squares, departure, events, count, arrival, statistics):
    """Add the statistics of a piece of a run to statistics (STATISTICS,), without the potentials at its ends.

    departure: start of the piece (`replay.Departure`); events, count: its rows; arrival: boxes, time and phase at its
    end.
    """
    leaving, (final, time, phase) = departure, arrival
    early, last = (math.sin(leaving.phase), math.cos(leaving.phase)), (math.sin(phase), math.cos(phase))
    for n in range(count + 1):
        following = next_departure(flow.coefficients, events[:count], n, leaving, (time, phase))
        left, end, late = following.time - leaving.time, final, last
        if n < count:
            _count(flow.coefficients, events[n], statistics)
            end = _before(flow.coefficients, following.boxes, events[n]) if left > 0.0 else leaving.boxes
            late = events[n, SINE], events[n, COSINE]
        if left > 0.0:
            motion = Motion(leaving.boxes, leaving.balls, leaving.walls, (0, 0), early[0], early[1])
            _watch(flow, squares, motion, end, left, statistics)
        if n < count:
            before, after = (mode_of(leaving.walls), end), (mode_of(following.walls), following.boxes)
            add_potential_drops(squares, before, after, late, statistics[INTEGRALS:])
        leaving, early = following, late


@inlined
def rests_at_start(events, n):
    """Return True if event n is the stick of a ball at rest on its wall at the start of the run."""
    first = events[n, TIME] == 0.0 and events[n, KIND] == STICK
    for k in range(n):
        first = first and events[k, MODULE] != events[n, MODULE]
    return first


@inlined
def discount_rests(events, count, statistics):
    """Subtract the sticks at the start of a run that continues another one, which counted them already."""
    for n in range(count):
        if rests_at_start(events, n):
            statistics[STICKS + int(events[n, MODULE]) - 1] -= 1.0


@inlined
def open_or_close(flow, squares, motion, sign, statistics):
    """Begin (sign -1) or end (+1) an observation: add the terms that depend on its ends alone."""
    boxes, q = motion.boxes, flow.coefficients
    add_potentials(squares, mode_of(motion.walls), boxes, motion.sine, motion.cosine, sign, statistics[INTEGRALS:])
    statistics[STORED] += sign * energy_stored(q.ground, -q.k12, q.epsilon, boxes, motion.balls)
    for i in range(2):
        statistics[LARGEST + i] = max(statistics[LARGEST + i], abs(boxes[i]))


@inlined
def _count(q, event, statistics):
    module = int(event[1]) - 1
    if event[3] == IMPACT:
        statistics[IMPACTS + module] += 1
    elif event[3] == STICK:
        statistics[STICKS + module] += 1
    statistics[LOST + module] += impact_loss(q.epsilon, q.kappa if event[3] == IMPACT else 0.0, event[APPROACH])


@inlined
def _before(q, boxes, event):
    """Return the boxes before an event, from the boxes after it."""
    if event[3] != IMPACT:
        return boxes
    i = int(event[1]) - 1
    return with_velocity(boxes, i, boxes[2 + i] + (1.0 + q.kappa) * q.epsilon * q.inverse_mass * event[APPROACH])


@inlined_source
def _watch(flow, squares, motion, end, length, statistics):
    """Add the statistics of a flight, except for the potentials at its ends."""
    mode = mode_of(motion.walls)
    for i in range(2):
        statistics[LARGEST + i] = max(statistics[LARGEST + i], abs(motion.boxes[i]), abs(end[i]))
        statistics[PATH + i] += abs(motion.balls[2 + i]) * length if motion.walls[i] == 0 else 0.0
    for k in range(squares.drifts.shape[1]):
        statistics[INTEGRALS + k] += squares.drifts[mode, k] * length
    last, piece = len(flow.rotations) - 1, PIECE * flow.spacing
    while length > 0.0:
        whole, start, j = min(length, flow.longest), 0.0, PIECE // 2
        while start < whole:
            node = min(j, last)
            jets = jet_at(flow, mode, motion.boxes, motion.sine, motion.cosine, node)
            low, high = start - node * flow.spacing, min(start + piece, whole) - node * flow.spacing
            _add_piece(jets[0], low, high, 0, motion.walls[0], squares, statistics)
            _add_piece(jets[1], low, high, 1, motion.walls[1], squares, statistics)
            start, j = start + piece, j + PIECE
        motion, length = free_flight(flow, motion, whole), length - whole


@inlined
def _add_piece(p, low, high, i, wall, squares, statistics):
    """Add the statistics of box i between two times of its Taylor polynomial p (8,).

    These are its turn, the path of a ball that sticks to it, and the integral of X_i^2 if no potential gives it.
    """
    x, last, v, w = value(p, low), value(p, high), slope(p, low), slope(p, high)
    path = abs(last - x)
    if v * w < 0.0:
        t = low + (high - low) * v / (v - w)
        for _ in range(STEPS):
            t = min(max(t - slope(p, t) / (2.0 * half_curvature(p, t)), low), high)
        turned = value(p, t)
        path = abs(turned - x) + abs(last - turned)
        statistics[LARGEST + i] = max(statistics[LARGEST + i], abs(turned))
    statistics[PATH + i] += path if wall != 0 else 0.0
    if squares.drifts.shape[1] == 0:
        half = 0.5 * (high - low)
        for k in range(len(NODES)):
            statistics[INTEGRALS + i] += half * WEIGHTS[k] * value(p, low + half * (1.0 + NODES[k])) ** 2
