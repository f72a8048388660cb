"""Everything that happens at one instant: impacts, completed chatters, balls at rest that stick, releases."""

from vibroimpact.exact.engine.compiled import compiled, inlined
from vibroimpact.exact.engine.constraints import (
    LOOKAHEAD,
    RESOLUTION,
    acceleration_rounding,
    gap_rounding,
    module_time,
    remainder,
)
from vibroimpact.exact.engine.event_log import CHATTERS, NEGLECTED, RESIDUAL, record
from vibroimpact.exact.engine.exclusion import spread
from vibroimpact.exact.engine.flow import acceleration, inverse_masses, jet
from vibroimpact.exact.engine.motion import glide, mode_of, pair, with_position, with_velocity
from vibroimpact.system.restitution import after_impact
from vibroimpact.system.state import IMPACT, RELEASE, STICK

NEGLIGIBLE = 1e-18  # change of the state by what completing a chatter neglects
LOW = 1e-12  # height of a hop, the wall being at 1, below which its impacts are not listed one by one

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
    tiny = acceleration_rounding(q, boxes, i)
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
    if a <= acceleration_rounding(q, boxes, i):
        return False, 0.0
    total = 2.0 * u / (a * (1.0 - q.kappa))
    window = 2.0 * total
    jets = jet(q, mode, boxes, sine, cosine)
    bound = remainder(q, mode, jets, window * q.growth)
    p = jets[0] if i == 0 else jets[1]
    if 8.0 * window * spread(p, bound, window) > a:
        return False, 0.0
    neglected = q.epsilon * (q.k11 + q.k22) * u**3 / (a * a * (1.0 - q.kappa**3))
    height = u * u / (2.0 * a)
    unresolved = height <= gap_rounding(q, boxes, balls, i)
    if (neglected > NEGLIGIBLE or height > LOW) and not unresolved:
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
def _complete(flow, boxes, balls, walls, touching, sine, cosine, i, ledger):
    """Complete the chatter of ball i, if that may be: (boxes, balls, walls, touching, time to its end or -1)."""
    done, end = _end_of_chatter(flow, boxes, balls, walls, touching, sine, cosine, i, ledger)
    if not done:
        return boxes, balls, walls, touching, -1.0
    ledger[CHATTERS] += 1
    boxes, balls = _joined(flow.coefficients, boxes, balls, i)
    return boxes, balls, pair(walls, i, touching[i]), pair(touching, i, 0), end


@inlined
def _joined(q, boxes, balls, i):
    """Boxes and balls with ball i moving as its box, their momentum kept."""
    common = (boxes[2 + i] + q.epsilon * balls[2 + i]) * q.inverse_mass
    return with_velocity(boxes, i, common), with_velocity(balls, i, common)


@inlined
def resolve(flow, boxes, balls, walls, touching, due, sine, cosine, elapsed, remaining, events, count, ledger):
    """Everything that happens now: (boxes, balls, walls, touching, number of events).

    due: the module whose constraint is just met, or -1. The forces on balls at rest are looked at after all impacts,
    since an impact in one module can release the ball of the other, and the ends of chatters, which are later, last.
    """
    q = flow.coefficients
    pulled = due if due >= 0 and walls[due] != 0 else -1
    chatters = (False, False)
    for i in range(2):
        if walls[i] != 0:
            continue
        relative, velocity = boxes[i] - balls[i], boxes[2 + i] - balls[2 + i]
        wall = 1 if relative > 0.0 else -1
        if i != due and 1.0 - wall * relative > gap_rounding(q, boxes, balls, i):
            continue
        touching = pair(touching, i, wall)
        balls = with_position(balls, i, boxes[i] - wall)
        if abs(velocity) <= RESOLUTION * (abs(boxes[2 + i]) + abs(balls[2 + i])):
            balls = with_velocity(balls, i, boxes[2 + i])
        elif wall * velocity > 0.0:
            ledger[RESIDUAL] = max(ledger[RESIDUAL], abs(1.0 - wall * relative))
            box, ball = impact(q.epsilon, q.kappa, boxes[2 + i], balls[2 + i])
            boxes, balls = with_velocity(boxes, i, box), with_velocity(balls, i, ball)
            if q.kappa * abs(velocity) <= RESOLUTION * (abs(velocity) + abs(box) + abs(ball)):  # no rebound to speak of
                boxes, balls = _joined(q, boxes, balls, i)
            count = record(events, count, elapsed, i, wall, IMPACT, boxes, balls, velocity)
            if _ends_soon(flow, boxes, balls, walls, sine, remaining, i, wall):
                chatters = pair(chatters, i, True)
    for i in range(2):
        if walls[i] != 0 or (touching[i] != 0 and boxes[2 + i] == balls[2 + i]):
            walls, touching, count = _rest(
                q, boxes, balls, walls, touching, i, i == pulled, sine, cosine, elapsed, events, count
            )
    if chatters[0] or chatters[1]:
        boxes, balls, walls, touching, count = _complete_both(
            flow, boxes, balls, walls, touching, sine, cosine, chatters, elapsed, events, count, ledger
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


@compiled
def _complete_both(flow, boxes, balls, walls, touching, sine, cosine, chatters, elapsed, events, count, ledger):
    """Complete what may be completed of the chatters of the two balls, where they have one: what `resolve` returns.

    Their ends are noted last, in the order of their times and with the states at these times.
    """
    ends, inward = (-1.0, -1.0), (abs(boxes[2] - balls[2]), abs(boxes[3] - balls[3]))
    for i in range(2):
        if chatters[i] and touching[i] != 0:
            boxes, balls, walls, touching, end = _complete(flow, boxes, balls, walls, touching, sine, cosine, i, ledger)
            ends = pair(ends, i, end)
    for i in range(2):  # the other ball may be pulled off by it
        if walls[i] != 0 and ends[i] < 0.0:
            walls, touching, count = _rest(
                flow.coefficients, boxes, balls, walls, touching, i, False, sine, cosine, elapsed, events, count
            )
    sooner = 0 if ends[0] <= ends[1] else 1
    for i in (sooner, 1 - sooner):
        if ends[i] >= 0.0:
            later, there = glide(flow, boxes, balls, walls, sine, cosine, ends[i])
            count = record(events, count, elapsed + ends[i], i, walls[i], STICK, later, there, inward[i])
    return boxes, balls, walls, touching, count
