"""Find all fixed points of the slow flow at which the two flights of a module are unequal, by Newton's method.

The manifold of a module has three parts, called charts (see `branch`). On a chart, a parameter x_i in [-1, 1] describes
module i. The complex amplitude of the module is z_i u_i / beta_i with |u_i| = 1, where z_i and beta_i are polynomials
in x_i. The balance of the slow flow is a linear system for u_1 / beta_1 and u_2 / beta_2. The coefficients of this
system depend on x_1 and x_2 alone (docs/derivation.md, section 11). Cramer's rule gives u_i / beta_i = m_i / Delta,
with the determinant Delta. In the code, m_1 and m_2 are called n1 and n2. Since |u_i| = 1, a fixed point satisfies
|Delta|^2 = |beta_1 m_1|^2 = |beta_2 m_2|^2. Newton's method solves these two equations from a grid of initial pairs
(x_1, x_2). For a given system, `completeness.points` can prove that no fixed point is missed.

On the asymmetric chart, x_i = v^2, where v is the difference of the two flight times of a cycle, divided by the period.
A fixed point with v^2 < 0 is not a motion at leading order. Such a point is kept, since terms of order epsilon may
raise v^2 above 0. A motion then exists close to the point.
"""

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial
from scipy.linalg import eigvals

from vibroimpact.exact.orbits.newton import newton
from vibroimpact.studies.theory import branch
from vibroimpact.studies.theory.branch import ASYMMETRIC, LARGE, SMALL, charts
from vibroimpact.system import System
from vibroimpact.system.arguments import instance
from vibroimpact.system.representation import Representation, brief
from vibroimpact.system.verdict import all_stable, verdict
from vibroimpact.theory import masri
from vibroimpact.theory.fixed_points.symmetric_points import refuse_free_motion
from vibroimpact.theory.manifold import stays_within_walls
from vibroimpact.theory.slow_flow import descending, impedances, pencil

PAIRS = [pair for pair in itertools.product((SMALL, LARGE, ASYMMETRIC), repeat=2) if ASYMMETRIC in pair]
_STARTS = 20  # Newton's method starts from _STARTS^2 points in the square |x_1| <= 1, |x_2| <= 1.
_REACH = 0.25
_SAME = 1e-7
_ROUNDING = 1e-10  # rounding error of an eigenvalue, relative to the largest eigenvalue


@dataclass(frozen=True, eq=False, repr=False)
class AsymmetricPoint(Representation):
    """A fixed point of the slow flow with unequal flights in one or both modules.

    The point also represents its mirror images, in which the long and the short flight of a module are exchanged. For
    an inactive module, `squared`, `C`, `B`, `psi` and `middle` are NaN.

    C: amplitude of the saw-tooth in each module, shape (2,).
    B: amplitude of U in each module, shape (2,).
    psi: phase lag of U in each module [rad], shape (2,).
    slow_eigenvalues: eigenvalues of the slow flow, two for each active module.
    """

    charts: tuple[str, str]  # name of the chart (part of the manifold) of each module, see `branch`
    x: np.ndarray  # parameter that describes each module in its chart
    asymmetric: np.ndarray  # True for each module on the asymmetric branch
    squared: np.ndarray  # v^2, where v is the difference of the two flight times divided by the period
    C: np.ndarray
    B: np.ndarray
    psi: np.ndarray
    middle: np.ndarray  # phase of U_i [rad] half-way from the impact with W_i = +1 to the next impact
    slow_eigenvalues: np.ndarray

    def fast(self, kappa) -> np.ndarray:
        """Return the multipliers of the impact maps over a cycle, two for each active module.

        The amplitude B and the phase phi of U are constant in these maps.
        """
        return np.concatenate([one[1] for one in self._modules(kappa)])

    def fast_verdict(self, kappa) -> str:
        """Return the stability of the impact maps: "stable", "unstable", or "undecided" because of rounding.

        If v^2 < 0 in a module, the result is "unstable".
        """
        return all_stable(one[0] for one in self._modules(kappa))

    def _modules(self, kappa):
        for skewed, C, squared in self._active():
            theory, x = (branch, squared) if skewed else (masri, C)
            yield theory.stable(x, kappa), theory.multipliers(x, kappa)

    def _active(self):
        """Return an iterator over the active modules, with the values (asymmetric, C, v^2) of each module."""
        part = np.isfinite(self.C)
        return zip(self.asymmetric[part], self.C[part], self.squared[part], strict=True)

    def slow_verdict(self) -> str:
        """Return the stability of the point in the slow flow: "stable", "unstable", or "undecided" because of rounding.

        The real parts of the eigenvalues decide.
        """
        values = self.slow_eigenvalues
        return all_stable(verdict(-value.real, _ROUNDING * np.abs(values).max()) for value in values)

    def admissible(self, kappa) -> bool:
        """Return True if the point is a motion at leading order and both balls stay between their walls."""
        return self.real and all(
            branch.overshoot(np.sqrt(squared), kappa) == 0 if skewed else stays_within_walls(C, kappa)
            for skewed, C, squared in self._active()
        )

    @property
    def real(self) -> bool:
        """True if the point is a motion at leading order, which means that v^2 is not negative in any module."""
        return not (self.squared < 0).any()

    def _shown(self):
        numbers = {name: brief(getattr(self, name)) for name in ("squared", "C", "B", "psi")}
        return {**numbers, "slow_eigenvalues": f"real parts up to {brief(self.slow_eigenvalues.real.max())}"}


