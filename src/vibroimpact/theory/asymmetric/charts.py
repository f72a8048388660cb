"""The manifold, symmetric and asymmetric, as three charts of one real parameter x in [-1, 1], all of them polynomials.

A module's complex amplitude is b = z u / beta with |u| = 1, and the first harmonic of its saw-tooth is n u / beta, so
the describing function of the ball is N = n / z. C = path / beta. With c = cos(pi v / 2), s = 2 sin(pi v / 2) / (pi v),
which are entire functions of v^2 (docs/derivation.md, section 11):

    chart         x      z                          n          beta                            path
    small C       C      1 - (1 + i rho) x          mu x       1                               x
    large C       1 / C  x - (1 + i rho)            mu         x                               1
    asymmetric    v^2    -(4 c / pi^2 + i rho s)    mu c^2 s   ((1 - x) s - 4 c / pi^2) c      (1 - x) s c
"""

import functools
import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial

from vibroimpact.theory.manifold import rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC

SMALL, LARGE, ASYMMETRIC = "small C", "large C", "asymmetric"
_TERMS = 16  # pi^2 / 4 to this power is below rounding against 32!


@dataclass(frozen=True, eq=False)
class Chart:
    """The polynomials of one chart."""

    z: Polynomial
    n: Polynomial
    beta: Polynomial
    path: Polynomial

    def amplitudes(self, x):
        """C and B at x."""
        beta = self.beta(x)
        return self.path(x) / beta, np.abs(self.z(x) / beta)

    def ball(self, x):
        """B, N B and their derivatives by x."""
        z, n, beta = self.z(x), self.n(x), self.beta(x)
        z_x, n_x, beta_x = (part.deriv()(x) for part in (self.z, self.n, self.beta))
        B, N = np.abs(z / beta), n / z
        B_x = B * (z_x / z - beta_x / beta).real
        return B, N * B, B_x, (n_x * z - n * z_x) / z**2 * B + N * B_x


def series(terms, pi=math.pi):
    """Coefficients of cos(pi v / 2) and of sin(pi v / 2) / (pi v / 2) in powers of v^2."""
    power = [(-pi * pi / 4) ** k for k in range(terms)]
    return [p / math.factorial(2 * k) for k, p in enumerate(power)], [
        p / math.factorial(2 * k + 1) for k, p in enumerate(power)
    ]


@functools.lru_cache(maxsize=8)
def charts(kappa: float) -> dict[str, Chart]:
    """The charts for a restitution coefficient, by name."""
    r, one, x = rho(kappa), Polynomial([1.0]), Polynomial([0.0, 1.0])
    c, s = (Polynomial(coefficients) for coefficients in series(_TERMS))
    gap = (1 - x) * s - 4 / np.pi**2 * c
    return {
        SMALL: Chart(1 - (1 + 1j * r) * x, FIRST_HARMONIC * x, one, x),
        LARGE: Chart(x - (1 + 1j * r), FIRST_HARMONIC * one, x, one),
        ASYMMETRIC: Chart(-(4 / np.pi**2 * c + 1j * r * s), FIRST_HARMONIC * c * c * s, gap * c, (1 - x) * s * c),
    }
