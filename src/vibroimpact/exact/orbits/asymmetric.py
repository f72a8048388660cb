"""Find asymmetric 1:1 responses (unequal flight times) by Newton's method from many starts.

T is the forcing period. Ball i hits wall +1 at the time p_i and wall -1 at the time q_i = p_i + u_i T. The velocity of
the ball changes by I_i at p_i and by -I_i at q_i. This velocity is I_i (1 - u_i) on the flight from wall +1 and -I_i
u_i on the flight back. The ball covers the distance I_i u_i (1 - u_i) T on each flight. The velocity of box i changes
by -epsilon I_i at p_i and by +epsilon I_i at q_i. The boxes respond to the forcing and to all impulses. Each module has
two equations from Newton's rule and one equation for the distance:

    (1 + kappa) X_i'(p_i-) = I_i (1 - u_i - kappa u_i + epsilon),
    (1 + kappa) X_i'(q_i-) = I_i (kappa (1 - u_i) - u_i - epsilon),
    I_i u_i (1 - u_i) T = 2 + X_i(q_i) - X_i(p_i).

The six unknowns are p_1, q_1, p_2, q_2, I_1, I_2. Symmetric motions have u_1 = u_2 = 1/2. An inactive module (see
`System.modules`) has p_i = q_i = I_i = 0.

The starts of Newton's method cover u_1, u_2 and the lag p_2 - p_1 evenly. For given u_1, u_2 and lag, the equations are
linear in four numbers: I_1, I_2, and the cosine and sine of the forcing phase. These numbers start at their
least-squares values. The method may miss roots.
"""

import numpy as np

from vibroimpact.exact.orbits.impulse_response import forced_amplitude, impulse_response
from vibroimpact.exact.orbits.newton import newton
from vibroimpact.exact.orbits.symmetric import distinct, wrapped

STARTS = 1024
_SHORTEST = 1e-6  # fraction of the period; roots with a shorter flight are spurious
_UNEQUAL = 1e-7
_BOXES = np.array([0, 0, 1, 1])
_KICKS = np.array([-1.0, 1.0, -1.0, 1.0])
MODULES = np.array([1, 1, 2, 2, 1, 2])
"""Module of each unknown (p_1, q_1, p_2, q_2, I_1, I_2), and of each equation."""
_MODULES = np.eye(2)[MODULES - 1]
# Row m: derivatives of the flight time q_i - p_i with respect to the impact times; i is the module of equation m.
_LENGTHENING = np.kron(_MODULES, [-1.0, 1.0])
_PLASTIC = 1.2207440846057596  # root of x^4 = x + 1; its inverse powers generate a low-discrepancy sequence


