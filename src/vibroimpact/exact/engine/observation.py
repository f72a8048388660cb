"""What a run amounts to from some time on: its impacts, how far the boxes swing, how fast the balls are."""

import math

from vibroimpact.exact.engine.compiled import inlined, unfolded
from vibroimpact.exact.engine.contact import box_accelerations
from vibroimpact.exact.engine.flow import advance, along, jet, node, slope, value
from vibroimpact.exact.engine.motion import Motion, carry, mode_of, pair
from vibroimpact.exact.engine.phase import ahead
from vibroimpact.exact.engine.replay import FORCING, LENGTH, start_of
from vibroimpact.exact.engine.squares import squares_along, squares_before
from vibroimpact.system.state import IMPACT, STICK

IMPACTS, STICKS, LARGEST, SQUARE, PATH, SEEN = 0, 2, 4, 6, 8, 10
"""Places of what is seen of each of the two modules: its impacts and sticks, the largest |X_i|, the integral of X_i^2,
the length of the ball's path; and their number."""

PIECE = 1.0  # in units of the flow: over so long the velocity of a box is nearly a cubic polynomial,
MARGIN = 1 / 384  # but for so much of it (the error of Hermite's interpolation where each rate is at most 1 / unit)
FINE = 4  # spacings of the flow table: over so long it is one but for 1e-5 of that
NEAR = 0.02  # in units of the flow: so far from a node its Taylor polynomial is exact to rounding
TRIES, STEPS = 8, 3


@unfolded
def observe(flow, forms, flights, events, opening, seen):
    """Fill in what is seen, zeros (SEEN,), of a run's flights (`departures`) and events from the time opening on."""
    passed = 0.0
    for n in range(len(flights)):
        if n < len(events) and events[n, 0] >= opening:
            if events[n, 3] == IMPACT:
                seen[IMPACTS + int(events[n, 1]) - 1] += 1
            elif events[n, 3] == STICK:
                seen[STICKS + int(events[n, 1]) - 1] += 1
        left = flights[n, LENGTH]
        if left > 0.0 and passed + left > opening:
            boxes, balls, walls = start_of(flights[n])
            phase, tail = flights[n, FORCING], 0.0
            while left > 0.0:
                before = opening - passed
                t = min(left, flow.longest, before) if before > 0.0 else min(left, flow.longest)
                motion = Motion(boxes, balls, walls, (0, 0), math.sin(phase), math.cos(phase))
                boxes = _watch(flow, forms, motion, t, before > 0.0, seen)
                balls = carry(balls, walls, boxes, t)
                phase, tail = ahead(phase, tail, flow.coefficients.omega, t)
                left, passed = left - t, passed + t
        else:
            passed += left


@unfolded
def _watch(flow, forms, motion, t, closed, seen):
    """Add what is seen of a flight no longer than flow.longest, unless the eyes are closed; the boxes at its end."""
    mode, j = mode_of(motion.walls), int(t * flow.density + 0.5)
    rest = t - j * flow.spacing
    there, s, c = node(flow, mode, motion.boxes, motion.sine, motion.cosine, j)
    jets = jet(flow.coefficients, mode, there, s, c)
    boxes = along(jets, rest)
    if not closed:
        one, two = squares_before(forms, mode, j, motion.boxes, motion.sine, motion.cosine)
        seen[SQUARE] += one + squares_along(jets[0], rest)
        seen[SQUARE + 1] += two + squares_along(jets[1], rest)
        rates = _rate(jets[0], rest), _rate(jets[1], rest)
        swung = _swing(flow, motion, t, boxes, rates, seen)
        for i in range(2):
            seen[PATH + i] += abs(motion.balls[2 + i]) * t if motion.walls[i] == 0 else swung[i]
    return boxes


@inlined
def _rate(p, t):
    """Second derivative of a polynomial of degree 7, p (8,), at t."""
    return 2.0 * p[2] + t * (6.0 * p[3] + t * (12.0 * p[4] + t * (20.0 * p[5] + t * (30.0 * p[6] + t * 42.0 * p[7]))))


@unfolded
def _swing(flow, motion, length, last, last_rates, seen):
    """Note the largest |X_i| of a flight that ends so; the lengths of both boxes' paths.

    The velocities at the ends of a piece and their rates make a cubic polynomial. Where its Bernstein coefficients are
    all of one sign, and no closer to zero than the polynomial to the velocity, the box does not turn.
    """
    q, stride = flow.coefficients, max(int(PIECE * flow.unit * flow.density), 1)
    mode, j, start, paths = mode_of(motion.walls), 0, 0.0, (0.0, 0.0)
    now, rates = motion.boxes, box_accelerations(q, motion.walls, motion.boxes, motion.sine)
    while start < length:
        j += stride
        end, there, rates_there = length, last, last_rates
        if j * flow.spacing < length:
            end = j * flow.spacing
            there, s, _ = node(flow, mode, motion.boxes, motion.sine, motion.cosine, j)
            rates_there = box_accelerations(q, motion.walls, there, s)
        for i in range(2):
            v, w, third = now[2 + i], there[2 + i], (end - start) * (1 / 3)
            a, b = v + third * rates[i], w - third * rates_there[i]
            near = MARGIN * (abs(v) + abs(w) + flow.unit * (abs(rates[i]) + abs(rates_there[i])))
            path = abs(there[i] - now[i])
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
    """X_i where box i turns in a piece with velocities of different signs at its ends, speeds as in `_turns`."""
    mode, (low, high) = mode_of(motion.walls), times
    t, x = low + (high - low) * _zero(speeds), 0.0
    for _ in range(TRIES):
        j = int(t * flow.density + 0.5)
        place = j * flow.spacing
        boxes, s, c = node(flow, mode, motion.boxes, motion.sine, motion.cosine, j)
        jets = jet(flow.coefficients, mode, boxes, s, c)
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
    """Nearly the zero in [0, 1] of a cubic polynomial, given by Bernstein coefficients; its ends differ in sign."""
    a, b, c, d = coefficients
    u = a / (a - d)
    for _ in range(2):
        v = 1.0 - u
        at = v * v * (v * a + 3.0 * u * b) + u * u * (3.0 * v * c + u * d)
        rate = 3.0 * (v * v * (b - a) + 2.0 * u * v * (c - b) + u * u * (d - c))
        if rate != 0.0:
            u = min(max(u - at / rate, 0.0), 1.0)
    return u