class Balance:
    """The two conditions for the parameters (x_1, x_2) of a fixed point, if the chart of each module is given.

    For an inactive module i, condition i is x_i = 0.
    """

    def __init__(self, system: System, pair: tuple[str, str]):
        one, two = (charts(system.kappa)[name] for name in pair)
        self._idle = ~np.isin([1, 2], system.modules)
        e, self.K = impedances(system)
        f1, f2, total = system.f10_hat, system.f20_hat, (system.f10_hat + system.f20_hat) * self.K
        q1, q2 = (
            Polynomial([1.0]) if idle else impedance * chart.z + chart.n
            for idle, impedance, chart in zip(self._idle, e, (one, two), strict=True)
        )
        n1, n2 = f1 * q2 + total * two.z, f2 * q1 + total * one.z
        sides = (q1, 0), (q2, 1), (one.z, 0), (two.z, 1), (n1, 1), (n2, 0), (one.beta, 0), (two.beta, 1)
        self._functions = [(function, function.deriv(), side) for function, side in sides]

    def __call__(self, x):
        """Return the residuals of the conditions, shape (n, 2), and their Jacobians, shape (n, 2, 2).

        x: n pairs of parameters (x_1, x_2), shape (n, 2).
        """
        q1, q2, z1, z2, n1, n2, b1, b2 = (
            np.array([f(x[:, side]), (1 - side) * slope(x[:, side]), side * slope(x[:, side])])
            for f, slope, side in self._functions
        )
        size = _size(_product(q1, q2) + self.K * (_product(z1, q2) + _product(q1, z2)))
        residual, *slopes = np.stack([size - _size(_product(b1, n1)), size - _size(_product(b2, n2))], axis=-1)
        return np.where(self._idle, x, residual), np.where(self._idle[:, None], np.eye(2), np.stack(slopes, axis=-1))

    def phasors(self, x):
        """Return the complex amplitudes b_i = B_i exp(-i psi_i) of both modules at x = (x_1, x_2), shape (2,)."""
        q1, q2, z1, z2, n1, n2, _, _ = (f(x[side]) for f, _, side in self._functions)
        return np.array([z1 * n1, z2 * n2]) / (q1 * q2 + self.K * (z1 * q2 + q1 * z2))


def _product(one, other):
    """Return the product of two functions of (x_1, x_2).

    Each function is an array of shape (3, n). The rows are its values at n points, its derivatives with respect to x_1,
    and its derivatives with respect to x_2.
    """
    return np.array([one[0] * other[0], *(one[1:] * other[0] + one[0] * other[1:])])


def _size(function):
    """Return the squared modulus of a complex function of (x_1, x_2), with its derivatives.

    The function and the squared modulus are arrays of shape (3, n). Row 0 contains the values at n points. Rows 1 and 2
    contain the derivatives with respect to x_1 and to x_2.
    """
    return (function[0].conj() * function).real * np.array([[1], [2], [2]])


def fixed_points(system: System) -> list[AsymmetricPoint]:
    """Return all fixed points with unequal flights in at least one module and with C_1, C_2 >= 0.

    The points are in ascending order of C_1. Points with v^2 < 0 are included.

    Raises
    ------
    ValueError
        If `system` is not a System, or if the fixed points may form a continuum.
    """
    return [point for point in search(system) if not (point.C < 0).any()]


def search(system: System) -> list[AsymmetricPoint]:
    """Return all fixed points with unequal flights in at least one module, including points with a negative C_i.

    Raises
    ------
    ValueError
        As for `fixed_points`.
    """
    refuse_free_motion(instance("system", system, System))
    found = [_point(system, pair, x) for pair in pairs_of(system, PAIRS) for x in _zeros(Balance(system, pair))]
    return sorted(found, key=lambda point: tuple(np.nan_to_num(point.C)))


def pairs_of(system, pairs) -> list[tuple[str, str]]:
    """Return those pairs of charts in `pairs` that can contain fixed points of the system.

    A pair contains the name of one chart per module. The only chart of an inactive module is SMALL.
    """
    idle = {1, 2} - set(system.modules)
    return [pair for pair in pairs if system.modules and all(pair[module - 1] == SMALL for module in idle)]


def _zeros(conditions):
    """Return the distinct zeros of the conditions in the square |x_i| <= 1, shape (n, 2)."""
    ticks = (2 * np.arange(_STARTS) + 1) / _STARTS - 1
    x = np.stack(np.meshgrid(ticks, ticks, indexing="ij"), axis=-1).reshape(-1, 2)
    zeros, distinct = newton(conditions, x, _REACH), np.empty((0, 2))
    for zero in zeros[(np.abs(zeros) <= 1).all(axis=1)]:
        if not (np.abs(distinct - zero).max(axis=1) < _SAME).any():
            distinct = np.vstack([distinct, zero])
    return distinct


def _point(system, pair, x):
    places = [(charts(system.kappa)[name], value) for name, value in zip(pair, x, strict=True)]
    psi = -np.angle(Balance(system, pair).phasors(x))
    alone = np.where(np.isin([1, 2], system.modules), 1.0, np.nan)
    C = np.array([chart.amplitudes(value)[0] for chart, value in places])
    B, ball, B_x, ball_x = np.transpose([chart.ball(value) for chart, value in places])
    asymmetric = np.array([name == ASYMMETRIC for name in pair])
    return AsymmetricPoint(
        charts=pair,
        x=x,
        asymmetric=asymmetric,
        squared=alone * np.where(asymmetric, x, 0.0),
        C=alone * C,
        B=alone * B.real,
        psi=alone * psi,
        middle=alone * np.angle([-chart.z(value) / chart.beta(value) for chart, value in places]),
        slow_eigenvalues=descending(eigvals(*pencil(system, psi, B.real, ball, B_x.real, ball_x))),
    )
