"""Write the fixed-point conditions (10.23) as two polynomials in the saw-tooth amplitudes C_1 and C_2.

The polynomials have the roots of (10.24), but not its poles. On the manifold, b_i = B_i exp(-i psi_i) = z_i u_i with
z_i = 1 - (1 + i rho) C_i and |u_i| = 1. So (10.23) is linear in the phasors u_i (docs/derivation.md, section 5):
    q_i u_i + K (z_i u_i - z_j u_j) = f_i,    q_i = e_i z_i + mu C_i,    mu = 8 / pi^2.
Here f_i is the forcing amplitude of module i, and j is the other module. The impedances are e_i of box i and K of the
coupling (`slow_flow.impedances`).
"""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, impedances

_ROUNDING = 100 * np.finfo(float).eps


@dataclass(frozen=True, eq=False)
class Balance:
    """Coefficients of the balance q_i u_i + K (z_i u_i - z_j u_j) = f_i of module i, where j is the other module.

    `z` and `q` give z_i = z[0] + z[1] C_i and q_i = q[i, 0] + q[i, 1] C_i. `forcing` is (f_1, f_2).
    """

    z: np.ndarray
    q: np.ndarray
    K: complex
    forcing: np.ndarray

    @classmethod
    def of(cls, system) -> "Balance":
        """Return the Balance of a system."""
        e, K = impedances(system)
        z = np.array([1, -1 - 1j * rho(system.kappa)])
        q = np.outer(e, z) + np.array([0, FIRST_HARMONIC])
        return cls(z=z, q=q, K=K, forcing=np.array([system.f10_hat, system.f20_hat]))

    def at(self, C) -> tuple[np.ndarray, np.ndarray]:
        """Return z_i and q_i of the balance, each shape (2,), at the saw-tooth amplitudes C (2,)."""
        C = np.asarray(C, dtype=float)
        return self.z[0] + self.z[1] * C, self.q[:, 0] + self.q[:, 1] * C

    def solve(self, C) -> tuple[np.ndarray, complex]:
        """Return the numerators n_i, (2,), and the denominator Delta of u_i = n_i / Delta at C (2,)."""
        z, q = self.at(C)
        numerators = self.forcing * q[::-1] + self.forcing.sum() * self.K * z[::-1]
        return numerators, q[0] * q[1] + self.K * (z[0] * q[1] + z[1] * q[0])

    def phases(self, C) -> np.ndarray:
        """Return the phases psi (2,) of the fixed point with amplitudes C (2,), a common zero of the `polynomials`."""
        numerators, denominator = self.solve(C)
        return -np.angle(self.at(C)[0] * numerators / denominator)

    def of_module(self, i) -> tuple[np.ndarray, np.ndarray, bool]:
        """Return C and psi of the fixed points of the uncoupled module i (0 or 1), and True if two points coincide."""
        # |q_i|^2 = f_i^2: the line of all q_i in the complex plane meets the circle of radius |f_i|.
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
        """Return the coefficients of two polynomials equivalent to (10.24), and scales of the rounding errors.

        Both arrays are (2, 3, 3), and entry [:, j, k] belongs to C_1^j C_2^k. The polynomials |n_2|^2 - |n_1|^2 and
        |Delta|^2 - |n_1|^2 vanish where |u_1| = |u_2| = 1. A scale is the sum of the moduli of a coefficient's terms.
        """
        # Squares of tiny forces would underflow. Scaling by a power of 2 causes no rounding error.
        unit = np.ldexp(1.0, np.frexp(np.abs(self.forcing).max())[1])
        parts = self.z, self.q, self.K, self.forcing / unit
        delta, one, two = map(_modulus_squared, _solution(*parts))
        most, first, second = map(_modulus_squared, _solution(*map(np.abs, parts)))
        return np.array([two - one, delta - unit**2 * one]), np.array([second + first, most + unit**2 * first])


def _solution(z, q, K, forcing):
    """Return Delta, n_1 and n_2 of `Balance.solve` as coefficients of powers of C_1 (axis 0) and C_2 (axis 1)."""
    delta = np.outer(q[0], q[1]) + K * (np.outer(z, q[1]) + np.outer(q[0], z))
    total = forcing.sum() * K * z
    return delta, (forcing[0] * q[1] + total)[None, :], (forcing[1] * q[0] + total)[:, None]


def _modulus_squared(polynomial):
    """Return the coefficients (3, 3) of |polynomial|^2 for a polynomial of degree 0 or 1 in each variable.

    The variables are real.
    """
    square = np.zeros((3, 3))
    for (j, k), value in np.ndenumerate(polynomial):
        square[j : j + polynomial.shape[0], k : k + polynomial.shape[1]] += (value * polynomial.conj()).real
    return square


def determinant(system, C) -> float:
    """Return the denominator Im(p_1 p_2 conj(z_1 z_2 K^2)) of (10.24), with p_i = q_i + K z_i of `Balance`.

    It lacks constant factors and powers of B_i (docs/derivation.md, section 8). For coupled modules, this polynomial in
    C_1 is identically 0 only if p_2 = 0. Since impacts dissipate energy, C_2 is then 0.
    """
    balance = Balance.of(system)
    z, q = balance.at(C)
    return float((np.prod((q + balance.K * z) * z.conj()) * balance.K.conjugate() ** 2).imag)


def singular_points(system, point, module) -> np.ndarray:
    """Return (C, B) of the isolated singular points of (10.24) on the manifold of one module, shape (n, 2).

    The points ascend in C. `point` gives C of the other module. Uncoupled modules have no isolated singular points.

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
    """Return the real roots of c + b x + a x^2; a discriminant of 0 within rounding counts as 0."""
    c, b, a = coefficients
    discriminant = b * b - 4 * a * c
    if abs(discriminant) <= 8 * np.finfo(float).eps * (b * b + abs(4 * a * c)):
        discriminant = 0.0
    if discriminant < 0:
        return np.empty(0)
    # The root has the sign of b, so that no digits cancel.
    q = -(b + np.copysign(np.sqrt(discriminant), b)) / 2
    return np.array([top / bottom for top, bottom in ((q, a), (c, q)) if bottom != 0])
