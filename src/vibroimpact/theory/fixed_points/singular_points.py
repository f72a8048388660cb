"""Singular points of the elimination that leads to (10.24)."""

import numpy as np

from vibroimpact.theory.fixed_points.polynomials import Balance
from vibroimpact.theory.manifold import B_of_C, rho


def determinant(system, C) -> float:
    """Im(p_1 p_2 conj(z_1 z_2 K^2)): the common denominator of h_1 and h_2 in (10.24), up to a factor 4 f-free.

    sin^2 + cos^2 = 1 for psi_1 and for psi_2 gives two equations linear in cos and sin of psi_2 - psi_1; four times
    this is their determinant (docs/derivation.md, section 8). Zero for all C when the modules are uncoupled.
    """
    balance = Balance.of(system)
    z, q = balance.at(C)
    p = q + balance.K * z
    return float((np.prod(p * z.conj()) * balance.K.conjugate() ** 2).imag)


def singular_points(system, point, module) -> np.ndarray:
    """Isolated points S of one module's manifold where h_1 and h_2 of (10.24) are singular.

    Args:
        point: the fixed point at which the other module is held.
        module: 1 or 2, the module whose plane is asked for.

    Returns:
        (C, B) of each point with C >= 0, shape (n, 2), ascending in C; n is 0, 1 or 2. Uncoupled modules have none
        isolated: the whole manifold is singular (see `singular_everywhere`).

    Raises:
        ValueError: module is neither 1 nor 2.
    """
    if module not in (1, 2):
        raise ValueError(f"module: {module!r} is neither 1 nor 2")
    own, other = module - 1, 2 - module
    balance = Balance.of(system)
    z, q = balance.at(point.C)
    held = (q[other] + balance.K * z[other]) * (z[other] * balance.K**2).conjugate()
    C = _real_roots((held * np.convolve(balance.q[own] + balance.K * balance.z, balance.z.conj())).imag)
    C = np.unique(C[C >= 0])
    return np.column_stack([C, B_of_C(C, rho(system.kappa))])


def singular_everywhere(system) -> bool:
    """Whether h_1 and h_2 are singular on the whole manifold: exactly when the modules are uncoupled.

    A coupled pair never is: the determinant as a quadratic in C_1 vanishes identically only with p_2 = 0, and a ball
    that dissipates keeps p_2 from 0.
    """
    return system.alpha12_hat == 0 and system.gamma12_hat == 0


def _real_roots(coefficients):
    """Real roots of c + b x + a x^2; a pair that rounding cannot tell from a double root counts as one."""
    c, b, a = coefficients
    discriminant = b * b - 4 * a * c
    if abs(discriminant) <= 8 * np.finfo(float).eps * (b * b + abs(4 * a * c)):
        discriminant = 0.0
    if discriminant < 0:
        return np.empty(0)
    # The larger of b +- root keeps its digits; the other root follows from the product c / a.
    q = -(b + np.copysign(np.sqrt(discriminant), b)) / 2
    return np.array([top / bottom for top, bottom in ((q, a), (c, q)) if bottom != 0])
