"""Evaluate the equations of asymmetric.py in interval arithmetic.

The six unknowns are p_1, q_1, p_2, q_2, I_1, I_2. Ball i hits wall +1 at the time p_i and wall -1 at the time q_i. The
velocity of ball i changes by I_i at p_i and by -I_i at q_i. An inactive module has p_i = q_i = I_i = 0. The equations
are smooth as long as the order of the impacts does not change. Symmetric orbits are also roots. The impacts have
numbers: 0 and 1 are the impacts of module 1 at wall +1 and at wall -1, and 2 and 3 are those of module 2.
"""

import itertools

import numpy as np
from flint import acb, acb_mat, arb, arb_mat

from vibroimpact.system.matrices import rate_matrix

WALLS = (1, -1, 1, -1)
_KICKS = (-1, 1, -1, 1)
_UNKNOWNS = 6
_UNIT_IMPULSES = arb_mat(np.eye(4)[:, 2:].tolist())


class SteadyBoxes:
    """Steady motions [X1, X2, X1', X2'] of the boxes: one under the forcing, the others under trains of unit impulses.

    The float64 matrices and the forcing are taken as exact. The constructor raises ValueError if the boxes have an
    undamped resonance.

    sign: as in `ImpulseResponse`.
    start: state just after each impulse of a train, without forcing, shape (4, 2). Column j is for a train on box j.
    amplitude: complex amplitude of the motion under the forcing alone, shape (4, 1). This motion is
    Im(amplitude exp(i Omega tau)).
    """

    def __init__(self, system, sign: int):
        rate = rate_matrix(system.with_inactive_damped())
        self.omega = arb(system.Omega)
        self.period = 2 * arb.pi() / self.omega
        self.rate = arb_mat(rate[:4, :4].tolist())
        closure = identity(4) - sign * (self.rate * (self.period if sign == 1 else self.period / 2)).exp()
        try:
            self.start = closure.solve(_UNIT_IMPULSES)
            receptance = acb_mat(identity(4)) * acb(0, self.omega) - acb_mat(self.rate)
            self.amplitude = receptance.solve(acb_mat([[acb(f)] for f in rate[:4, 4].tolist()]))
        except ZeroDivisionError:
            raise ValueError(
                "system: the boxes have an undamped resonance at the forcing frequency or a multiple of it; add "
                "damping (gamma1_hat, gamma2_hat)"
            ) from None


def identity(size: int) -> arb_mat:
    """Return the unit matrix (size, size)."""
    return arb_mat(np.eye(size).tolist())


class EnclosedConditions:
    """The six equations of asymmetric.py in interval arithmetic.

    The float64 matrices and the forcing are taken as exact. The constructor raises ValueError if the boxes have an
    undamped resonance.
    """

    def __init__(self, system):
        self.boxes = SteadyBoxes(system, sign=1)
        self.period = self.boxes.period
        self.modules = [module - 1 for module in system.modules]
        self.impacts = [m for m in range(4) if m // 2 in self.modules]
        self.epsilon, self.kappa = arb(system.epsilon), arb(system.kappa)

    def __call__(self, unknowns):
        """Return enclosures of the residual, shape (6, 1), and of the Jacobian, shape (6, 6).

        If two impacts may coincide, return None. unknowns: intervals of p_1, q_1, p_2, q_2, I_1, I_2.
        """
        lags = self.lags(unknowns)
        if lags is None:
            return None
        boxes, one = {m: self.before(m, unknowns, lags) for m in self.impacts}, _jet(arb(1))
        outward, rows = 1 + self.kappa, []
        for i, (start, end) in enumerate(((0, 1), (2, 3))):
            if i not in self.modules:
                rows += [_jet(unknowns[k], k) for k in (start, end, 4 + i)]
                continue
            u, strength = _jet(self.fraction(i, lags)), _jet(unknowns[4 + i], 4 + i)
            u[1 + start], u[1 + end] = -1 / self.period, 1 / self.period
            rows += [
                outward * boxes[start][2 + i] + _product(strength, outward * u - (1 + self.epsilon) * one),
                outward * boxes[end][2 + i] + _product(strength, outward * u - (self.kappa - self.epsilon) * one),
                boxes[start][i] - boxes[end][i] - 2 * one + self.period * _product(strength, _product(u, one - u)),
            ]
        return arb_mat([row[:1].tolist() for row in rows]), arb_mat([row[1:].tolist() for row in rows])

    def lags(self, unknowns):
        """Return {(m, k): time from impact k to the next impact m}, or None if two impacts may coincide."""
        lags = {}
        for m, k in itertools.permutations(self.impacts, 2):
            lag = unknowns[m] - unknowns[k]
            lag += self.period if lag.mid() < 0 else 0
            if not (lag > 0 and lag < self.period):
                return None
            lags[m, k] = lag
        return lags

    def fraction(self, i, lags):
        """Return the flight time of ball i (0 or 1) from wall +1 as a fraction of the period."""
        return lags[2 * i + 1, 2 * i] / self.period

    def before(self, m, unknowns, lags):
        """Return the state of the boxes just before impact m, and the derivatives of this state, shape (4, 7).

        Column 0 is the state. The other columns are its derivatives with respect to the six unknowns. lags: result of
        the method `lags`.
        """
        rate = acb(0, self.boxes.omega)
        forced = (self.boxes.amplitude * (rate * unknowns[m]).exp()).entries()
        state = np.full((4, 1 + _UNKNOWNS), arb(0))
        state[:, 0], state[:, 1 + m] = [entry.imag for entry in forced], [(entry * rate).imag for entry in forced]
        for k in self.impacts:
            box, kick = k // 2, _KICKS[k] * self.epsilon
            motion = self.boxes.start if m == k else (self.boxes.rate * lags[m, k]).exp() * self.boxes.start
            motion = arb_mat([[kick * (motion[row, box] - int(m == k and row == 2 + box))] for row in range(4)])
            response = np.full((4, 1 + _UNKNOWNS), arb(0))
            response[:, 0] = motion.entries()
            if k != m:
                response[:, 1 + m] = (self.boxes.rate * motion).entries()
                response[:, 1 + k] = -response[:, 1 + m]
            state = state + [_product(row, _jet(unknowns[4 + box], 4 + box)) for row in response]
        return state


def _jet(value, unknown=None):
    """Return a jet: a value and its derivatives with respect to the six unknowns, shape (7,).

    The derivative is 1 for the unknown with the index `unknown`, and 0 for each other unknown.
    """
    return np.array([value, *(arb(int(k == unknown)) for k in range(_UNKNOWNS))])


def _product(one, other):
    """Return the product of the jets `one` and `other`, each of shape (7,) as from `_jet`."""
    return np.array([one[0] * other[0], *(one[1:] * other[0] + one[0] * other[1:])])
