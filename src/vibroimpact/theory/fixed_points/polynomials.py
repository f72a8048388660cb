"""The fixed-point conditions (10.23) as polynomials in C_1 and C_2, free of phases: roots of (10.24) without its poles.

On the manifold b_i = B_i exp(-i psi_i) = z_i u_i with z_i = 1 - (1 + i rho) C_i and |u_i| = 1. With this (10.23) is
linear in the phasors u_i, and its coefficients are linear in C_i (docs/derivation.md, section 5):
    q_i u_i + K (z_i u_i - z_j u_j) = f_i,    q_i = e_i z_i + mu C_i.
"""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, impedances


@dataclass(frozen=True, eq=False)
class Balance:
    """The linear functions of C_i in the balance, constant first: z (shape (2,)), q (shape (2, 2)); K; forcing (2,)."""

    z: np.ndarray
    q: np.ndarray
    K: complex
    forcing: np.ndarray

    @classmethod
    def of(cls, system) -> "Balance":
        """The balance of a system."""
        e, K = impedances(system)
        z = np.array([1, -1 - 1j * rho(system.kappa)])
        q = np.outer(e, z) + np.array([0, FIRST_HARMONIC])
        return cls(z=z, q=q, K=K, forcing=np.array([system.f10_hat, system.f20_hat]))

    def at(self, C) -> tuple[np.ndarray, np.ndarray]:
        """z_i and q_i, each shape (2,), at C."""
        C = np.asarray(C, dtype=float)
        return self.z[0] + self.z[1] * C, self.q[:, 0] + self.q[:, 1] * C

    def solve(self, C) -> tuple[np.ndarray, complex]:
        """Numerators, shape (2,), and denominator Delta of the phasors u_i at C (Cramer's rule)."""
        z, q = self.at(C)
        f = self.forcing
        numerators = f * q[::-1] + f.sum() * self.K * z[::-1]
        return numerators, q[0] * q[1] + self.K * (z[0] * q[1] + z[1] * q[0])

    def polynomials(self) -> tuple[np.ndarray, np.ndarray]:
        """What stands for (10.24): |u_1| = |u_2| = 1 without denominators, and with moduli throughout, each (2, 3, 3).

        |n_2|^2 - |n_1|^2 and |Delta|^2 - |n_1|^2, where u_i = n_i / Delta: n_1 depends on C_2 alone and n_2 on C_1
        alone. Entry [:, j, k] belongs to C_1^j C_2^k.
        """
        delta, one, two = map(_modulus_squared, _solution(self.z, self.q, self.K, self.forcing))
        parts = (np.abs(part) for part in (self.z, self.q, self.K, self.forcing))
        most, first, second = map(_modulus_squared, _solution(*parts))
        return np.array([two - one, delta - one]), np.array([second + first, most + first])


def _solution(z, q, K, forcing):
    """Coefficients of Delta, n_1 and n_2 in C_1 (first axis) and C_2 (second axis)."""
    delta = np.outer(q[0], q[1]) + K * (np.outer(z, q[1]) + np.outer(q[0], z))
    total = forcing.sum() * K * z
    return delta, (forcing[0] * q[1] + total)[None, :], (forcing[1] * q[0] + total)[:, None]


def _modulus_squared(polynomial):
    """Coefficients (3, 3) of |polynomial|^2, from those of a polynomial of degree at most 1 in each variable."""
    square = np.zeros((3, 3))
    for j, k in np.ndindex(polynomial.shape):
        product = (polynomial[j, k] * polynomial.conj()).real
        square[j : j + product.shape[0], k : k + product.shape[1]] += product
    return square