class AsymmetricConditions:
    """Six equations for the impact times of 1:1 motions and for the changes of ball velocity at the impacts.

    The constructor raises ValueError if the boxes have an undamped resonance.
    """

    def __init__(self, system):
        self.system = system
        self.amplitude = forced_amplitude(system)[_BOXES]
        self.idle = ~np.isin(MODULES, system.modules)
        self._response = impulse_response(system, sign=1)

    def __call__(self, unknowns: np.ndarray):
        """Return the residuals of the six equations, shape (n, 6), and their Jacobians, shape (n, 6, 6).

        unknowns: p_1, q_1, p_2, q_2, I_1, I_2 in each row, shape (n, 6).
        """
        system = self.system
        times, strengths = unknowns[:, :4], unknowns[:, 4:]
        forced = self.amplitude * np.exp(1j * system.Omega * times)
        by_strength, by_kick = self._linear(times)
        residual = (by_strength @ strengths[..., None])[..., 0] + self._forced(forced)
        residual[:, 4:] -= 2.0
        jacobian = np.concatenate([self._moved(forced, by_kick, strengths, times), by_strength], axis=2)
        residual[:, self.idle], jacobian[:, self.idle] = unknowns[:, self.idle], np.eye(6)[self.idle]
        return residual, jacobian

    def linear_system(self, times: np.ndarray):
        """Return the coefficients of the six equations in four unknowns, shape (n, 6, 4).

        The unknowns are the changes of ball velocity I_1, I_2, and the cosine and sine of the forcing phase. times:
        impact times, shape (n, 4).
        """
        forced = self.amplitude * np.exp(1j * self.system.Omega * times)
        by_phase = np.stack([self._forced(forced), self._forced(1j * forced)], axis=2)
        return np.concatenate([self._linear(times)[0], by_phase], axis=2)

    def _forced(self, forced):
        """Return the terms of the six equations that come from the forcing, shape (n, 6).

        forced: complex response of the boxes to the forcing at each impact, shape (n, 4).
        """
        velocity = (1 + self.system.kappa) * self.system.Omega * forced.real
        distance = forced.imag[:, 0::2] - forced.imag[:, 1::2]
        return np.concatenate([velocity, distance], axis=1)

    def _linear(self, times):
        """Return the coefficients of I_1 and I_2 in the six equations, and the responses of the boxes to the impacts.

        The coefficients have shape (n, 6, 2). The responses are two arrays of shape (n, 4, 4): velocities and
        accelerations. Entry [:, m, k] is the response to impact k, which is repeated in every period with I_i = 1. It
        is the response of the box in the module of impact m, just before impact m.
        """
        system = self.system
        x, v, a = (system.epsilon * _KICKS * r for r in self._response.between(times, _BOXES))
        by_impact = np.concatenate([(1 + system.kappa) * v, x[:, 0::2] - x[:, 1::2]], axis=1)
        u = self._fractions(times)
        at_walls = [1 - u - system.kappa * u + system.epsilon, system.kappa * (1 - u) - u - system.epsilon]
        own = np.concatenate([np.stack(at_walls, axis=2).reshape(-1, 4), -u * (1 - u) * system.period], axis=1)
        return by_impact.reshape(-1, 6, 2, 2).sum(axis=3) - _MODULES * own[..., None], (v, a)

    def _fractions(self, times):
        """Return the flight times from wall +1 as fractions of the period, u_1 and u_2, shape (n, 2)."""
        return wrapped(times[:, 1::2] - times[:, 0::2], self.system.period) / self.system.period

    def _moved(self, forced, responses, strengths, times):
        """Return the derivatives of the residuals with respect to the impact times, shape (n, 6, 4).

        forced: response to the forcing as for `_forced`.
        responses: responses to impacts from `_linear`.
        strengths: changes of ball velocity I_1, I_2, shape (n, 2).
        times: impact times, shape (n, 4).
        """
        system = self.system
        others = 1 - np.eye(4)
        v, a = (r * others * strengths[:, None, _BOXES] for r in responses)
        by_own = np.eye(4)
        displacement = by_own * (system.Omega * forced.real + v.sum(axis=2))[:, None, :] - v
        velocity = by_own * (a.sum(axis=2) - system.Omega**2 * forced.imag)[:, None, :] - a
        moved = np.concatenate([(1 + system.kappa) * velocity, displacement[:, 0::2] - displacement[:, 1::2]], axis=1)
        slope = (1 + system.kappa) / system.period * strengths[:, _BOXES]
        lengthening = np.concatenate([slope, strengths * (1 - 2 * self._fractions(times))], axis=1)
        return moved + _LENGTHENING * lengthening[..., None]


def asymmetric_solutions(system):
    """Return the roots, shape (n, 6), and the number of Newton starts that led to each root or to its mirror image.

    A root and its mirror image are separate rows.
    """
    if not system.modules:
        return np.empty((0, 6)), np.empty(0, dtype=int)
    period = system.period
    conditions = AsymmetricConditions(system)
    found = newton(conditions, _starts(system, conditions))
    found[:, :4] = wrapped(found[:, :4], period)
    u = wrapped(found[:, 1:4:2] - found[:, 0:4:2], period)[:, np.array(system.modules) - 1] / period
    genuine = (u > _SHORTEST).all(axis=1) & (u < 1 - _SHORTEST).all(axis=1) & (abs(u - 0.5) > _UNEQUAL).any(axis=1)
    found = found[genuine]
    # The mirror images, state(tau) -> -state(tau + T/2), exchange the walls.
    images = np.concatenate([wrapped(found[:, [1, 0, 3, 2]] + period / 2, period), found[:, 4:]], axis=1)
    images[:, conditions.idle] = 0.0
    return distinct(np.concatenate([found, images]), period, 4)


def _starts(system, conditions):
    lag, first, second = (np.arange(1, STARTS + 1) / _PLASTIC**k % 1.0 for k in (1, 2, 3))
    zero = np.zeros(STARTS)
    times = np.stack([zero, first, lag, lag + second], axis=1) * system.period
    matrices = conditions.linear_system(times)
    constant = np.array([0.0, 0.0, 0.0, 0.0, 2.0, 2.0])
    matrices[:, conditions.idle], constant[conditions.idle] = 0.0, 0.0
    solutions = np.linalg.pinv(matrices) @ constant
    shift = np.arctan2(solutions[:, 3], solutions[:, 2]) / system.Omega
    found = np.concatenate([times + shift[:, None], solutions[:, :2]], axis=1)
    found[:, conditions.idle] = 0.0
    return found
