"""The manifold of symmetric and asymmetric motions in three charts: polynomials of a real parameter x in [-1, 1].

A module has the complex amplitude b = z u / beta with |u| = 1. The first harmonic of its saw-tooth is n u / beta, so
that the describing function of the ball is N = n / z. The amplitude of the saw-tooth is C = path / beta. The table
gives z, n, beta and path of each chart, with mu = 8 / pi^2 and the measure rho of dissipation, (10.15). The functions
c = cos(pi v / 2) and s = 2 sin(pi v / 2) / (pi v) are replaced by their power series in v^2 (docs/derivation.md,
section 11):

    chart         x      z                          n          beta                            path
    small C       C      1 - (1 + i rho) x          mu x       1                               x
    large C       1 / C  x - (1 + i rho)            mu         x                               1
    asymmetric    v^2    -(4 c / pi^2 + i rho s)    mu c^2 s   ((1 - x) s - 4 c / pi^2) c      (1 - x) s c

On the asymmetric branch, the flight from wall +1 takes the fraction (1 - v) / 2 of the cycle. A mirror image has the
opposite v. Therefore all quantities except the impact phases are functions of v^2. Here a motion is called stable if
its impacts are stable at constant amplitude B and phase phi of U.
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
_TERMS = 16  # terms of c and s; the next, (pi^2 / 4)^16 / 32!, is below rounding
_ROUNDING = 1e-12  # rounding error of `trace`


@dataclass(frozen=True, eq=False)
class Chart:
    """The polynomials z, n, beta and path of one chart of the manifold (see the module docstring)."""

    z: Polynomial
    n: Polynomial
    beta: Polynomial
    path: Polynomial

    def amplitudes(self, x):
        """Return C and B at x."""
        beta = self.beta(x)
        return self.path(x) / beta, np.abs(self.z(x) / beta)

    def ball(self, x):
        """Return B, N B and the derivatives of both with respect to x."""
        z, n, beta = self.z(x), self.n(x), self.beta(x)
        z_x, n_x, beta_x = (part.deriv()(x) for part in (self.z, self.n, self.beta))
        B, N = np.abs(z / beta), n / z
        B_x = B * (z_x / z - beta_x / beta).real
        return B, N * B, B_x, (n_x * z - n * z_x) / z**2 * B + N * B_x


def series(terms, pi=math.pi):
    """Return `terms` coefficients of cos(pi v / 2) and of sin(pi v / 2) / (pi v / 2) in powers of v^2."""
    power = [(-pi * pi / 4) ** k for k in range(terms)]
    return tuple([p / math.factorial(2 * k + odd) for k, p in enumerate(power)] for odd in (0, 1))


@functools.lru_cache(maxsize=8)
def charts(kappa: float) -> dict[str, Chart]:
    """Return the charts for a restitution coefficient, by name."""
    r, one, x = rho(kappa), Polynomial([1.0]), Polynomial([0.0, 1.0])
    c, s = map(Polynomial, series(_TERMS))
    gap = (1 - x) * s - 4 / np.pi**2 * c
    return {
        SMALL: Chart(1 - (1 + 1j * r) * x, FIRST_HARMONIC * x, one, x),
        LARGE: Chart(x - (1 + 1j * r), FIRST_HARMONIC * one, x, one),
        ASYMMETRIC: Chart(-(4 / np.pi**2 * c + 1j * r * s), FIRST_HARMONIC * c * c * s, gap * c, (1 - x) * s * c),
    }


def amplitudes(squared, kappa):
    """Return C and B on the asymmetric branch at v^2 = `squared` in [0, 1).

    For every kappa, C grows from pi^2 / (pi^2 - 4) towards 2.
    """
    return charts(kappa)[ASYMMETRIC].amplitudes(np.asarray(squared, dtype=float))


def impact_phases(v, kappa):
    """Return the phases of U [rad] at the impact with W = +1 and at the next impact, for -1 < v < 1."""
    chart, v = charts(kappa)[ASYMMETRIC], np.asarray(v, dtype=float)
    middle, half = np.angle(-chart.z(v**2) / chart.beta(v**2)), np.pi * (1 - v) / 2
    return middle - half, middle + half


def trace(squared, kappa):
    """Return the trace of the one-cycle map of perturbations on the asymmetric branch; the determinant is kappa^4."""
    squared = np.asarray(squared, dtype=float)
    G = 1 - squared - (1 - squared) / amplitudes(squared, kappa)[0]  # (2 v / pi) cot(pi v / 2)
    tangent = (np.tan(np.pi / 2 * np.sqrt(squared.astype(complex))) ** 2).real
    return (
        2 * kappa**2
        - kappa * (1 + kappa) ** 2 * np.pi**2 * G
        + ((1 + kappa) * np.pi) ** 4 * (1 - squared) / 16 * (G**2 - rho(kappa) ** 2 * tangent)
    )


def multipliers(squared: float, kappa: float) -> np.ndarray:
    """Return the multipliers (2,) of perturbations over one cycle on the asymmetric branch, at constant B and phi."""
    return np.roots([1.0, -trace(squared, kappa), kappa**4]).astype(complex)


def period_doubling(kappa: float) -> float:
    """Return the v^2, between 0.17 and 0.22, at which a multiplier is -1 and the stable part of the branch ends."""
    return brentq(lambda squared: trace(squared, kappa) + 1 + kappa**4, 0.0, 0.3, xtol=1e-15)


def stable(squared: float, kappa: float) -> str:
    """Return "stable" if both `multipliers` are inside the unit circle, else "unstable" or "undecided"."""
    return verdict(1 + kappa**4 - abs(trace(squared, kappa)), _ROUNDING)


def overshoot(v: float, kappa: float) -> float:
    """Return the largest |W_0| - 1 over a cycle, or 0 if the ball stays between the walls."""
    C, B = amplitudes(v**2, kappa)
    a, b = impact_phases(v, kappa)
    change, excess = 4 * C / (np.pi * (1 - v**2)), 0.0  # change of the slope of Z at an impact
    for wall, start, fraction in ((1, a, (1 - v) / 2), (-1, b, (1 + v) / 2)):
        slope = -wall * change * (1 - fraction)
        turn = np.arccos(np.clip(-slope / B, -1, 1))  # here W_0' = 0
        since = np.remainder(np.array([turn, -turn]) - start, 2 * np.pi)
        W = wall + B * (np.sin(start + since) - np.sin(start)) + slope * since
        excess = max(excess, *np.where(since <= 2 * np.pi * fraction, np.abs(W) - 1, 0.0))
    return float(excess)
