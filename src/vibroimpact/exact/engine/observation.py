"""Summary statistics after a transient: impacts, displacements of the boxes, speeds of the balls."""

import math

from vibroimpact.exact.engine.compiled import in_place, inlined, unfolded
from vibroimpact.exact.engine.contact import box_accelerations
from vibroimpact.exact.engine.energy import add_falls, add_potentials, held, lost, squares_along, squares_before
from vibroimpact.exact.engine.flow import advance, jet_at, node, slope, value
from vibroimpact.exact.engine.motion import APPROACH, COSINE, SINE, Motion, glide, mode_of, pair, with_velocity
from vibroimpact.exact.engine.replay import next_departure
from vibroimpact.system.state import IMPACT, STICK

IMPACTS, STICKS, LARGEST, PATH, LOST, STORED, INTEGRALS, SEEN = 0, 2, 4, 6, 8, 10, 11, 18
"""Places of the statistics of a run. For each of the two modules: impacts and sticks, the largest |X_i|, the length of
the ball's path, the energy lost in impacts; the change of the stored energy; integrals (`energy.OBSERVED`); number."""

PIECE = 1.0  # in units of the flow: over so long the velocity of a box is nearly a cubic polynomial,
MARGIN = 1 / 384  # but for so much of it (the error of Hermite's interpolation where each rate is at most 1 / unit)
WRONG = 2 / 384  # the same of positions, over any time, and twice: a flight is larger than its ends
FINE = 4  # spacings of the flow table: over so long it is one but for 1e-5 of that
NEAR = 0.02  # in units of the flow: so far from a node its Taylor polynomial is exact to rounding
TRIES, STEPS = 8, 3


@in_place
def observe(flow, squares, departure, events, count, arrival, seen):
    """Add the statistics of a piece of a run to seen (SEEN,), without the potentials at its ends.

    departure: its start (`replay.Departure`); events: its rows, and how many; arrival: boxes, time and phase of its end.
    """
    leaving, (final, time, phase) = departure, arrival
    early, last = (math.sin(leaving.phase), math.cos(leaving.phase)), (math.sin(phase), math.cos(phase))
    for n in range(count + 1):
        following = next_departure(flow.coefficients, events[:count], n, leaving, (time, phase))
        left, end, late = following.time - leaving.time, final, last
        if n < count:
            _count(flow.coefficients, events[n], seen)
            end = _before(flow.coefficients, following.boxes, events[n]) if left > 0.0 else leaving.boxes
            late = events[n, SINE], events[n, COSINE]
        if left > 0.0:
            _watch(
                flow, squares, Motion(leaving.boxes, leaving.balls, leaving.walls, (0, 0), early[0], early[1]),
                end, late, left, seen,
            )  # fmt: skip
        if n < count:
            before, after = (mode_of(leaving.walls), end), (mode_of(following.walls), following.boxes)
            add_falls(squares, before, after, late, seen[INTEGRALS:])
        leaving, early = following, late


@inlined
def open_or_close(flow, squares, motion, sign, seen):
    """Begin (sign -1) or end (+1) an observation: add what depends on its ends alone."""
    boxes, q = motion.boxes, flow.coefficients
    add_potentials(squares, mode_of(motion.walls), boxes, motion.sine, motion.cosine, sign, seen[INTEGRALS:])
    seen[STORED] += sign * held(q.ground, -q.k12, q.epsilon, boxes, motion.balls)
    for i in range(2):
        seen[LARGEST + i] = max(seen[LARGEST + i], abs(boxes[i]))


@inlined
def _count(q, event, seen):
    module = int(event[1]) - 1
    if event[3] == IMPACT:
        seen[IMPACTS + module] += 1
    elif event[3] == STICK:
        seen[STICKS + module] += 1
    seen[LOST + module] += lost(q.epsilon, q.kappa if event[3] == IMPACT else 0.0, event[APPROACH])


