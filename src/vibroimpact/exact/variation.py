"""Variational flow: the exact Jacobian of a run's final state, and how far rounding errors grow along it.

Perturbations pass a flight by its linear flow, an impact by its saltation matrix, a release by continuity (the force
vanishes there) or together with the impact that forces it, and a completed chatter by the derivative of its completion:
the infinitely many saltations it stands for are never multiplied out. Inside, states are ordered [boxes, balls].
"""

import math

import numpy as np

from vibroimpact.exact.books import IMPACT, RELEASE, STICK
from vibroimpact.exact.compiled import compiled
from vibroimpact.exact.contact import impact
from vibroimpact.exact.flow import acceleration, advance, inverse_masses
from vibroimpact.exact.motion import mode_of

PUBLIC_ORDER = np.array([0, 4, 1, 5, 2, 6, 3, 7])
"""Places in [boxes, balls] of the public state [X1, Y1, X2, Y2, X1', Y1', X2', Y2']."""


@compiled
def _flight(flow, walls, t, matrix):
    """Fill the derivative (8, 8) of the state after a flight of t <= flow.longest by the state before."""
    matrix[:] = 0.0
    for k in range(4):
        unit = (1.0 if k == 0 else 0.0, 1.0 if k == 1 else 0.0, 1.0 if k == 2 else 0.0, 1.0 if k == 3 else 0.0)
        later, _, _ = advance(flow, mode_of(walls), unit, 0.0, 0.0, t)
        matrix[0, k], matrix[1, k], matrix[2, k], matrix[3, k] = later
    for i in range(2):
        if walls[i] != 0:  # the ball goes where its box goes
            matrix[4 + i, :4] = matrix[i, :4]
            matrix[6 + i, :4] = matrix[2 + i, :4]
        else:
            matrix[4 + i, 4 + i] = matrix[6 + i, 6 + i] = 1.0
            matrix[4 + i, 6 + i] = t


@compiled
def _field(q, walls, state, phase, field):
    """Fill the rate of change (8,) of a state (8,) in a contact state."""
    i1, i2 = inverse_masses(q, mode_of(walls))
    force = math.sin(phase)
    a1, a2 = acceleration(q, i1, i2, state[0], state[1], state[2], state[3], q.f1 * force, q.f2 * force)
    field[0], field[1], field[2], field[3] = state[2], state[3], a1, a2
    field[4], field[5] = state[6], state[7]
    field[6] = a1 if walls[0] != 0 else 0.0
    field[7] = a2 if walls[1] != 0 else 0.0


@compiled
def _before_impact(q, i, after, approach):
    """The state (8,) just before an impact in module i (0, 1), from the one after it and the relative velocity before.

    The velocities after it alone tell less of that the smaller kappa is.
    """
    box, ball = 2 + i, 6 + i
    before = after.copy()
    lost, gained = impact(q.epsilon, q.kappa, approach, 0.0)
    before[box] += approach - lost
    before[ball] -= gained
    return before


@compiled
def _depth(q, i, wall, after, approach, walls, phase):
    """How deep a ball would have gone beyond its wall, had there been none: u^2 / (2 b), u its speed and b the braking
    just before the impact; inf where nothing brakes it.
    """
    before, field = _before_impact(q, i, after, approach), np.empty(8)
    _field(q, walls, before, phase, field)
    brake = -wall * field[2 + i]
    return approach**2 / (2.0 * brake) if brake > 0.0 else math.inf


@compiled
def _impact_matrix(q, i, after, approach, walls, walls_after, phase, matrix):
    """Fill the saltation matrix (8, 8) of an impact in module i (0, 1), from the state (8,) after it and the relative
    velocity before it.

    S = R + (f+ - R f-) n^T / (n . f-) (Aizerman and Gantmakher 1958; Leine and Nijmeijer 2004), R the impact law, n the
    normal of the wall, f- and f+ the fields around it; walls_after differs from walls where the impact releases a ball.
    """
    box, ball = 2 + i, 6 + i
    r = np.eye(8)
    r[box, box], r[ball, box] = impact(q.epsilon, q.kappa, 1.0, 0.0)
    r[box, ball], r[ball, ball] = impact(q.epsilon, q.kappa, 0.0, 1.0)
    before = _before_impact(q, i, after, approach)
    incoming, outgoing = np.empty(8), np.empty(8)
    _field(q, walls, before, phase, incoming)
    _field(q, walls_after, after, phase, outgoing)
    jump = (outgoing - r @ incoming) / approach
    matrix[:] = r
    matrix[:, i] += jump
    matrix[:, 4 + i] -= jump


