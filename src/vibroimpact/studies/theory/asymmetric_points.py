"""All fixed points of the slow flow with an asymmetric module, by Newton's method from a grid of starts.

As for symmetric ones (docs/derivation.md, section 5) the balance is linear in w_i = u_i / beta_i and its coefficients
depend on the chart parameters x_i alone, here over compact squares: |Delta|^2 = |beta_1 n_1|^2 = |beta_2 n_2|^2. That
none is missed is proved by `theory.completeness_proof`, not here.

v^2 < 0 is kept too: no motion at leading order, but where the branch goes on beyond symmetry breaking. A motion next to
it exists once terms of order epsilon carry v^2 above 0.
"""

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial
from scipy.linalg import eigvals

from vibroimpact.exact.orbits.newton import newton
from vibroimpact.studies.theory import branch
from vibroimpact.studies.theory.branch import ASYMMETRIC, LARGE, SMALL, Chart, charts
from vibroimpact.system import System
from vibroimpact.system.arguments import instance
from vibroimpact.system.representation import Representation, brief
from vibroimpact.system.verdict import all_stable, verdict
from vibroimpact.theory import masri
from vibroimpact.theory.fixed_points.symmetric_points import refuse_free_motion
from vibroimpact.theory.manifold import stays_within_walls
from vibroimpact.theory.slow_flow import descending, impedances, pencil

PAIRS = [pair for pair in itertools.product((SMALL, LARGE, ASYMMETRIC), repeat=2) if ASYMMETRIC in pair]
_STARTS = 20  # along each edge of the square
_REACH = 0.25
_SAME = 1e-7
_ROUNDING = 1e-10  # of an eigenvalue, in units of the largest one


@dataclass(frozen=True, eq=False, repr=False)
class AsymmetricPoint(Representation):
    """A fixed point with unequal flights of one module or both; it stands for its mirror images, too.

    Of a single machine it is that of the module that takes part: of the other, squared, C, B, psi and middle are NaN.

    Attributes
    ----------
    charts : tuple of str
        Chart of each module.
    x : ndarray
        Parameter of each module in its chart, shape (2,).
    asymmetric : ndarray
        True for a module on the asymmetric branch, shape (2,).
    squared : ndarray
        v^2 of each module, shape (2,), with the difference v of its flights over the period; 0 if symmetric.
    C, B, psi, slow_eigenvalues : ndarray
        As for a FixedPoint.
    middle : ndarray
        Phase of U half-way from the impact with W = +1 to the next one [rad], shape (2,).
    """

    charts: tuple[str, str]
    x: np.ndarray
    asymmetric: np.ndarray
    squared: np.ndarray
    C: np.ndarray
    B: np.ndarray
    psi: np.ndarray
    middle: np.ndarray
    slow_eigenvalues: np.ndarray

    def fast(self, kappa) -> np.ndarray:
        """Return the multipliers of the impact maps of both modules over a cycle, shape (4,).

        B and phi are held constant. A single machine has shape (2,).
        """
        return np.concatenate([one[1] for one in self._modules(kappa)])

    def fast_verdict(self, kappa) -> str:
        """Return "stable", "unstable" or "undecided" by the impact maps of both modules.

        A point with v^2 below 0 is unstable.
        """
        return all_stable(one[0] for one in self._modules(kappa))

    def _modules(self, kappa):
        for skewed, C, squared in self._taking_part():
            theory, x = (branch, squared) if skewed else (masri, C)
            yield theory.stable(x, kappa), theory.multipliers(x, kappa)

    def _taking_part(self):
        """Return asymmetric, C and v^2 of each module that takes part."""
        part = np.isfinite(self.C)
        return zip(self.asymmetric[part], self.C[part], self.squared[part], strict=True)

    def slow_verdict(self) -> str:
        """Return "stable", "unstable" or "undecided" by the real parts of the eigenvalues of the slow flow."""
        values = self.slow_eigenvalues
        return all_stable(verdict(-value.real, _ROUNDING * np.abs(values).max()) for value in values)

    def admissible(self, kappa) -> bool:
        """Return True if it is a motion at leading order and both balls stay between their walls."""
        return self.real and all(
            branch.overshoot(np.sqrt(squared), kappa) == 0 if skewed else stays_within_walls(C, kappa)
            for skewed, C, squared in self._taking_part()
        )

    @property
    def real(self) -> bool:
        """True if it is a motion at leading order: no v^2 below 0."""
        return not (self.squared < 0).any()

    def _shown(self):
        numbers = {name: brief(getattr(self, name)) for name in ("squared", "C", "B", "psi")}
        return {**numbers, "slow_eigenvalues": f"real parts up to {brief(self.slow_eigenvalues.real.max())}"}


