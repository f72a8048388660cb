"""Compute the statistics of runs in an ensemble: impacts, displacements of boxes, speeds of balls, integrals.

Vector instructions advance eight runs together, one run in each lane. In lanes, the statistics are added up flight by
flight (`observe`). In the event loop, they are added up event by event (`accumulate_statistics`). Integrals, such as
the work of the forces, are differences of potentials (`energy.Squares`).

A turn is an instant at which a box reverses its motion. Bernstein coefficients bound the displacement of the box at a
turn. If the bound exceeds the largest displacement so far, the turn is stored. A later turn with a larger
displacement may replace the stored turn. A computation in one lane makes all lanes wait. Therefore the displacements at
the stored turns are computed for all lanes together (`find_turns`).
"""

import math

from vibroimpact.exact.engine import contact
from vibroimpact.exact.engine.compiled import compiled, in_place, inlined, inlined_source
from vibroimpact.exact.engine.contact import Motion, free_flight, with_velocity
from vibroimpact.exact.engine.energy import SIZE, add_potentials, energy_stored, impact_loss
from vibroimpact.exact.engine.flow import half_curvature, jet_at, mode_of, slope, value
from vibroimpact.exact.engine.variation import first_departure, next_departure
from vibroimpact.exact.engine.vectors import count, fused, load, load_rows, replace_rows, store, where
from vibroimpact.exact.lanes import rows
from vibroimpact.exact.lanes.rows import (
    IMPACTS,
    INTEGRALS,
    LARGEST,
    LOST,
    PATH,
    STATISTICS_AT,
    STORED,
    evaluate,
    expand,
    most,
)
from vibroimpact.system.state import IMPACT

PIECE = 4
"""Length of a piece of a flight, in spacings of the flow table. A box turns at most once in a piece, unless the box is
almost at rest."""
STEPS = 4  # number of Newton steps to find the time at which a box reverses its motion


@compiled
def accumulate_run(flow, squares, start, events, final, end, statistics):
    """Add the statistics of a finished run to `statistics`, shape (STATISTICS,).

    start, final: initial and final state. end: duration of the run, and forcing phase at the end of the run.
    """
    leaving, (duration, phase) = first_departure(start, end[1]), end
    last = Motion(*first_departure(final, phase)[:3], (0, 0), math.sin(phase), math.cos(phase))
    open_or_close(flow, squares, Motion(*leaving[:3], (0, 0), last.sine, last.cosine), -1.0, statistics)
    accumulate_statistics(flow, squares, leaving, events, len(events), (last.boxes, duration, phase), statistics)
    open_or_close(flow, squares, last, 1.0, statistics)


@in_place
def accumulate_statistics(flow, squares, departure, events, count, arrival, statistics):
    """Add the statistics of a part of a run to `statistics`, shape (STATISTICS,).

    The contributions of `open_or_close` are not included.

    departure: `Departure` at the start of the part.
    count: number of events in the part.
    arrival: state of the boxes, time and forcing phase at the end of the part.
    """
    leaving, (final, time, phase) = departure, arrival
    early, last = (math.sin(leaving.phase), math.cos(leaving.phase)), (math.sin(phase), math.cos(phase))
    for n in range(count + 1):
        following = next_departure(flow.coefficients, events[:count], n, leaving, (time, phase))
        left, end, late = following.time - leaving.time, final, last
        if n < count:
            _count(flow.coefficients, events[n], statistics)
            end = _before(flow.coefficients, following.boxes, events[n]) if left > 0.0 else leaving.boxes
            late = events[n, contact.SINE], events[n, contact.COSINE]
        if left > 0.0:
            motion = Motion(leaving.boxes, leaving.balls, leaving.walls, (0, 0), early[0], early[1])
            _add_flight(flow, squares, motion, end, left, statistics)
        if n < count:
            before, after = (mode_of(leaving.walls), end), (mode_of(following.walls), following.boxes)
            _add_potential_drops(squares, before, after, late, statistics[INTEGRALS:])
        leaving, early = following, late


@inlined
def open_or_close(flow, squares, motion, sign, statistics):
    """Add the contributions of the start or the end of an observation to `statistics`.

    sign: -1 at the start, +1 at the end. motion: state at this time.
    """
    boxes, q = motion.boxes, flow.coefficients
    add_potentials(squares, mode_of(motion.walls), boxes, motion.sine, motion.cosine, sign, statistics[INTEGRALS:])
    statistics[STORED] += sign * energy_stored(q.ground, -q.k12, q.epsilon, boxes, motion.balls)
    for i in range(2):
        statistics[LARGEST + i] = max(statistics[LARGEST + i], abs(boxes[i]))