@compiled
def _stick_matrix(q, i, wall, inward, push, other_stuck, matrix):
    """Fill the derivative (8, 8) of completing a chatter of ball i that starts with an inward speed under a push.

    Box and ball keep their momentum and centre of mass. While the gap closes, springs and dampers act on the box where
    it is and not where it will stick: the time integral of the gap is 2 u^3 / (3 a^2 (1 - kappa^3)), that of its rate
    the gap itself, and both are felt to first order in the perturbation.
    """
    e = q.epsilon
    share = e / (1.0 + e)
    matrix[:] = np.eye(8)
    for row in (i, 4 + i):
        matrix[row, :] = 0.0
        matrix[row, i], matrix[row, 4 + i] = 1.0 / (1.0 + e), share
    for row in (2 + i, 6 + i):
        matrix[row, :] = 0.0
        matrix[row, 2 + i], matrix[row, 6 + i] = 1.0 / (1.0 + e), share
    by_gap = 2.0 * inward / (push * (1.0 - q.kappa**3)) if inward > 0.0 else 0.0
    by_speed = by_gap * inward / push if inward > 0.0 else 0.0
    j = 1 - i
    stiffness = (q.k11 if i == 0 else q.k22, q.k12)
    damping = (q.c11 if i == 0 else q.c22, q.c12)
    inverse = (1.0 / (1.0 + e), 1.0 / (1.0 + e) if other_stuck else 1.0)
    for k in range(2):
        box, ball = (2 + i, 6 + i) if k == 0 else (2 + j, 6 + j)
        relative = inverse[k] * share * (damping[k] - stiffness[k] * by_gap)
        speed = -inverse[k] * share * stiffness[k] * by_speed
        matrix[box, i] += relative
        matrix[box, 4 + i] -= relative
        matrix[box, 2 + i] += speed
        matrix[box, 6 + i] -= speed
        if k == 0 or other_stuck:
            matrix[ball, :] = matrix[box, :]


@compiled
def propagate(flow, start, events, final, start_phase, duration, limit, turns):
    """Carry perturbations along a run, given by its start and final (8,) in public order and the events (m, 13)
    of the kernel.

    turns: (n, 2) rows of the time at which a ball turned before a wall, flight after flight, and of its gap there.
    Returns the Jacobian (8, 8) of the final state by the first one; the covariance (8, 8) that unit rounding errors in
    the start and after every event leave at the end, infinite past the horizon; that horizon: the time at which the
    square root of the covariance's trace first exceeds the limit (inf if never); the smallest depth that an impact cut
    off; and the smallest ratio of any gap or depth to that root just before (inf if there are none). Matrices are in
    [boxes, balls].
    """
    q = flow.coefficients
    jacobian, covariance = np.eye(8), np.zeros((8, 8))
    _add_rounding(covariance, start)
    matrix, walls, now, horizon = np.empty((8, 8)), (0, 0), 0.0, math.inf
    turned, shallowest, clearance = 0, math.inf, math.inf
    for n in range(len(events) + 1):
        stop = events[n, 0] if n < len(events) else duration
        completed = n < len(events) and events[n, 3] == STICK and events[n, 12] > 0.0
        if not completed:  # a completed chatter is carried out at its last impact, ahead of the time it ends
            while now < stop:
                step = min(stop - now, flow.longest)
                _flight(flow, walls, step, matrix)
                jacobian = matrix @ jacobian
                if horizon == math.inf:
                    covariance = matrix @ covariance @ matrix.T
                now += step
        spread = math.sqrt(max(np.trace(covariance), 0.0)) if horizon == math.inf else math.inf
        while turned < len(turns) and (turns[turned, 0] <= stop or n == len(events)):
            clearance = min(clearance, _ratio(turns[turned, 1], spread))
            turned += 1
        if n == len(events):
            if horizon == math.inf:
                _add_rounding(covariance, final)
            break
        row = events[n]
        i, wall, kind = int(row[1]) - 1, int(row[2]), int(row[3])
        after = _internal(row)
        phase = start_phase + q.omega * now
        if kind == IMPACT:
            depth = _depth(q, i, wall, after, row[12], walls, phase)
            shallowest, clearance = min(shallowest, depth), min(clearance, _ratio(depth, spread))
            walls_after = walls
            for later in events[n + 1 :]:
                if later[0] != row[0]:
                    break
                if later[3] == RELEASE:
                    walls_after = (0, walls_after[1]) if later[1] == 1 else (walls_after[0], 0)
            _impact_matrix(q, i, after, row[12], walls, walls_after, phase, matrix)
        elif kind == STICK:
            inward, push = 0.0, 0.0
            if completed:
                field = np.empty(8)
                _field(q, walls, _internal(_last_impact(events, n)), phase, field)
                inward, push = row[12], wall * field[2 + i]
            _stick_matrix(q, i, wall, inward, push, walls[1 - i] != 0, matrix)
            walls = (wall, walls[1]) if i == 0 else (walls[0], wall)
        else:
            walls = (0, walls[1]) if i == 0 else (walls[0], 0)
            matrix[:] = np.eye(8)
        jacobian = matrix @ jacobian
        if horizon < math.inf:
            continue
        covariance = matrix @ covariance @ matrix.T
        _add_rounding(covariance, row[4:12])
        if not np.trace(covariance) <= limit * limit:  # also where it is no number: an impact without velocity
            horizon = now
            covariance[:] = math.inf
    return jacobian, covariance, horizon, shallowest, clearance


@compiled
def _ratio(distance, spread):
    """How many times the spread fits into a distance; nothing is clear past the horizon."""
    return distance / spread if spread < math.inf else 0.0


@compiled
def _add_rounding(covariance, state):
    """Add a unit rounding error of a state (8,) in public order to a covariance in [boxes, balls]."""
    for k in range(8):
        covariance[k // 2 + 4 * (k % 2), k // 2 + 4 * (k % 2)] += (1.0 + abs(state[k])) ** 2


@compiled
def _last_impact(events, n):
    """The row of the last impact in the module of row n before it."""
    last = n - 1
    while events[last, 1] != events[n, 1]:
        last -= 1
    return events[last]


@compiled
def _internal(row):
    """The state of an event's row, ordered [boxes, balls]."""
    state = np.empty(8)
    for k in range(4):
        state[k], state[4 + k] = row[4 + 2 * k], row[5 + 2 * k]
    return state
