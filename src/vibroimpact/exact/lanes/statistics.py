"""Compute the statistics of runs in an ensemble: impacts, displacements of boxes, speeds of balls, integrals.

Lanes add up statistics flight by flight (`observe`). The event loop adds them up event by event
(`accumulate_statistics`). Integrals, such as the work of the forces, are differences of potentials (`energy.Squares`).

A turn is an instant at which a box reverses its motion. If Bernstein coefficients show that a box may reach its largest
displacement so far at a turn, the turn is stored. A turn with a larger displacement may replace it. The stored turns
are computed for all lanes together (`find_turns`). All lanes would wait if a turn were computed in one.
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
    """Add the statistics of a finished run to `statistics` (STATISTICS,).

    end: duration and final phase of the run.
    """
    leaving, (duration, phase) = first_departure(start, end[1]), end
    last = Motion(*first_departure(final, phase)[:3], (0, 0), math.sin(phase), math.cos(phase))
    open_or_close(flow, squares, Motion(*leaving[:3], (0, 0), last.sine, last.cosine), -1.0, statistics)
    accumulate_statistics(flow, squares, leaving, events, len(events), (last.boxes, duration, phase), statistics)
    open_or_close(flow, squares, last, 1.0, statistics)


@in_place
def accumulate_statistics(flow, squares, departure, events, count, arrival, statistics):
    """Add the statistics of a part of a run to `statistics` (STATISTICS,), except those of `open_or_close`.

    departure: start of the part. count: number of events. arrival: boxes, time and phase at the end.
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
    """Add the statistics due to the start (sign -1) or the end (sign +1) of an observation."""
    boxes, q = motion.boxes, flow.coefficients
    add_potentials(squares, mode_of(motion.walls), boxes, motion.sine, motion.cosine, sign, statistics[INTEGRALS:])
    statistics[STORED] += sign * energy_stored(q.ground, -q.k12, q.epsilon, boxes, motion.balls)
    for i in range(2):
        statistics[LARGEST + i] = max(statistics[LARGEST + i], abs(boxes[i]))


@inlined
def _add_potential_drops(squares, before, after, forcing, sums):
    """Add the decrease of the potentials at an event to sums (k,).

    before, after: (contact state, boxes). forcing: sine and cosine of the phase.
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
    """Return the boxes just before an event, from `boxes` just after it."""
    if event[3] != IMPACT:
        return boxes
    i, approach = int(event[1]) - 1, event[contact.APPROACH]
    return with_velocity(boxes, i, boxes[2 + i] + (1.0 + q.kappa) * q.epsilon * q.inverse_mass * approach)


@inlined_source
def _add_flight(flow, squares, motion, end, length, statistics):
    """Add the statistics of a flight of duration `length`, except for the potentials at its ends."""
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
    """Update the statistics of module i with the motion of box i between the times `low` and `high`.

    p (8,): Taylor polynomial of the box.
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
    """Add the statistics of a flight in each lane and of an impact at its end.

    flight: mask of the lanes whose flight ends, last step, duration, and five times the error bound of Hermite's
    polynomial.
    hits: mask of the lanes with an impact, for each module.
    early: boxes and forcing at the start of the last step.
    arrival: values at the end: box positions, box velocities before and after the impact, ball velocities before the
    impact, forcing.
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

    record: largest displacement so far, less an error margin.
    """
    return (v * v_later < 0.0) & (most(abs(fused(third, v, x)), abs(fused(-third, v_later, later))) > record)


@inlined
def keep_turns(runs, c, work, turns, wrong, early, late, step):
    """Store turning points of boxes whose displacement may be the largest so far.

    early, late: boxes and forcing before and after the step. wrong: five times the error bound of Hermite's polynomial.
    """
    wrong = 0.2 * wrong
    for i in range(2):
        x, v, y, w, row = early[i], early[2 + i], late[i], late[2 + i], rows.TURNS_AT + rows.TURN * i
        # split Hermite's polynomial near the turning point; the coefficients of the parts are close bounds
        part, p, q = v / (v - w), fused(step * (1 / 3), v, x), fused(step * (-1 / 3), w, y)
        first, middle, last = fused(part, p - x, x), fused(part, q - p, p), fused(part, y - q, q)
        before, after = fused(part, middle - first, first), fused(part, last - middle, middle)
        ends, corners = most(abs(x), abs(y)), most(abs(first), abs(last))
        highest = most(most(ends, corners), most(abs(before), abs(after))) + wrong
        turned = turns[i] & (highest > load(runs, STATISTICS_AT + LARGEST + i))
        if count(turned) == 0:
            continue
        lowest = abs(fused(part, after - before, before)) - wrong
        # compute the stored turning points, if one of them may have a larger displacement
        if count(turned & (load(runs, row + rows.KEPT) > 0.0) & (load(runs, row + rows.HIGHEST) > lowest)) > 0:
            find_turns(runs, c, work)
        is_late, record = part > 0.5, load(runs, STATISTICS_AT + LARGEST + i)
        for k in range(6):
            replace_rows(runs, row + k, turned, (where(is_late, late[k], early[k]),))
        since = step * where(is_late, part - 1.0, part)
        replace_rows(runs, row + rows.SINCE, turned, (since, highest, 1.0))  # rows SINCE, HIGHEST and KEPT
        replace_rows(runs, STATISTICS_AT + LARGEST + i, turned, (most(record, lowest),))


@in_place
def find_turns(runs, c, work):
    """Compute the displacements of the boxes at the stored turning points, and update the largest displacements."""
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
            # displacement at the vertex of a parabola
            turned = abs(value - 0.5 * slope * slope / _bend(work, first, t))
            record = load(runs, STATISTICS_AT + LARGEST + i)
            replace_rows(runs, STATISTICS_AT + LARGEST + i, kept & (turned > record), (turned,))
            store(runs, row + rows.KEPT, 0.0)


@inlined
def _slope(work, first, t):
    """Return the derivative at t of the polynomial from row `first` on, up to the order `rows.TERMS`."""
    total = 0.0 * t
    for m in range(rows.TERMS, 0, -1):
        total = fused(total, t, m * load(work, first + m))
    return total


@inlined
def _bend(work, first, t):
    """Return the second derivative at t of the polynomial from row `first` on, up to the order `rows.TERMS`."""
    total = 0.0 * t
    for m in range(rows.TERMS, 1, -1):
        total = fused(total, t, m * (m - 1.0) * load(work, first + m))
    return total
