"""The fixed-point conditions (10.23) on the manifold, as polynomials in C_1 and C_2.

On the manifold b_i = B_i exp(-i psi_i) = z_i u_i with z_i = 1 - (1 + i rho) C_i and |u_i| = 1. With this (10.23) is
linear in the phasors u_i, and its coefficients are linear in C_i (docs/derivation.md, section 5):
    p_1 u_1 - K z_2 u_2 = f_1,    -K z_1 u_1 + p_2 u_2 = f_2.
"""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, impedances


@dataclass(frozen=True)
class Balance:
    """Coefficients, constant first, of z (as z_1 and z_2 alike) and of p_1, p_2 in C_i; K; forcing amplitudes."""

    z: np.ndarray
    p: np.ndarray
    K: complex
    forcing: np.ndarray

    @classmethod
    def of(cls, system) -> "Balance":
        """The balance of a system."""
        d, K = impedances(system)
        z = np.array([1.0, -1 - 1j * rho(system.kappa)])
        return cls(z=z, p=np.outer(d, z) + [0, FIRST_HARMONIC], K=K, forcing=np.array([system.f10_hat, system.f20_hat]))

    def determinant(self, C) -> complex:
        """Delta = p_1 p_2 - K^2 z_1 z_2."""
        z, p = self.at(C)
        return p[0] * p[1] - self.K**2 * z[0] * z[1]

    def at(self, C) -> tuple[np.ndarray, np.ndarray]:
        """z_i and p_i, each shape (2,), at C."""
        C = np.asarray(C, dtype=float)
        return self.z[0] + self.z[1] * C, self.p[:, 0] + self.p[:, 1] * C

    def phasors(self, C) -> np.ndarray:
        """u_i, shape (2,), at C: of modulus 1 at a fixed point."""
        z, p = self.at(C)
        f = self.forcing
        return np.array([f[0] * p[1] + self.K * z[1] * f[1], f[1] * p[0] + self.K * z[0] * f[0]]) / self.determinant(C)

    def polynomials(self) -> tuple[np.ndarray, np.ndarray]:
        """|u_1| = |u_2| = 1 without denominators, and the scale of the coefficients' rounding, each (3, 3, 3).

        Q_1(C_1) - Q_2(C_2), |Delta|^2 - Q_1 and |Delta|^2 - Q_2, where Q_1 = |f_2 p_1 + K f_1 z_1|^2 and likewise Q_2;
        entry [:, j, k] belongs to C_1^j C_2^k.
        """
        terms = self._terms(self.z, self.p, self.K, self.forcing, -1)
        bounds = self._terms(*(np.abs(x) for x in (self.z, self.p, self.K, self.forcing)), 1)
        combine = np.array([[0, 1, -1], [1, -1, 0], [1, 0, -1]])
        coefficients = np.einsum("ab,bjk->ajk", combine, [_modulus_squared(term) for term in terms])
        magnitudes = np.einsum("ab,bjk->ajk", np.abs(combine), [_modulus_squared(term) for term in bounds])
        return coefficients, magnitudes

    @staticmethod
    def _terms(z, p, K, forcing, sign):
        return (
            np.outer(p[0], p[1]) + sign * K**2 * np.outer(z, z),
            (forcing[1] * p[0] + K * forcing[0] * z)[:, None],
            (forcing[0] * p[1] + K * forcing[1] * z)[None, :],
        )


def _modulus_squared(polynomial):
    """Coefficients (3, 3) of |polynomial|^2, from those of a polynomial of degree at most 1 in each variable."""
    square = np.zeros((3, 3))
    for j, k in np.ndindex(polynomial.shape):
        product = (polynomial[j, k] * polynomial.conj()).real
        square[j : j + product.shape[0], k : k + product.shape[1]] += product
    return square
