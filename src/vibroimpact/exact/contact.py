"""Everything that happens at one instant: impacts, completed chatters, balls at rest that stick, releases."""

from vibroimpact.exact.books import (
    CHATTERS,
    IMPACT,
    NEGLECTED,
    RELEASE,
    RESIDUAL,
    STICK,
    record,
)
from vibroimpact.exact.compiled import compiled, inlined
from vibroimpact.exact.constraints import (
    LOOKAHEAD,
    RESOLUTION,
    acceleration_rounding,
    gap_rounding,
    module_time,
    remainder,
)
from vibroimpact.exact.exclusion import spread
from vibroimpact.exact.flow import acceleration, inverse_masses, jet
from vibroimpact.exact.motion import glide, mode_of, pair, with_position, with_velocity
from vibroimpact.system.restitution import after_impact

NEGLIGIBLE = 1e-18

impact = compiled(after_impact)


@inlined
def box_accelerations(q, walls, boxes, sine):
    """Accelerations of both boxes."""
    i1, i2 = inverse_masses(q, mode_of(walls))
    return acceleration(q, i1, i2, boxes[0], boxes[1], boxes[2], boxes[3], q.f1 * sine, q.f2 * sine)


@compiled
def _hold(q, jets, boxes, i, wall, sticking):
    """Sign of the force between ball i and the wall that it is at rest on: > 0 holds it there, < 0 would have to pull.

    Where the force vanishes within rounding its first derivative that does not decides. So it does for a sticking ball
    where the pull is too brief to lift the ball by more than rounding: it would lift it by 2 |force|^3 / (3 change^2).
    """
    p = jets[0] if i == 0 else jets[1]
    tiny = acceleration_rounding(q, boxes)
    force, change = 2.0 * wall * p[2], 6.0 * wall * p[3]
    if abs(force) <= tiny:
        for k in (3, 4, 5):
            if p[k] != 0.0:
                return wall * p[k]
        return 0.0
    if sticking and force < 0.0 < change and -(force**3) < tiny * change**2:
        return change
    return force


@inlined
def _ends_soon(flow, boxes, balls, walls, sine, remaining, i, wall):
    """Whether the chatter of ball i after an impact would end within the time of one proof, and within the run."""
    q = flow.coefficients
    a = wall * box_accelerations(q, walls, boxes, sine)[i]
    u = -wall * (boxes[2 + i] - balls[2 + i])
    return 4.0 * u <= a * (1.0 - q.kappa) * min(remaining, LOOKAHEAD * flow.unit)


@compiled
def _end_of_chatter(flow, boxes, balls, walls, touching, sine, cosine, i, ledger):
    """(whether the chatter of ball i may be completed now, time to its end).

    After an impact with inward speed u under the push a the flights shrink by kappa each and end after
    T = 2 u / (a (1 - kappa)). Completing at once keeps the momentum of box and ball; it neglects the force of the
    springs on the distance of the ball meanwhile, of order u^3 / a^2.
    """
    q = flow.coefficients
    mode = mode_of(walls)
    wall = touching[i]
    a = wall * box_accelerations(q, walls, boxes, sine)[i]
    u = -wall * (boxes[2 + i] - balls[2 + i])
    if a <= acceleration_rounding(q, boxes):
        return False, 0.0
    total = 2.0 * u / (a * (1.0 - q.kappa))
    window = 2.0 * total
    jets = jet(q, mode, boxes, sine, cosine)
    bound = remainder(q, mode, jets, window * q.growth)
    p = jets[0] if i == 0 else jets[1]
    if 8.0 * window * spread(p, bound, window) > a:
        return False, 0.0
    neglected = q.epsilon * (q.k11 + q.k22) * u**3 / (a * a * (1.0 - q.kappa**3))
    unresolved = u * u <= 2.0 * a * gap_rounding(boxes, balls, i)
    if neglected > NEGLIGIBLE and not unresolved:
        return False, 0.0
    other = 1 - i
    t, width, _ = module_time(
        q, mode, other, boxes, balls, jets, walls[other], touching[other], bound, sine, cosine, window, 0.0
    )
    clear = t >= window and not width < window
    if not clear and not unresolved:
        return False, 0.0
    ledger[NEGLECTED] += neglected
    if not clear:
        return True, 0.0
    return True, total * (1.0 - 2.0 * wall * p[3] * total / a)


