"""Fixed-point conditions (10.23) as polynomials in C_1 and C_2: the roots of (10.24) without its poles.

On the manifold b_i = B_i exp(-i psi_i) = z_i u_i with z_i = 1 - (1 + i rho) C_i and |u_i| = 1. With this (10.23) is
linear in the phasors u_i, and its coefficients are linear in C_i (docs/derivation.md, section 5):
    q_i u_i + K (z_i u_i - z_j u_j) = f_i,    q_i = e_i z_i + mu C_i.
This module also computes the singular points of (10.24) (docs/derivation.md, section 8).
"""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, impedances

_ROUNDING = 100 * np.finfo(float).eps


@dataclass(frozen=True, eq=False)
class Balance:
    """Linear functions of C_i in the balance, constant first.

    z: shape (2,). q: shape (2, 2). K: coupling. forcing: (2,).
    """

    z: np.ndarray
    q: np.ndarray
    K: complex
    forcing: np.ndarray

    @classmethod
    def of(cls, system) -> "Balance":
        """Return the balance of a system."""
        e, K = impedances(system)
        z = np.array([1, -1 - 1j * rho(system.kappa)])
        q = np.outer(e, z) + np.array([0, FIRST_HARMONIC])
        return cls(z=z, q=q, K=K, forcing=np.array([system.f10_hat, system.f20_hat]))

    def at(self, C) -> tuple[np.ndarray, np.ndarray]:
        """Return z_i and q_i, each shape (2,), at C."""
        C = np.asarray(C, dtype=float)
        return self.z[0] + self.z[1] * C, self.q[:, 0] + self.q[:, 1] * C

    def solve(self, C) -> tuple[np.ndarray, complex]:
        """Return the numerators, shape (2,), and denominator Delta of the phasors u_i at C (Cramer's rule)."""
        z, q = self.at(C)
        numerators = self.forcing * q[::-1] + self.forcing.sum() * self.K * z[::-1]
        return numerators, q[0] * q[1] + self.K * (z[0] * q[1] + z[1] * q[0])

    def phases(self, C) -> np.ndarray:
        """Return psi (2,) at a common zero C of the polynomials."""
        numerators, denominator = self.solve(C)
        return -np.angle(self.at(C)[0] * numerators / denominator)

    def of_module(self, i) -> tuple[np.ndarray, np.ndarray, bool]:
        """Return C (n,) and psi (n,) at which module i alone is balanced, and True if two are one to rounding.

        i is 0 or 1; the module is uncoupled.

        |q_i|^2 = f_i^2 is quadratic in C_i: the line q_i in the complex plane meets a circle.
        """
        (q0, q1), f = self.q[i], self.forcing[i]
        along = q0 * q1.conjugate() / abs(q1)
        nearest, force, noise = abs(along.imag), abs(f), _ROUNDING * (abs(q0) + abs(f))
        multiple = abs(force - nearest) <= noise
        if force < nearest - noise:
            return np.empty(0), np.empty(0), False
        half = 0.0 if multiple else np.sqrt((force - nearest) * (force + nearest))
        C = (-along.real + half * np.array([0.0] if multiple else [-1.0, 1.0])) / abs(q1)
        return C, -np.angle((self.z[0] + self.z[1] * C) * f / (q0 + q1 * C)), bool(multiple)

    def polynomials(self) -> tuple[np.ndarray, np.ndarray]:
        """Return two polynomials equivalent to (10.24), and the same with moduli, each (2, 3, 3).

        The polynomials are |n_2|^2 - |n_1|^2 and |Delta|^2 - |n_1|^2, that is |u_1| = |u_2| = 1 without denominators,
        where u_i = n_i / Delta. n_1 depends on C_2 alone and n_2 on C_1 alone. Entry [:, j, k] belongs to C_1^j C_2^k.
        """
        parts = self.z, self.q, self.K, self.forcing
        delta, one, two = map(_modulus_squared, _solution(*parts))
        most, first, second = map(_modulus_squared, _solution(*map(np.abs, parts)))
        return np.array([two - one, delta - one]), np.array([second + first, most + first])


def _solution(z, q, K, forcing):
    """Return the coefficients of Delta, n_1 and n_2 in C_1 (first axis) and C_2 (second axis)."""
    delta = np.outer(q[0], q[1]) + K * (np.outer(z, q[1]) + np.outer(q[0], z))
    total = forcing.sum() * K * z
    return delta, (forcing[0] * q[1] + total)[None, :], (forcing[1] * q[0] + total)[:, None]


def _modulus_squared(polynomial):
    """Return the coefficients (3, 3) of |polynomial|^2.

    The polynomial has at most degree 1 in each variable.
    """
    square = np.zeros((3, 3))
    for (j, k), value in np.ndenumerate(polynomial):
        square[j : j + polynomial.shape[0], k : k + polynomial.shape[1]] += (value * polynomial.conj()).real
    return square


def determinant(system, C) -> float:
    """Return Im(p_1 p_2 conj(z_1 z_2 K^2)), the common denominator of h_1 and h_2 in (10.24).

    The factor 4 and factors free of f are left out. sin^2 + cos^2 = 1 for psi_1 and for psi_2 gives two equations
    linear in cos and sin of psi_2 - psi_1; four times this value is their determinant. It vanishes for all C only if
    the modules are uncoupled: as a quadratic in C_1 it vanishes identically only with p_2 = 0, which a dissipative ball
    excludes.
    """
    balance = Balance.of(system)
    z, q = balance.at(C)
    return float((np.prod((q + balance.K * z) * z.conj()) * balance.K.conjugate() ** 2).imag)


def singular_points(system, point, module) -> np.ndarray:
    """Return the isolated points S of one module's manifold where h_1 and h_2 of (10.24) are singular.

    Parameters
    ----------
    point
        The fixed point at which the other module is held constant.
    module
        1 or 2, the module of the plane.

    Returns
    -------
    ndarray
        (C, B) of each point with C >= 0, shape (n, 2), ascending in C; n is 0, 1 or 2. For uncoupled modules the
        whole manifold is singular, so that no point is isolated.

    Raises
    ------
    ValueError
        If module is neither 1 nor 2.
    """
    if module not in (1, 2):
        raise ValueError(f"module: {module!r} is neither 1 nor 2")
    own, other = module - 1, 2 - module
    balance = Balance.of(system)
    if balance.K == 0:
        return np.empty((0, 2))
    z, q = balance.at(point.C)
    held = (q[other] + balance.K * z[other]) * (z[other] * balance.K**2).conjugate()
    C = _real_roots((held * np.convolve(balance.q[own] + balance.K * balance.z, balance.z.conj())).imag)
    C = np.unique(C[C >= 0])
    return np.column_stack([C, B_of_C(C, rho(system.kappa))])


def _real_roots(coefficients):
    """Return the real roots of c + b x + a x^2; a pair equal within rounding counts as one."""
    c, b, a = coefficients
    discriminant = b * b - 4 * a * c
    if abs(discriminant) <= 8 * np.finfo(float).eps * (b * b + abs(4 * a * c)):
        discriminant = 0.0
    if discriminant < 0:
        return np.empty(0)
    # The larger of b +- root keeps its digits; the other root follows from the product c / a.
    q = -(b + np.copysign(np.sqrt(discriminant), b)) / 2
    return np.array([top / bottom for top, bottom in ((q, a), (c, q)) if bottom != 0])