@inlined
def _add_potential_drops(squares, before, after, forcing, sums):
    """Add the decreases of the k potentials at an event to `sums`, shape (k,).

    before, after: contact state and state of the boxes just before and just after the event. forcing: sine and cosine
    of the forcing phase.
    """
    (mode, boxes), (later, others), (sine, cosine) = before, after, forcing
    if mode != later:
        add_potentials(squares, mode, boxes, sine, cosine, 1.0, sums)
        add_potentials(squares, later, others, sine, cosine, -1.0, sums)
        return
    z = (2.0 * others[0], 2.0 * others[1], boxes[2] + others[2], boxes[3] + others[3], 2.0 * sine, 2.0 * cosine)
    for a in range(2, 4):
        change = boxes[a] - others[a]
        if change != 0.0:
            for k in range(squares.drifts.shape[1]):
                total = 0.0
                for b in range(SIZE):
                    total += squares.potentials[mode, k, a, b] * z[b]
                sums[k] += change * total


@inlined
def _count(q, event, statistics):
    module = int(event[1]) - 1
    if event[3] == IMPACT:
        statistics[IMPACTS + module] += 1
    statistics[LOST + module] += impact_loss(q.epsilon, q.kappa if event[3] == IMPACT else 0.0, event[contact.APPROACH])


@inlined
def _before(q, boxes, event):
    """Return the state of the boxes just before an event; `boxes` is their state just after the event."""
    if event[3] != IMPACT:
        return boxes
    i, approach = int(event[1]) - 1, event[contact.APPROACH]
    return with_velocity(boxes, i, boxes[2 + i] + (1.0 + q.kappa) * q.epsilon * q.inverse_mass * approach)


@inlined_source
def _add_flight(flow, squares, motion, end, length, statistics):
    """Add the statistics of a flight of duration `length`.

    The differences of potentials are not included: `open_or_close` and `_add_potential_drops` add them.

    motion: state at the start of the flight. end: state of the boxes at the end of the flight.
    """
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
            _add_piece(jets[0], low, high, 0, motion.walls[0], statistics)
            _add_piece(jets[1], low, high, 1, motion.walls[1], statistics)
            start, j = start + piece, j + PIECE
        motion, length = free_flight(flow, motion, whole), length - whole