@compiled
def _complete(flow, boxes, balls, walls, touching, sine, cosine, i, elapsed, events, count, ledger):
    """Complete the chatter of ball i, if that may be: what `settle` returns."""
    done, end = _end_of_chatter(flow, boxes, balls, walls, touching, sine, cosine, i, ledger)
    if done:
        q, wall = flow.coefficients, touching[i]
        common = (boxes[2 + i] + q.epsilon * balls[2 + i]) / (1.0 + q.epsilon)
        boxes, balls = with_velocity(boxes, i, common), with_velocity(balls, i, common)
        walls, touching = pair(walls, i, wall), pair(touching, i, 0)
        ledger[CHATTERS] += 1
        later, there = glide(flow, boxes, balls, walls, sine, cosine, end)
        count = record(events, count, elapsed + end, i, wall, STICK, later, there)
    return boxes, balls, walls, touching, count


@inlined
def settle(flow, boxes, balls, walls, touching, due, sine, cosine, elapsed, remaining, events, count, ledger):
    """Everything that happens now: (boxes, balls, walls, touching, number of events).

    due: the module whose constraint is just met, or -1. The forces on sticking balls are looked at last, since an
    impact in one module can release the ball of the other.
    """
    q = flow.coefficients
    pulled = due if due >= 0 and walls[due] != 0 else -1
    for i in range(2):
        if walls[i] != 0:
            continue
        relative, velocity = boxes[i] - balls[i], boxes[2 + i] - balls[2 + i]
        wall = 1 if relative > 0.0 else -1
        if i != due and 1.0 - wall * relative > gap_rounding(boxes, balls, i):
            continue
        touching = pair(touching, i, wall)
        balls = with_position(balls, i, boxes[i] - wall)
        if abs(velocity) <= RESOLUTION * (abs(boxes[2 + i]) + abs(balls[2 + i])):
            balls = with_velocity(balls, i, boxes[2 + i])
        elif wall * velocity > 0.0:
            ledger[RESIDUAL] = max(ledger[RESIDUAL], abs(1.0 - wall * relative))
            box, ball = impact(q.epsilon, q.kappa, boxes[2 + i], balls[2 + i])
            boxes, balls = with_velocity(boxes, i, box), with_velocity(balls, i, ball)
            count = record(events, count, elapsed, i, wall, IMPACT, boxes, balls)
            if _ends_soon(flow, boxes, balls, walls, sine, remaining, i, wall):
                boxes, balls, walls, touching, count = _complete(
                    flow, boxes, balls, walls, touching, sine, cosine, i, elapsed, events, count, ledger
                )
    for i in range(2):
        if walls[i] != 0 or (touching[i] != 0 and boxes[2 + i] == balls[2 + i]):
            walls, touching, count = _rest(
                q, boxes, balls, walls, touching, i, i == pulled, sine, cosine, elapsed, events, count
            )
    return boxes, balls, walls, touching, count


@compiled
def _rest(q, boxes, balls, walls, touching, i, pulled, sine, cosine, elapsed, events, count):
    """A ball at rest on a wall sticks or is released: (walls, touching, number of events)."""
    jets = jet(q, mode_of(walls), boxes, sine, cosine)
    if walls[i] != 0:
        falling = pulled and walls[i] * (jets[0] if i == 0 else jets[1])[3] < 0.0
        if falling or _hold(q, jets, boxes, i, walls[i], True) < 0.0:
            touching, walls = pair(touching, i, walls[i]), pair(walls, i, 0)
            count = record(events, count, elapsed, i, touching[i], RELEASE, boxes, balls)
    elif _hold(q, jets, boxes, i, touching[i], False) > 0.0:
        walls, touching = pair(walls, i, touching[i]), pair(touching, i, 0)
        count = record(events, count, elapsed, i, walls[i], STICK, boxes, balls)
    return walls, touching, count
