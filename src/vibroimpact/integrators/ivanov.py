"""Ivanov's transformation, extended to two walls: coordinates in which impacts are continuous.

The box is unfolded (Zhuravlev 1976) into cells n = 0, +-1, +-2, ... on a line s. On this line the ball passes through
the walls, which are at odd s. The relative displacement is W = T(s), where T is a triangular wave of slope +1 or -1. A
coordinate v replaces the velocity of the ball: W' = T'(s) R v. The factor R jumps at the walls (Ivanov 1994),

    R = 1 + k sgn(v) p,   k = (1 - kappa) / (1 + kappa),   p = s - 2n in [-1, 1] in cell n,   T = (-1)^n p.

R falls from 1 + k to 1 - k when the ball passes through a wall. Since (1 - k) / (1 + k) = kappa, v is continuous. With
the acceleration a of W in flight,

    s' = R v,   v' = (-1)^n a / R - k v |v|.

The other coordinate of a module is the centre of mass (X + epsilon Y) / (1 + epsilon) of box and ball. An impact does
not change the velocity of the centre of mass. The acceleration of the centre of mass is a / (1 + epsilon).

All eight coordinates are continuous. Their derivatives jump at walls and where v changes its sign. A step of length h
across a jump has an error of order h in any integrator. So the classical Runge-Kutta method, which is used here, is of
first order unless steps end at the jumps. A ball cannot rest on a wall; it continues to impact.
"""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import disk_cached
from vibroimpact.integrators.protocol import UNFINISHED, Method, MethodRun, failed
from vibroimpact.integrators.right_hand_side import accelerations, coefficients
from vibroimpact.system.state import BALLS, BOXES

SHORTEST, PATIENCE = 1e-6, 100
"""A run is stopped after more than PATIENCE successive jumps, each less than SHORTEST [tau] after the previous jump."""
HALVINGS = 50  # number of bisections that locate a jump within a step


class Ivanov(Method):
    """Fixed-step integration in Ivanov's coordinates; the setting is the number of steps per cycle.

    located: True if steps end where the right-hand side jumps.
    """

    family, knob, limit = "transformed coordinates", "steps per cycle", 30_000_000

    def __init__(self, name: str, located: bool, settings, careful, order):
        self.name, self.settings, self.careful, self.order = name, settings, careful, order
        self._located = located

    def run(self, system, state, cycles, tau0, setting):
        if setting * cycles > self.limit:
            return failed(UNFINISHED, f"{self.limit} steps end after {self.limit / setting:g} cycles", 0)
        k, step = (1.0 - system.kappa) / (1.0 + system.kappa), system.period / setting
        start = unfolded(np.array(state, dtype=float), system.epsilon, k)
        march = _march_to_jumps if self._located else _march_across_jumps
        z, boxes, rows, steps, stuck = march(coefficients(system), k, start, tau0, step, setting * cycles)
        if not math.isnan(stuck):
            return failed(UNFINISHED, f"impacts without end at tau = {stuck:.6g}", steps, 4 * steps, rows)
        return MethodRun(folded(z, boxes, system.epsilon, k), rows, steps, 4 * steps)


def unfolded(state, epsilon: float, k: float) -> np.ndarray:
    """Return the unfolded coordinates (8,) of a state (8,), with both balls in cell n = 0.

    The four coordinates of a module are s, v, and the displacement and velocity of the centre of mass.
    """
    x, y = state[BOXES], state[BALLS]
    W, W_rate = x[:2] - y[:2], x[2:] - y[2:]
    centre = (x + epsilon * y) / (1.0 + epsilon)
    return np.stack([W, W_rate / (1.0 + k * np.sign(W_rate) * W), centre[:2], centre[2:]], axis=1).ravel()


