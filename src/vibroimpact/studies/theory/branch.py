"""Describe the manifold of symmetric and asymmetric motions of a module in three parts, called charts.

On each chart, a real parameter x in [-1, 1] describes the motion. The quantities z, n, beta and path are polynomials in
x. The complex amplitude of the module is b = z u / beta with |u| = 1. The first harmonic of the saw-tooth is n u /
beta. Therefore the describing function of the ball is N = n / z. The amplitude of the saw-tooth is C = path / beta.

The table gives z, n, beta and path of each chart. In the table, mu = 8 / pi^2, and rho, (10.15), measures the
dissipation of impacts. The functions c = cos(pi v / 2) and s = 2 sin(pi v / 2) / (pi v) are replaced by their power
series in v^2 (docs/derivation.md, section 11):

    chart         x      z                          n          beta                            path
    small C       C      1 - (1 + i rho) x          mu x       1                               x
    large C       1 / C  x - (1 + i rho)            mu         x                               1
    asymmetric    v^2    -(4 c / pi^2 + i rho s)    mu c^2 s   ((1 - x) s - 4 c / pi^2) c      (1 - x) s c

On the asymmetric branch, the flight from wall +1 takes the fraction (1 - v) / 2 of the cycle. A motion and its mirror
image have opposite values of v. Therefore all quantities except the impact phases are functions of v^2. A motion is
called stable here if its impacts are stable while the amplitude B and the phase phi of U are constant.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial
from scipy.optimize import brentq

from vibroimpact.system.verdict import verdict
from vibroimpact.theory.manifold import rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC

SMALL, LARGE, ASYMMETRIC = "small C", "large C", "asymmetric"
_TERMS = 16  # number of terms of the series of c and s; the next term, (pi^2 / 4)^16 / 32!, is below rounding
_ROUNDING = 1e-12  # rounding error of `trace`


@dataclass(frozen=True, eq=False)
class Chart:
    """The polynomials z, n, beta and path of one chart of the manifold (see the module docstring)."""

    z: Polynomial
    n: Polynomial
    beta: Polynomial
    path: Polynomial

    def amplitudes(self, x):
        """Return the saw-tooth amplitude C and the amplitude B of U at x."""
        beta = self.beta(x)
        return self.path(x) / beta, np.abs(self.z(x) / beta)

    def ball(self, x):
        """Return four values: B, N B, dB/dx and d(N B)/dx.

        B is the amplitude of U, and N is the describing function of the ball.
        """
        z, n, beta = self.z(x), self.n(x), self.beta(x)
        z_x, n_x, beta_x = (part.deriv()(x) for part in (self.z, self.n, self.beta))
        B, N = np.abs(z / beta), n / z
        B_x = B * (z_x / z - beta_x / beta).real
        return B, N * B, B_x, (n_x * z - n * z_x) / z**2 * B + N * B_x


def series(terms, pi=math.pi):
    """Return the first `terms` coefficients of two power series in v^2, as two lists.

    The series are those of cos(pi v / 2) and of sin(pi v / 2) / (pi v / 2).
    """
    power = [(-pi * pi / 4) ** k for k in range(terms)]
    return tuple([p / math.factorial(2 * k + odd) for k, p in enumerate(power)] for odd in (0, 1))


@functools.lru_cache(maxsize=8)
def charts(kappa: float) -> dict[str, Chart]:
    """Return the three charts of the manifold for the restitution coefficient kappa, by name."""
    r, one, x = rho(kappa), Polynomial([1.0]), Polynomial([0.0, 1.0])
    c, s = map(Polynomial, series(_TERMS))
    gap = (1 - x) * s - 4 / np.pi**2 * c
    return {
        SMALL: Chart(1 - (1 + 1j * r) * x, FIRST_HARMONIC * x, one, x),
        LARGE: Chart(x - (1 + 1j * r), FIRST_HARMONIC * one, x, one),
        ASYMMETRIC: Chart(-(4 / np.pi**2 * c + 1j * r * s), FIRST_HARMONIC * c * c * s, gap * c, (1 - x) * s * c),
    }


def amplitudes(squared, kappa):
    """Return the amplitudes C and B on the asymmetric branch at v^2 = `squared` in [0, 1).

    As v^2 grows from 0 to 1, C grows from pi^2 / (pi^2 - 4) towards 2 for every kappa.
    """
    return charts(kappa)[ASYMMETRIC].amplitudes(np.asarray(squared, dtype=float))


def impact_phases(v, kappa):
    """Return the phase of U [rad] at the impact with W = +1, and the phase at the next impact, for -1 < v < 1."""
    chart, v = charts(kappa)[ASYMMETRIC], np.asarray(v, dtype=float)
    middle, half = np.angle(-chart.z(v**2) / chart.beta(v**2)), np.pi * (1 - v) / 2
    return middle - half, middle + half


def trace(squared, kappa):
    """Return the trace of the linear map of perturbations over one cycle, on the asymmetric branch at v^2 = `squared`.

    The determinant of this map is kappa^4, since a cycle has two impacts.
    """
    squared = np.asarray(squared, dtype=float)
    G = 1 - squared - (1 - squared) / amplitudes(squared, kappa)[0]  # equal to (2 v / pi) cot(pi v / 2)
    tangent = (np.tan(np.pi / 2 * np.sqrt(squared.astype(complex))) ** 2).real
    return (
        2 * kappa**2
        - kappa * (1 + kappa) ** 2 * np.pi**2 * G
        + ((1 + kappa) * np.pi) ** 4 * (1 - squared) / 16 * (G**2 - rho(kappa) ** 2 * tangent)
    )


def multipliers(squared: float, kappa: float) -> np.ndarray:
    """Return the multipliers of perturbations over one cycle on the asymmetric branch at v^2 = `squared`, shape (2,).

    The amplitude B and the phase phi of U are constant.
    """
    return np.roots([1.0, -trace(squared, kappa), kappa**4]).astype(complex)


def period_doubling(kappa: float) -> float:
    """Return the v^2 at which a multiplier is -1.

    The stable part of the asymmetric branch ends at this v^2, which is between 0.17 and 0.22 for every kappa.
    """
    return brentq(lambda squared: trace(squared, kappa) + 1 + kappa**4, 0.0, 0.3, xtol=1e-15)


def stable(squared: float, kappa: float) -> str:
    """Return "stable" if both multipliers at v^2 = `squared` are inside the unit circle, else "unstable".

    If rounding errors are too large for a decision, return "undecided".
    """
    return verdict(1 + kappa**4 - abs(trace(squared, kappa)), _ROUNDING)


def overshoot(v: float, kappa: float) -> float:
    """Return how far the ball passes a wall in a cycle: the largest |W_0| - 1, or 0 if the ball passes no wall.

    W_0 is the displacement of the box minus that of the ball, at leading order. The ball is at a wall if |W_0| = 1.
    """
    C, B = amplitudes(v**2, kappa)
    a, b = impact_phases(v, kappa)
    change, excess = 4 * C / (np.pi * (1 - v**2)), 0.0  # `change`: change of the slope of the saw-tooth Z at an impact
    for wall, start, fraction in ((1, a, (1 - v) / 2), (-1, b, (1 + v) / 2)):
        slope = -wall * change * (1 - fraction)
        turn = np.arccos(np.clip(-slope / B, -1, 1))  # W_0' = 0 where the phase of U is `turn` or -`turn`
        since = np.remainder(np.array([turn, -turn]) - start, 2 * np.pi)
        W = wall + B * (np.sin(start + since) - np.sin(start)) + slope * since
        excess = max(excess, *np.where(since <= 2 * np.pi * fraction, np.abs(W) - 1, 0.0))
    return float(excess)