@inlined
def _before(q, boxes, event):
    """Return the boxes before an event, from those after it."""
    if event[3] != IMPACT:
        return boxes
    i = int(event[1]) - 1
    return with_velocity(boxes, i, boxes[2 + i] + (1.0 + q.kappa) * q.epsilon * q.inverse_mass * event[APPROACH])


@inlined
def _watch(flow, squares, motion, end, late, length, seen):
    """Add the statistics of a flight but for potentials at its ends; late: sine and cosine of the forcing there."""
    mode = mode_of(motion.walls)
    for i in range(2):
        seen[LARGEST + i] = max(seen[LARGEST + i], abs(motion.boxes[i]), abs(end[i]))
        seen[PATH + i] += abs(motion.balls[2 + i]) * length if motion.walls[i] == 0 else 0.0
    for k in range(squares.drifts.shape[1]):
        seen[INTEGRALS + k] += squares.drifts[mode, k] * length
    plain = mode == 0 and squares.forms.shape[1] == 0
    for i in range(2):
        plain = plain and _within(flow, i, motion.boxes, end, length, seen[LARGEST + i])
    if not plain:
        _search(flow, squares.forms, motion, end, late, length, seen)


@inlined
def _within(flow, i, start, end, length, most):
    """Return True if box i certainly stays within +- most between the given boxes at start and end.

    A cubic polynomial with the positions and velocities of both ends stays within its Bernstein coefficients, here
    those of its halves; it is wrong by a fourth derivative, which is bounded as if each rate were 1 / unit.
    """
    unit, third = flow.unit, length * (1 / 3)
    size = max(abs(start[0]), abs(end[0])) + max(abs(start[1]), abs(end[1])) + flow.coefficients.drive * unit * unit
    size += unit * (max(abs(start[2]), abs(end[2])) + max(abs(start[3]), abs(end[3])))
    beat = (length / unit) ** 2
    a, b, c, d = start[i], start[i] + third * start[2 + i], end[i] - third * end[2 + i], end[i]
    early, middle, late = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + d)
    inner, outer = 0.5 * (early + middle), 0.5 * (middle + late)
    left = most - WRONG * beat * beat * size
    return abs(early) < left and abs(late) < left and abs(inner) < left and abs(outer) < left


@in_place
def _search(flow, forms, motion, end, late, left, seen):
    """Search a flight for turns, and add what no potentials give."""
    mode = mode_of(motion.walls)
    while left > 0.0:
        t = min(left, flow.longest)
        now = Motion(end, motion.balls, motion.walls, (0, 0), late[0], late[1]) if t == left else glide(flow, motion, t)
        if forms.shape[1] > 0:
            j = int(t * flow.density + 0.5)
            jets = jet_at(flow, mode, motion.boxes, motion.sine, motion.cosine, j)
            rest = t - j * flow.spacing
            one, two = squares_before(forms, mode, j, motion.boxes, motion.sine, motion.cosine)
            seen[INTEGRALS] += one + squares_along(jets[0], rest)
            seen[INTEGRALS + 1] += two + squares_along(jets[1], rest)
        swung = _swing(flow, motion, t, now, seen)
        for i in range(2):
            seen[PATH + i] += swung[i] if motion.walls[i] != 0 else 0.0
        motion, left = now, left - t


@inlined
def _rate(p, t):
    """Return the second derivative of a polynomial of degree 7, p (8,), at t."""
    return 2.0 * p[2] + t * (6.0 * p[3] + t * (12.0 * p[4] + t * (20.0 * p[5] + t * (30.0 * p[6] + t * 42.0 * p[7]))))