class Balance:
    """The two conditions on (x_1, x_2) in one pair of charts; x_i = 0 of a module that takes no part."""

    def __init__(self, system, one: Chart, two: Chart):
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
        """Return the residuals (n, 2) and Jacobians (n, 2, 2) at x, shape (n, 2)."""
        q1, q2, z1, z2, n1, n2, b1, b2 = (
            np.array([f(x[:, side]), (1 - side) * slope(x[:, side]), side * slope(x[:, side])])
            for f, slope, side in self._functions
        )
        size = _size(_product(q1, q2) + self.K * (_product(z1, q2) + _product(q1, z2)))
        residual, *slopes = np.stack([size - _size(_product(b1, n1)), size - _size(_product(b2, n2))], axis=-1)
        return np.where(self._idle, x, residual), np.where(self._idle[:, None], np.eye(2), np.stack(slopes, axis=-1))

    def phasors(self, x):
        """Return b_i = B_i exp(-i psi_i), shape (2,)."""
        q1, q2, z1, z2, n1, n2, _, _ = (f(x[side]) for f, _, side in self._functions)
        return np.array([z1 * n1, z2 * n2]) / (q1 * q2 + self.K * (z1 * q2 + q1 * z2))


def _product(one, other):
    """Return the product of two functions of (x_1, x_2), each with its derivatives, (3, n)."""
    return np.array([one[0] * other[0], *(one[1:] * other[0] + one[0] * other[1:])])


def _size(function):
    """Return the modulus squared of a function with its derivatives, (3, n)."""
    return (function[0].conj() * function).real * np.array([[1], [2], [2]])


def fixed_points(system: System) -> list[AsymmetricPoint]:
    """Return all fixed points with an asymmetric module and C_1, C_2 >= 0, ascending in C_1.

    Points with v^2 in [-1, 0) are included.

    Raises
    ------
    ValueError
        If system is not a System, or as `symmetric_points.search`.
    """
    return [point for point in search(system) if not (point.C < 0).any()]


def search(system: System) -> list[AsymmetricPoint]:
    """Return the same for any real C_i.

    Raises
    ------
    ValueError
        As `fixed_points`.
    """
    refuse_free_motion(instance("system", system, System))
    found = [_point(system, pair, x) for pair in pairs_of(system, PAIRS) for x in _zeros(balance(system, pair))]
    return sorted(found, key=lambda point: tuple(np.nan_to_num(point.C)))


def pairs_of(system, pairs) -> list[tuple[str, str]]:
    """Return the pairs of charts on which a system can have fixed points.

    A module that takes no part has x_i = 0 on the chart of small C.
    """
    idle = {1, 2} - set(system.modules)
    return [pair for pair in pairs if system.modules and all(pair[module - 1] == SMALL for module in idle)]


def balance(system, pair) -> Balance:
    """Return the Balance of a pair of charts, by their names."""
    known = charts(system.kappa)
    return Balance(system, known[pair[0]], known[pair[1]])


def _zeros(conditions):
    """Return the zeros in the square |x_i| <= 1, shape (n, 2)."""
    ticks = (2 * np.arange(_STARTS) + 1) / _STARTS - 1
    x = np.stack(np.meshgrid(ticks, ticks, indexing="ij"), axis=-1).reshape(-1, 2)
    zeros, distinct = newton(conditions, x, _REACH), np.empty((0, 2))
    for zero in zeros[(np.abs(zeros) <= 1).all(axis=1)]:
        if not (np.abs(distinct - zero).max(axis=1) < _SAME).any():
            distinct = np.vstack([distinct, zero])
    return distinct


def _point(system, pair, x):
    known = charts(system.kappa)
    places = [(known[name], value) for name, value in zip(pair, x, strict=True)]
    psi = -np.angle(balance(system, pair).phasors(x))
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
