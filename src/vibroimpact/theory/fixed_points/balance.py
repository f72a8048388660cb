"""Write the fixed-point conditions (10.23) as two polynomials, with the roots of (10.24) but without its poles.

The variables of the polynomials are the saw-tooth amplitudes C_1 and C_2.

On the manifold b_i = B_i exp(-i psi_i) = z_i u_i with z_i = 1 - (1 + i rho) C_i and |u_i| = 1. The conditions (10.23)
are therefore linear in the phasors u_i, with coefficients that are linear in C_i (docs/derivation.md, section 5):
    q_i u_i + K (z_i u_i - z_j u_j) = f_i,    q_i = e_i z_i + mu C_i,    mu = 8 / pi^2.
Here f_i is the forcing amplitude of module i and j is the other module. The impedances e_i of box i and K of the
coupling come from `slow_flow.impedances`.
The function `singular_points` computes the singular points of (10.24) (docs/derivation.md, section 8).
"""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, impedances

_ROUNDING = 100 * np.finfo(float).eps


@dataclass(frozen=True, eq=False)
class Balance:
    """Coefficients of the balance q_i u_i + K (z_i u_i - z_j u_j) = f_i of module i, where j is the other module.

    z (2,): coefficients of z_i = z[0] + z[1] C_i, the same for both modules. q (2, 2): coefficients of q_i = q[i, 0] +
    q[i, 1] C_i. K: impedance of the coupling. forcing (2,): f_1 and f_2.
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
        """Return the numerators n_i, (2,), and the denominator Delta of u_i = n_i / Delta at C (2,) (Cramer's rule)."""
        z, q = self.at(C)
        numerators = self.forcing * q[::-1] + self.forcing.sum() * self.K * z[::-1]
        return numerators, q[0] * q[1] + self.K * (z[0] * q[1] + z[1] * q[0])

    def phases(self, C) -> np.ndarray:
        """Return the phases psi (2,) of the fixed point with amplitudes C (2,), a common zero of the `polynomials`."""
        numerators, denominator = self.solve(C)
        return -np.angle(self.at(C)[0] * numerators / denominator)

    def of_module(self, i) -> tuple[np.ndarray, np.ndarray, bool]:
        """Return C (n,) and psi (n,) of the fixed points of the uncoupled module i (0 or 1), and a flag.

        The flag is True if two fixed points coincide within rounding; they are then returned as one.

        Without coupling, |q_i|^2 = f_i^2 is quadratic in C_i: the line of all q_i in the complex plane intersects the
        circle |q| = |f_i|.
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
        """Return the coefficients of two polynomials equivalent to (10.24), and magnitudes of the coefficients.

        Both arrays have the shape (2, 3, 3); entry [:, j, k] belongs to C_1^j C_2^k. A coefficient is a sum of terms,
        and its magnitude is the sum of the moduli of these terms. The magnitudes are the scale of rounding errors.

        The polynomials are |n_2|^2 - |n_1|^2 and |Delta|^2 - |n_1|^2. They vanish where |u_1| = |u_2| = 1, since u_i =
        n_i / Delta (`solve`). n_1 depends on C_2 alone and n_2 on C_1 alone.
        """
        # The first polynomial is proportional to the square of the forces. It is computed for forces of order one,
        # since squares of tiny forces underflow. Scaling by a power of 2 causes no rounding error.
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
    """Return the common denominator of h_1 and h_2 in (10.24), Im(p_1 p_2 conj(z_1 z_2 K^2)) with p_i = q_i + K z_i.

    z_i, q_i and K are those of `Balance`. Constant factors, powers of B_i and the square in h_1 are left out.

    The equations sin^2 psi_i + cos^2 psi_i = 1 for i = 1, 2 lead to two equations that are linear in the cosine and
    sine of psi_2 - psi_1. The determinant of the two linear equations is four times the returned value.

    The returned value is a quadratic polynomial in C_1. For coupled modules, all its coefficients vanish only
    if p_2 = 0. Since impacts dissipate energy, p_2 = 0 is possible only if C_2 = 0.
    """
    balance = Balance.of(system)
    z, q = balance.at(C)
    return float((np.prod((q + balance.K * z) * z.conj()) * balance.K.conjugate() ** 2).imag)


def singular_points(system, point, module) -> np.ndarray:
    """Return the isolated points S on the manifold of one module at which h_1 and h_2 of (10.24) are singular.

    Parameters
    ----------
    point
        Fixed point that gives the constant C of the other module.
    module
        The module on whose manifold the points lie, 1 or 2.

    Returns
    -------
    ndarray
        (C, B) of each point with C >= 0, shape (n, 2), ascending in C; n is 0, 1 or 2. For uncoupled modules n is 0,
        since the whole manifold is singular and no point is isolated.

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
    """Return the real roots of c + b x + a x^2 for coefficients (c, b, a); roots equal within rounding count as one."""
    c, b, a = coefficients
    discriminant = b * b - 4 * a * c
    if abs(discriminant) <= 8 * np.finfo(float).eps * (b * b + abs(4 * a * c)):
        discriminant = 0.0
    if discriminant < 0:
        return np.empty(0)
    # The square root has the sign of b, so that no digits cancel. The roots of the polynomial are q / a and c / q.
    q = -(b + np.copysign(np.sqrt(discriminant), b)) / 2
    return np.array([top / bottom for top, bottom in ((q, a), (c, q)) if bottom != 0])
