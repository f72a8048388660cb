"""Write the fixed-point conditions (10.23) as two polynomials in the saw-tooth amplitudes C_1 and C_2.

The polynomials have the same roots as (10.24), but no poles. On the manifold, the complex amplitude of module i is
b_i = B_i exp(-i psi_i) = z_i u_i, with z_i = 1 - (1 + i rho) C_i and |u_i| = 1. Therefore the conditions (10.23) are
linear in the phasors u_i (docs/derivation.md, section 5):
    q_i u_i + K (z_i u_i - z_j u_j) = f_i,    q_i = e_i z_i + mu C_i,    mu = 8 / pi^2.
Here j is the module other than i, and f_i is the forcing amplitude of module i. The impedance of box i is e_i, and the
impedance of the coupling is K (`slow_flow.impedances`).
"""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, impedances

_ROUNDING = 100 * np.finfo(float).eps


@dataclass(frozen=True, eq=False)
class Balance:
    """Coefficients of the balance q_i u_i + K (z_i u_i - z_j u_j) = f_i of module i, where j is the other module.

    z: coefficients of z_i = z[0] + z[1] C_i, shape (2,); both modules have the same coefficients.
    q: coefficients of q_i = q[i - 1, 0] + q[i - 1, 1] C_i for module i = 1 or 2, shape (2, 2).
    K: complex impedance of the coupling.
    forcing: forcing amplitudes f_1 and f_2, shape (2,).
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
        """Return z_i and q_i of the balance at the saw-tooth amplitudes C; all three arrays have the shape (2,)."""
        C = np.asarray(C, dtype=float)
        return self.z[0] + self.z[1] * C, self.q[:, 0] + self.q[:, 1] * C

    def solve(self, C) -> tuple[np.ndarray, complex]:
        """Solve the balance for the phasors u_i = n_i / Delta at the saw-tooth amplitudes C, shape (2,).

        Return the numerators n_1 and n_2 as an array of shape (2,), and the denominator Delta.
        """
        z, q = self.at(C)
        numerators = self.forcing * q[::-1] + self.forcing.sum() * self.K * z[::-1]
        return numerators, q[0] * q[1] + self.K * (z[0] * q[1] + z[1] * q[0])

    def phases(self, C) -> np.ndarray:
        """Return the phases psi [rad] of the fixed point that has the saw-tooth amplitudes C.

        The arrays psi and C have the shape (2,). C must be a common zero of the two `polynomials`.
        """
        numerators, denominator = self.solve(C)
        return -np.angle(self.at(C)[0] * numerators / denominator)

    def of_module(self, i) -> tuple[np.ndarray, np.ndarray, bool]:
        """Return the arrays C and psi [rad] of the fixed points of the uncoupled module i (0 or 1), and a flag.

        Both arrays have the shape (n,) with n = 0, 1 or 2. The flag is True if two fixed points coincide within
        rounding. Both arrays then have a single entry.
        """
        # Without coupling, fixed points satisfy |q_i| = |f_i|. The values of q_i for all C_i form a line in the complex
        # plane. The fixed points are the intersections of this line with the circle of radius |f_i|.
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
        """Return the coefficients of two polynomials equivalent to (10.24), and the magnitudes of the coefficients.

        Both arrays have the shape (2, 3, 3), and entry [:, j, k] belongs to C_1^j C_2^k. The polynomials are
        |n_2|^2 - |n_1|^2 and |Delta|^2 - |n_1|^2, with n_i and Delta of `solve`. Both vanish if |u_1| = |u_2| = 1.
        Each coefficient is a sum of terms. Its magnitude is the sum of the moduli of these terms. The rounding error of
        the coefficient is proportional to its magnitude.
        """
        # Since squares of tiny forces would underflow, the forces are divided by a power of 2. This division causes no
        # rounding error.
        unit = np.ldexp(1.0, np.frexp(np.abs(self.forcing).max())[1])
        parts = self.z, self.q, self.K, self.forcing / unit
        delta, one, two = map(_modulus_squared, _solution(*parts))
        most, first, second = map(_modulus_squared, _solution(*map(np.abs, parts)))
        return np.array([two - one, delta - unit**2 * one]), np.array([second + first, most + unit**2 * first])


def _solution(z, q, K, forcing):
    """Return the coefficients of the polynomials Delta, n_1 and n_2 of `Balance.solve`.

    Axis 0 of each array belongs to the powers of C_1, and axis 1 to the powers of C_2.
    """
    delta = np.outer(q[0], q[1]) + K * (np.outer(z, q[1]) + np.outer(q[0], z))
    total = forcing.sum() * K * z
    return delta, (forcing[0] * q[1] + total)[None, :], (forcing[1] * q[0] + total)[:, None]


def _modulus_squared(polynomial):
    """Return the coefficients of the squared modulus of a polynomial in two real variables, shape (3, 3).

    The polynomial has complex coefficients, and degree 0 or 1 in each variable.
    """
    square = np.zeros((3, 3))
    for (j, k), value in np.ndenumerate(polynomial):
        square[j : j + polynomial.shape[0], k : k + polynomial.shape[1]] += (value * polynomial.conj()).real
    return square


def determinant(system, C) -> float:
    """Return a number that is 0 where the denominator of (10.24) is 0 on the manifold.

    C: saw-tooth amplitudes, shape (2,).

    The value is Im(p_1 p_2 conj(z_1 z_2 K^2)) with p_i = q_i + K z_i, where z_i, q_i and K are the terms of `Balance`
    (docs/derivation.md, section 8). At a given C_2, the value is a polynomial in C_1. If the modules are coupled, this
    polynomial is 0 for all C_1 only if p_2 = 0. Since impacts dissipate energy, C_2 is then 0.
    """
    balance = Balance.of(system)
    z, q = balance.at(C)
    return float((np.prod((q + balance.K * z) * z.conj()) * balance.K.conjugate() ** 2).imag)


def singular_points(system, point, module) -> np.ndarray:
    """Return the isolated singular points of (10.24) on the manifold of one module, shape (n, 2).

    A row contains the amplitudes C >= 0 and B of a singular point. The rows are sorted by C. The other module keeps
    the C of the fixed point `point`. If the modules are uncoupled, there is no isolated singular point, and n is 0.

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
    # The square root gets the sign of b. Therefore the sum of b and the root loses no digits by cancellation.
    q = -(b + np.copysign(np.sqrt(discriminant), b)) / 2
    return np.array([top / bottom for top, bottom in ((q, a), (c, q)) if bottom != 0])