def folded(z, boxes, epsilon: float, k: float) -> np.ndarray:
    """Return the state (8,) for unfolded coordinates z (8,); `boxes` (2,) contains the cell n of each ball."""
    s, v, centre, rate = z.reshape(2, 4).T
    p, sign = s - 2.0 * boxes, 1.0 - 2.0 * (boxes % 2)
    W, W_rate = sign * p, sign * (1.0 + k * np.sign(v) * p) * v
    state = np.empty(8)
    state[BOXES] = np.concatenate([centre + epsilon / (1.0 + epsilon) * W, rate + epsilon / (1.0 + epsilon) * W_rate])
    state[BALLS] = state[BOXES] - np.concatenate([W, W_rate])
    return state


@disk_cached(error_model="numpy")
def _rates(tau, z, q, k, boxes, signs, d):
    """Write the derivative of the unfolded coordinates into d, for given cells (`boxes`) and signs of v (`signs`).

    The given cells and signs may differ from those at z.
    """
    share, s = q[9] / (1.0 + q[9]), np.empty(8)
    for i in range(2):
        sign, p, v = 1.0 - 2.0 * (boxes[i] % 2), z[4 * i] - 2.0 * boxes[i], z[4 * i + 1]
        d[4 * i] = (1.0 + k * signs[i] * p) * v
        s[2 * i], s[2 * i + 4] = z[4 * i + 2] + share * sign * p, z[4 * i + 3] + share * sign * d[4 * i]
    a = accelerations(math.sin(q[8] * tau), s, q, (0.0, 0.0))
    for i in range(2):
        sign, p, v = 1.0 - 2.0 * (boxes[i] % 2), z[4 * i] - 2.0 * boxes[i], z[4 * i + 1]
        d[4 * i + 1] = sign * a[i] / (1.0 + k * signs[i] * p) - k * signs[i] * v * v
        d[4 * i + 2], d[4 * i + 3] = z[4 * i + 3], a[i] / (1.0 + q[9])


@disk_cached()
def _step(tau, z, h, q, k, boxes, signs, locate):
    """Return the coordinates after a step of length h.

    If `locate` is True, each Runge-Kutta stage uses the cells and the signs of v at the coordinates of this stage.
    Otherwise all stages use the given `boxes` and `signs`.
    """
    rates, ahead, at = np.empty(8), z.copy(), z.copy()
    for stage in range(4):
        if locate:
            _locate(at, boxes, signs)
        _rates(tau + (0.0, 0.5, 0.5, 1.0)[stage] * h, at, q, k, boxes, signs, rates)
        for c in range(8):
            ahead[c] += (1.0, 2.0, 2.0, 1.0)[stage] * h / 6.0 * rates[c]
            at[c] = z[c] + (0.5, 0.5, 1.0, 0.0)[stage] * h * rates[c]
    return ahead


@disk_cached()
def _locate(z, boxes, signs):
    """Write the cell of each ball into `boxes`, and the sign of each v into `signs`.

    A ball on a wall is in the cell that it enters.
    """
    for i in range(2):
        signs[i] = 1.0 if z[4 * i + 1] >= 0.0 else -1.0
        there = 0.5 * (z[4 * i] + signs[i])
        boxes[i] = math.floor(there) if signs[i] > 0.0 else math.ceil(there)


@disk_cached()
def _impact(tau, i, box, direction, speed, k):
    """Return the row (tau, module, wall, speed) of the impact at which ball i leaves the cell with the index `box`."""
    return tau, i + 1.0, (1.0 - 2.0 * (box % 2)) * direction, (1.0 + k) * abs(speed)


@disk_cached()
def _march_across_jumps(q, k, z, tau0, h, count):
    """Take `count` steps of length h without locating the jumps.

    Return the last coordinates, the cells of the balls, the impacts, the number of steps, and NaN. The NaN stands in
    place of the time of an endless chatter (see `_march_to_jumps`), which this function cannot detect.
    """
    rows = [(0.0, 0.0, 0.0, 0.0) for _ in range(0)]
    before, boxes, signs = np.zeros(2, np.int64), np.zeros(2, np.int64), np.ones(2)
    for n in range(count):
        ahead = _step(tau0 + n * h, z, h, q, k, boxes, signs, True)
        _locate(ahead, boxes, signs)
        for i in range(2):
            if boxes[i] != before[i]:
                wall = before[i] + boxes[i]  # unfolded position s of the wall between the two cells
                part = (wall - z[4 * i]) / (ahead[4 * i] - z[4 * i])
                direction = 1.0 if boxes[i] > before[i] else -1.0
                rows.append(_impact(tau0 + (n + part) * h, i, before[i], direction, ahead[4 * i + 1], k))
        z, before = ahead, boxes.copy()
    return z, boxes, rows, count, math.nan


