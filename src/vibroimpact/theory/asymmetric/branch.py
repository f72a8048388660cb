"""The asymmetric branch of the manifold, B and phi held: where it is, when the ball strikes, whether that is stable.

A flight from wall +1 takes the fraction u of the cycle, the one back 1 - u; v = 1 - 2 u is their difference. Everything
but the instants of impact is a function of v^2, since a motion and its mirror image have opposite v. Derived in
docs/derivation.md, section 11.
"""

import numpy as np
from scipy.optimize import brentq

from vibroimpact.system.verdict import verdict
from vibroimpact.theory.asymmetric.charts import ASYMMETRIC, charts
from vibroimpact.theory.manifold import rho

_ROUNDING = 1e-12  # of a trace


def amplitudes(squared, kappa):
    """C and B of the branch at v^2 in [0, 1), shape of v^2; C does not depend on kappa.

    Both grow from where symmetry breaks, C = pi^2 / (pi^2 - 4), C up to 2, B without bound.
    """
    return charts(kappa)[ASYMMETRIC].amplitudes(np.asarray(squared, dtype=float))


def impact_phases(v, kappa):
    """Phases of U at the impacts with W = +1 and, later, W = -1 [rad]; -1 < v < 1."""
    chart, v = charts(kappa)[ASYMMETRIC], np.asarray(v, dtype=float)
    middle = np.angle(-chart.z(v**2) / chart.beta(v**2))
    return middle - np.pi * (1 - v) / 2, middle + np.pi * (1 - v) / 2


def first_harmonic(v, kappa):
    """First harmonic of the saw-tooth, the complex h in Z = Re(h exp(i (tau_0 + phi))) + ..., at -1 < v < 1."""
    a, b = impact_phases(v, kappa)
    return slope_change(v, kappa) / np.pi * (np.exp(-1j * a) - np.exp(-1j * b))


def slope_change(v, kappa):
    """By how much an impact changes the slope of Z: 4 C / (pi (1 - v^2)), (1 + kappa) times the speed before it."""
    C, _ = amplitudes(np.square(v), kappa)
    return 4 * C / (np.pi * (1 - np.square(v)))


def trace(squared, kappa):
    """Trace of the map of small changes over one cycle (two impacts); its determinant is kappa^4."""
    squared = np.asarray(squared, dtype=float)
    chart = charts(kappa)[ASYMMETRIC]
    G = 1 - squared - (1 - squared) / chart.amplitudes(squared)[0]  # (2 v / pi) cot(pi v / 2)
    tangent = (np.tan(np.pi / 2 * np.sqrt(squared.astype(complex))) ** 2).real
    return (
        2 * kappa**2
        - kappa * (1 + kappa) ** 2 * np.pi**2 * G
        + ((1 + kappa) * np.pi) ** 4 * (1 - squared) / 16 * (G**2 - rho(kappa) ** 2 * tangent)
    )


def multipliers(squared: float, kappa: float) -> np.ndarray:
    """Multipliers, shape (2,), of small changes of impact time and ball speed over one cycle, B and phi held."""
    return np.roots([1.0, -trace(squared, kappa), kappa**4]).astype(complex)


def period_doubling(kappa: float) -> float:
    """The v^2 at which a multiplier is -1, 0.17 to 0.22: the branch is stable between 0 and there."""
    return brentq(lambda squared: trace(squared, kappa) + 1 + kappa**4, 0.0, 0.3, xtol=1e-15)


def stable(squared: float, kappa: float) -> str:
    """ "stable", "unstable" or "undecided": whether both multipliers are inside the unit circle."""
    return verdict(1 + kappa**4 - abs(trace(squared, kappa)), _ROUNDING)


def overshoot(v: float, kappa: float) -> float:
    """Largest |W_0| - 1 over a cycle; 0 where the ball stays between the walls. Flights turn where W_0' = 0."""
    _, B = amplitudes(v**2, kappa)
    a, b = impact_phases(v, kappa)
    change = slope_change(v, kappa)
    excess = 0.0
    for wall, start, fraction in ((1, a, (1 - v) / 2), (-1, b, (1 + v) / 2)):
        slope = -wall * change * (1 - fraction)
        turn = np.arccos(np.clip(-slope / B, -1, 1))
        since = np.remainder(np.array([turn, -turn]) - start, 2 * np.pi)
        W = wall + B * (np.sin(start + since) - np.sin(start)) + slope * since
        excess = max(excess, *np.where(since <= 2 * np.pi * fraction, np.abs(W) - 1, 0.0))
    return float(excess)
