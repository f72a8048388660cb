"""Slow invariant manifold (SIM) of a module in 1:1 resonance, (10.15)-(10.17) and (10.25), and its saw-tooth.

B is the amplitude of U, C is the amplitude of the saw-tooth, and rho measures dissipation, (10.15). The arguments B, C
and rho are dimensionless numbers, or arrays with shapes that broadcast. Angles are in radians.

C is admissible if the ball stays between the walls, that is, if the relative displacement W_0 of box and ball, (10.10),
satisfies |W_0| <= 1. At a time t <= pi after the impact at W = +1, W_0 = cos t + C h(t), where
h(t) = 1 - 2 t / pi - cos t + rho sin t (docs/stability.md). Since W_0 is linear in C, the admissible values of C form
one interval, which begins at C = 0. At the upper end of the interval, the ball leaves the wall W = +1 and grazes the
same wall once. After that, the ball flies to the wall W = -1.
"""

import numpy as np
from scipy.optimize import brentq


def sawtooth(tau0, C, theta):
    """Return Z = (2 C / pi) arcsin cos(tau0 - theta), (10.11)."""
    # Impacts are at the peaks of the saw-tooth. At a peak, arcsin would lose half of the digits. The distance of tau0
    # from the nearest peak loses no digits.
    from_peak = np.abs(np.remainder(np.asarray(tau0) - theta + np.pi, 2 * np.pi) - np.pi)
    return C * (1 - 2 * from_peak / np.pi)


def rho(kappa):
    """Return rho = 2 (1 - kappa) / (pi (1 + kappa)), (10.15); rho measures dissipation and is 0 for elastic impacts."""
    return 2 * (1 - kappa) / (np.pi * (1 + kappa))


def B_of_C(C, rho):
    """Return the amplitude B >= 0 of U on the manifold, (10.16), for any real C."""
    return np.hypot(1 - C, rho * C)


def slope(C, rho):
    """Return dB/dC along the manifold: negative on the lower arm, 0 at the fold, positive on the upper arm."""
    return ((1 + rho**2) * C - 1) / B_of_C(C, rho)


def C_of_B(B, rho):
    """Return the two amplitudes C that the manifold (10.15) has at the amplitude B.

    The first C is on the lower arm, with C <= C_min. The second C is on the upper arm.

    Raises
    ------
    ValueError
        If some B is below B_min, where the manifold has no point.
    """
    B = np.asarray(B, dtype=float)
    above = B - B_min(rho)
    if not np.all(above >= 0):
        raise ValueError(f"B: {np.min(B)} is below B_min = {B_min(rho)} for rho = {rho}")
    # Differences of squares would lose digits at the fold and near C = 0. Therefore they are written as products.
    root = np.sqrt((1 + rho**2) * above * (B + B_min(rho)))
    return (1 - B) * (1 + B) / (1 + root), (1 + root) / (1 + rho**2)


def B_min(rho):
    """Return the smallest amplitude B on the manifold, (10.25)."""
    return rho / np.sqrt(1 + rho**2)


def C_min(rho):
    """Return the amplitude C at the fold, where B = B_min, (10.25)."""
    return 1 / (1 + rho**2)


def impact_phase(C, rho):
    """Return theta + phi in (-pi, pi], the phase of U at the impact with W = +1, (10.12) and (10.17)."""
    return np.arctan2(1 - C, rho * C)


def overshoot(C, rho):
    """Return how far the ball passes a wall in a cycle: the largest |W_0| - 1, or 0 if the ball passes no wall.

    W_0 is the relative displacement of (10.10). The ball is at a wall if |W_0| = 1.
    """
    C = np.asarray(C, dtype=float)
    B = B_of_C(C, rho)
    # After the impact at W = +1, W_0 is stationary where B cos(tau_0 + phi) = 2 C / pi.
    turn = np.arccos(np.clip(2 * C / (np.pi * B), -1, 1))
    since = np.remainder(np.stack([turn, -turn]) - impact_phase(C, rho), 2 * np.pi)
    W = (1 - C) * np.cos(since) + rho * C * np.sin(since) + C * (1 - 2 * since / np.pi)
    return np.max(np.where(since <= np.pi, np.abs(W) - 1, 0), axis=0, initial=0)


def grazing_time(kappa: float) -> float:
    """Return the time t [rad] from an impact until the ball grazes the same wall.

    The ball grazes the wall if the saw-tooth amplitude is C = largest_C(kappa). The number p = t / 2 is the solution of
    p cot p = 1 / (1 + kappa) in the interval (0, pi/2). The solution is unique, since p cot p falls from 1 to 0 on this
    interval.

    Raises
    ------
    ValueError
        If kappa is not between 0 and 1.
    """
    if not 0 < kappa < 1:
        raise ValueError(f"kappa: {kappa} is not between 0 and 1 (both excluded)")
    # The unknown of the root search is x = p / sqrt(3 kappa), where p is half of the time. Since
    # tan(p) / p = 1 + kappa and tan(p) >= p + p^3 / 3, x is at most 1. Since kappa < 1, p is at most 1.17. The two
    # bounds give the upper end of the search interval.
    unit = np.sqrt(3 * kappa)
    return 2 * unit * brentq(lambda x: _tangent_excess(unit * x) - kappa, 0.6, min(1.1, 1.2 / unit), xtol=1e-15)


def _tangent_excess(p):
    """Return tan(p) / p - 1.

    If p is small, the function uses the power series, since the subtraction of 1 would lose digits.
    """
    return p**2 / 3 + 2 * p**4 / 15 + 17 * p**6 / 315 if p < 0.01 else np.tan(p) / p - 1


def largest_C(kappa: float) -> float:
    """Return the largest saw-tooth amplitude C at which the ball stays between the walls.

    The relative displacement W_0 of (10.10) then satisfies |W_0| <= 1. The formula is
    1 / C = 1 - (2 p / pi) (1 + kappa cot^2 p) with p = grazing_time(kappa) / 2. As kappa grows from 0, the largest C
    grows from 1.

    Raises
    ------
    ValueError
        If kappa is not between 0 and 1.
    """
    p = grazing_time(kappa) / 2
    return float(1 / (1 - 2 * p / np.pi * (1 + kappa / np.tan(p) ** 2)))


def stays_within_walls(C: float, kappa: float) -> bool:
    """Return True if the ball stays between the walls, that is, if 0 <= C <= largest_C(kappa).

    Raises
    ------
    ValueError
        If kappa is not between 0 and 1.
    """
    return 0 <= C <= largest_C(kappa)