@disk_cached()
def _march_to_jumps(q, k, z, tau0, h, count):
    """Take `count` steps of length h, and divide each step at the jumps within it.

    Return the last coordinates, the cells of the balls, the impacts, the number of steps including parts of steps, and
    the time of an endless chatter (impacts in ever shorter flights). The time is NaN if there is no endless chatter.
    """
    rows = [(0.0, 0.0, 0.0, 0.0) for _ in range(0)]
    boxes, signs, idle, steps = np.zeros(2, np.int64), np.ones(2), 0, 0
    for i in range(2):
        signs[i] = 1.0 if z[4 * i + 1] >= 0.0 else -1.0
    for n in range(count):
        done = 0.0
        while done < 1.0:
            tau, part = tau0 + (n + done) * h, 1.0 - done
            ahead, steps = _step(tau, z, part * h, q, k, boxes, signs, False), steps + 1
            if _beyond(ahead, boxes, signs):
                part, ahead = _first_jump(tau, z, part, h, q, k, boxes, signs)
                for i in range(2):
                    to_wall, speed = _ahead_of(ahead, i, boxes, signs)
                    if to_wall < 0.0:
                        rows.append(_impact(tau + part * h, i, boxes[i], signs[i], ahead[4 * i + 1], k))
                        ahead[4 * i], boxes[i] = 2 * boxes[i] + signs[i], boxes[i] + int(signs[i])
                    elif speed < 0.0:
                        ahead[4 * i + 1], signs[i] = 0.0, -signs[i]
                idle = idle + 1 if part * h < SHORTEST else 0
                if idle > PATIENCE:
                    return ahead, boxes, rows, steps, tau
            z, done = ahead, done + part
    return z, boxes, rows, steps, math.nan


@disk_cached()
def _first_jump(tau, z, part, h, q, k, boxes, signs):
    """Locate the first jump of the right-hand side in a step of length `part` times h.

    Shorten the step so that it ends just after the jump. Return its length divided by h, and the coordinates at its
    end.
    """
    least, ahead = 0.0, _step(tau, z, part * h, q, k, boxes, signs, False)
    for _ in range(HALVINGS):
        half = 0.5 * (least + part)
        there = _step(tau, z, half * h, q, k, boxes, signs, False)
        if _beyond(there, boxes, signs):
            part, ahead = half, there
        else:
            least = half
    return part, ahead


@disk_cached()
def _beyond(z, boxes, signs):
    """Return True if a ball has passed a wall, if its v has changed its sign, or if its s or v is nan."""
    within = True
    for i in range(2):
        to_wall, speed = _ahead_of(z, i, boxes, signs)
        within = within and to_wall >= 0.0 and speed >= 0.0
    return not within


@disk_cached()
def _ahead_of(z, i, boxes, signs):
    """Return the distance of ball i to the wall ahead, and the coordinate v of ball i times its sign in `signs`.

    The distance is negative after the ball has passed the wall. The second number is negative after v has changed its
    sign.
    """
    return 1.0 - signs[i] * (z[4 * i] - 2.0 * boxes[i]), signs[i] * z[4 * i + 1]


METHODS = [
    Ivanov("Ivanov", False, (100, 300, 1_000, 3_000, 10_000, 30_000), careful=30_000, order=1),
    Ivanov("Ivanov, events", True, (10, 30, 100, 300, 1_000, 3_000), careful=3_000, order=4),
]
"""One method without and one with location of the jumps."""