@unfolded
def _swing(flow, motion, length, last, seen):
    """Note the largest |X_i| of a flight of this length to the last motion; the lengths of both boxes' paths, where
    balls stick to them.

    The velocities at the ends of a piece and their rates make a cubic polynomial. Where its Bernstein coefficients are
    all of one sign, and no closer to zero than the polynomial to the velocity, the box does not turn.
    """
    q, stride = flow.coefficients, max(int(PIECE * flow.unit * flow.density), 1)
    mode, j, start, paths = mode_of(motion.walls), 0, 0.0, (0.0, 0.0)
    now, rates = motion.boxes, box_accelerations(q, motion.walls, motion.boxes, motion.sine)
    while start < length:
        j += stride
        end, there, s = length, last.boxes, last.sine
        if j * flow.spacing < length:
            end = j * flow.spacing
            there, s, _ = node(flow, mode, motion.boxes, motion.sine, motion.cosine, j)
        rates_there = box_accelerations(q, motion.walls, there, s)
        for i in range(2):
            path = abs(there[i] - now[i])
            if motion.walls[i] != 0 or not _within(flow, i, now, there, end - start, seen[LARGEST + i]):
                v, w, third = now[2 + i], there[2 + i], (end - start) * (1 / 3)
                a, b = v + third * rates[i], w - third * rates_there[i]
                near = MARGIN * (abs(v) + abs(w) + flow.unit * (abs(rates[i]) + abs(rates_there[i])))
                if min(v, w, a, b) < near and max(v, w, a, b) > -near:
                    path = _turns(flow, motion, i, (start, end), (v, a, b, w), (now[i], there[i]), seen)
            paths = pair(paths, i, paths[i] + path)
            seen[LARGEST + i] = max(seen[LARGEST + i], abs(now[i]), abs(there[i]))
        now, rates, start = there, rates_there, end
    return paths


@inlined
def _turns(flow, motion, i, times, speeds, ends, seen):
    """Note the turns of box i in a piece of a flight; the length of its path.

    speeds: Bernstein coefficients of its velocity in the piece; ends: where it is at both ends.
    """
    (start, end), (v, _, _, w), (x, last) = times, speeds, ends
    if v * w < 0.0:
        turned = _turn(flow, motion, i, times, speeds)
        seen[LARGEST + i] = max(seen[LARGEST + i], abs(turned))
        return abs(turned - x) + abs(last - turned)
    path, low = 0.0, start
    while low < end:
        high = min(low + FINE * flow.spacing, end)
        boxes, _, _ = advance(flow, mode_of(motion.walls), motion.boxes, motion.sine, motion.cosine, high)
        w = boxes[2 + i]
        if v * w < 0.0:
            turned = _turn(flow, motion, i, (low, high), (v, (2.0 * v + w) / 3.0, (v + 2.0 * w) / 3.0, w))
            path, x = path + abs(turned - x), turned
            seen[LARGEST + i] = max(seen[LARGEST + i], abs(x))
        low, v = high, w
    return path + abs(last - x)


@inlined
def _turn(flow, motion, i, times, speeds):
    """Return X_i at a turn of box i in a piece whose end velocities differ in sign, speeds as in `_turns`."""
    mode, (low, high) = mode_of(motion.walls), times
    t, x = low + (high - low) * _zero(speeds), 0.0
    for _ in range(TRIES):
        j = int(t * flow.density + 0.5)
        place = j * flow.spacing
        jets = jet_at(flow, mode, motion.boxes, motion.sine, motion.cosine, j)
        p, step = jets[0] if i == 0 else jets[1], t - place
        for _ in range(STEPS):
            bend = _rate(p, step)
            if bend != 0.0:
                step = min(max(step - slope(p, step) / bend, low - place), high - place)
        t, x = place + step, value(p, step)
        if abs(step) <= NEAR * flow.unit:
            break
    return x


@inlined
def _zero(coefficients):
    """Return an approximate zero in [0, 1] of a cubic with these Bernstein coefficients, whose ends differ in sign."""
    a, b, c, d = coefficients
    u = a / (a - d)
    for _ in range(2):
        v = 1.0 - u
        at = v * v * (v * a + 3.0 * u * b) + u * u * (3.0 * v * c + u * d)
        rate = 3.0 * (v * v * (b - a) + 2.0 * u * v * (c - b) + u * u * (d - c))
        if rate != 0.0:
            u = min(max(u - at / rate, 0.0), 1.0)
    return u