@inlined
def _add_piece(p, low, high, i, wall, statistics):
    """Update the statistics of module i for a piece of a flight, between the times `low` and `high`.

    p: Taylor coefficients of the position of box i, shape (8,). wall: wall to which ball i sticks, or 0.
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


@inlined
def observe(runs, c, work, integrals, flight, hits, early, arrival):
    """Update the statistics in `runs` for each flight that ends in this pass and for the impact at its end.

    flight: tuple of four entries: mask of the lanes in which a flight ends, duration of the last step of the flight,
    duration of the whole flight, and five times the error bound of Hermite's polynomial.
    hits: for each module, mask of the lanes in which the flight ends with an impact in this module.
    early: state of the boxes, and sine and cosine of the forcing phase, at the start of the last step.
    arrival: numbers at the end of the flight: box positions, box velocities before and after the impact, ball
    velocities before the impact, and sine and cosine of the forcing phase.
    """
    (there, t, time, wrong), (boxes, late, after, balls, forcing) = flight, arrival
    watched, third = (load(runs, rows.WATCHED) > 0.0) & there, t * (1 / 3)
    for i in range(2):
        hit, row, approach = watched & hits[i], STATISTICS_AT + LARGEST + i, late[i] - balls[i]
        _add(runs, hit, IMPACTS + i, 1.0)
        _add(runs, hit, LOST + i, load(c, rows.LOSS) * (approach * approach))
        _add(runs, watched, PATH + i, abs(balls[i]) * time)
        replace_rows(runs, row, watched, (most(abs(boxes[i]), load(runs, row)),))
    record = load_rows(runs, STATISTICS_AT + LARGEST, 2)
    turns1 = watched & may_turn_beyond(record[0] - wrong, early[0], early[2], boxes[0], late[0], third)
    turns2 = watched & may_turn_beyond(record[1] - wrong, early[1], early[3], boxes[1], late[1], third)
    if count(turns1 | turns2) > 0:
        keep_turns(runs, c, work, (turns1, turns2), wrong, early, (*boxes, *late, *forcing), t)
    z = 2.0 * boxes[0], 2.0 * boxes[1], late[0] + after[0], late[1] + after[1], 2.0 * forcing[0], 2.0 * forcing[1]
    change = where(hits[0], late[0] - after[0], where(hits[1], late[1] - after[1], 0.0))
    for k in range(integrals):
        place, drop = rows.DROPS + 12 * k, 0.0 * t
        for m in range(6):
            drop = fused(where(hits[0], load(c, place + m), load(c, place + 6 + m)), z[m], drop)
        _add(runs, watched, INTEGRALS + k, fused(change, drop, load(c, rows.DRIFTS + k) * time))


@inlined
def _add(runs, mask, place, value):
    row = STATISTICS_AT + place
    store(runs, row, load(runs, row) + where(mask, value, 0.0))


@inlined
def may_turn_beyond(record, x, v, later, v_later, third):
    """Return True in lanes where a box reverses its motion and a middle Bernstein coefficient exceeds `record`.

    The coefficients are those of the displacement of the box in a step. Their magnitudes are compared with `record`.

    record: largest displacement so far, minus an error margin.
    x, v: position and velocity of the box before the step.
    later, v_later: position and velocity of the box after the step.
    third: a third of the duration of the step.
    """
    return (v * v_later < 0.0) & (most(abs(fused(third, v, x)), abs(fused(-third, v_later, later))) > record)


@inlined
def keep_turns(runs, c, work, turns, wrong, early, late, step):
    """Store the turns (turning points of a box) at which the displacement may be the largest so far.

    turns: for each box, mask of the lanes in which the box has such a turn in this step.
    wrong: five times the error bound of Hermite's polynomial.
    early, late: state of the boxes, and sine and cosine of the forcing phase, before and after the step.
    step: duration of the step.
    """
    wrong = 0.2 * wrong
    for i in range(2):
        x, v, y, w, row = early[i], early[2 + i], late[i], late[2 + i], rows.TURNS_AT + rows.TURN * i
        # Hermite's polynomial is split near the turn, since the coefficients of its parts give closer bounds.
        part, p, q = v / (v - w), fused(step * (1 / 3), v, x), fused(step * (-1 / 3), w, y)
        first, middle, last = fused(part, p - x, x), fused(part, q - p, p), fused(part, y - q, q)
        before, after = fused(part, middle - first, first), fused(part, last - middle, middle)
        ends, corners = most(abs(x), abs(y)), most(abs(first), abs(last))
        highest = most(most(ends, corners), most(abs(before), abs(after))) + wrong
        turned = turns[i] & (highest > load(runs, STATISTICS_AT + LARGEST + i))
        if count(turned) == 0:
            continue
        lowest = abs(fused(part, after - before, before)) - wrong
        # If the displacement at a stored turn may exceed that at the new turn, compute it at all stored turns first.
        if count(turned & (load(runs, row + rows.KEPT) > 0.0) & (load(runs, row + rows.HIGHEST) > lowest)) > 0:
            find_turns(runs, c, work)
        is_late, record = part > 0.5, load(runs, STATISTICS_AT + LARGEST + i)
        for k in range(6):
            replace_rows(runs, row + k, turned, (where(is_late, late[k], early[k]),))
        since = step * where(is_late, part - 1.0, part)
        # The three values belong to the rows SINCE, HIGHEST and KEPT.
        replace_rows(runs, row + rows.SINCE, turned, (since, highest, 1.0))
        replace_rows(runs, STATISTICS_AT + LARGEST + i, turned, (most(record, lowest),))


@in_place
def find_turns(runs, c, work):
    """Compute the displacements of the boxes at the stored turns, and update the largest displacements.

    A turn is a time at which a box reverses its motion.
    """
    for i in range(2):
        row, first = rows.TURNS_AT + rows.TURN * i, rows.SECOND * i
        kept = load(runs, row + rows.KEPT) > 0.0
        if count(kept) > 0:
            x1, x2, v1, v2, s, k = load_rows(runs, row, 6)
            expand(c, x1, x2, v1, v2, s, k, work)
            t = load(runs, row + rows.SINCE)
            for _ in range(2):
                later = t - _slope(work, first, t) / _bend(work, first, t)
                t = where(abs(later) <= load(c, rows.STEP), later, t)
            value, slope = evaluate(work, first, t)
            # The parabola with this value, slope and curvature has its vertex at the turn.
            turned = abs(value - 0.5 * slope * slope / _bend(work, first, t))
            record = load(runs, STATISTICS_AT + LARGEST + i)
            replace_rows(runs, STATISTICS_AT + LARGEST + i, kept & (turned > record), (turned,))
            store(runs, row + rows.KEPT, 0.0)


@inlined
def _slope(work, first, t):
    """Return the derivative of a polynomial at t, without the terms above the order `rows.TERMS`.

    The coefficients of the polynomial are in the rows of `work` from row `first` on.
    """
    total = 0.0 * t
    for m in range(rows.TERMS, 0, -1):
        total = fused(total, t, m * load(work, first + m))
    return total


@inlined
def _bend(work, first, t):
    """Return the second derivative of a polynomial at t, without the terms above the order `rows.TERMS`.

    The coefficients of the polynomial are in the rows of `work` from row `first` on.
    """
    total = 0.0 * t
    for m in range(rows.TERMS, 1, -1):
        total = fused(total, t, m * (m - 1.0) * load(work, first + m))
    return total
