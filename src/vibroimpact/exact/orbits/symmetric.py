"""All symmetric 1:1 responses, state(tau + T/2) = -state(tau), as the roots of one function of one variable.

Module i meets wall +1 at tau_i and wall -1 half a period later. With C_i = 1 - U_i(tau_i), as in (10.12), the ball
flies 2 C_i / (1 + epsilon) in half a period: its speed is V_i = 4 C_i / ((1 + epsilon) T). Each impact turns it round,
which kicks box i by -2 epsilon V_i and +2 epsilon V_i in turn. Superposing the forced response and both trains of
kicks, the conditions on module i (it meets the wall; Newton's rule) are the imaginary and the real part of

    P(delta) C + i (1, 1) = (a_1 exp(i Omega tau_1), a_2 exp(i Omega tau_2)),        delta = tau_2 - tau_1,

with a complex 2 x 2 matrix P and the forced amplitudes a. For a given delta these four real equations are linear in
C_1, C_2, c = cos(Omega tau_1), s = sin(Omega tau_1), and c^2 + s^2 = 1 is one equation for delta alone. Multiplied
through by the determinant of the linear system it is analytic and without poles, apart from kinks at delta = 0 and T/2,
so a Chebyshev interpolant between the kinks has all its roots, to rounding.
"""

import math

import numpy as np
from numpy.polynomial import chebyshev

from vibroimpact.exact.orbits.impulse_response import forced_amplitude, impulse_response
from vibroimpact.exact.orbits.newton import newton
from vibroimpact.system.amplitude import path_of
from vibroimpact.system.matrices import stiffness_matrix

_DEGREE = 32
_PIECES_AT_ONCE = 256  # so that memory does not grow with the period
_RADIANS_PER_PIECE = 1.0  # of the fastest oscillation; the interpolant of degree 32 is then exact to rounding
_NOISE = 16 * np.finfo(float).eps  # smaller coefficients at the end of a series are rounding
_NEAR = 1e-3  # a double root may come out of the eigenvalue solver as a pair off the real axis
_SAME = 1e-8
_BOXES = np.array([0, 1])


class SymmetricConditions:
    """The equations above for one system.

    Args:
        response: of the boxes to the kicks; the exact one, or another with its `between` (see `harmonics`).

    Raises:
        ValueError: undamped boxes in resonance with the impacts (see ImpulseResponse).
    """

    def __init__(self, system, response=None):
        self.period = system.period
        self.omega = system.Omega
        self.amplitude = forced_amplitude(system)
        self._response = response or impulse_response(system, sign=-1)
        self._place = -1 / (1 + system.epsilon)  # of the ball at wall +1, per C
        speed = path_of(system.epsilon, 1.0) / (system.period / 2)
        self._kick = 2 * system.epsilon * speed
        self._incoming = speed * (1 + 2 * system.epsilon - system.kappa) / (1 + system.kappa)

    def matrix(self, times: np.ndarray):
        """P and the factor dP of its derivatives for impact times (n, 2): both (n, 2, 2) complex.

        Off the diagonal, dP / d tau_i is +dP in row i and -dP in column i.
        """
        x, v, a = self._response.between(times, _BOXES)
        own = np.eye(2)
        matrix = (self._incoming * own + self._kick * v) / self.omega + 1j * (self._kick * x + self._place * own)
        change = self._kick * (a / self.omega + 1j * v) * (1 - own)
        return matrix, change

    def __call__(self, unknowns: np.ndarray):
        """Residual (n, 4) and Jacobian (n, 4, 4) for unknowns (tau_1, tau_2, C_1, C_2), shape (n, 4)."""
        times, C = unknowns[:, :2], unknowns[:, 2:]
        matrix, change = self.matrix(times)
        forced = self.amplitude * np.exp(1j * self.omega * times)
        residual = (matrix @ C[..., None])[..., 0] + 1j - forced
        moved = -change * C[:, None, :]
        moved[:, _BOXES, _BOXES] = (change @ C[..., None])[..., 0] - 1j * self.omega * forced
        jacobian = np.concatenate([moved, matrix], axis=2)
        return np.concatenate([residual.real, residual.imag], axis=1), np.concatenate([jacobian.real, jacobian.imag], 1)

    def linear_system(self, delta: np.ndarray):
        """Matrix (n, 4, 4) and right-hand side (4,) of the equations for (C_1, C_2, c, s) at each delta (n,)."""
        times = np.stack([np.zeros_like(delta), delta], axis=1)
        forced = (self.amplitude * np.exp(1j * self.omega * times))[..., None]
        columns = np.concatenate([self.matrix(times)[0], -forced, -1j * forced], axis=2)
        return np.concatenate([columns.real, columns.imag], axis=1), np.array([0.0, 0.0, -1.0, -1.0])


def symmetric_solutions(system, response=None) -> np.ndarray:
    """Every root (tau_1, tau_2, C_1, C_2) with 0 <= tau_i < T, shape (n, 4), admissible or not.

    Args:
        response: as SymmetricConditions.

    Raises:
        ValueError: undamped boxes in resonance with the impacts (see ImpulseResponse).
    """
    if system.has_undriven_module:
        return np.empty((0, 4))
    conditions = SymmetricConditions(system, response)
    uncoupled = system.alpha12 == 0 and system.gamma12 == 0
    starts = _uncoupled_starts(conditions) if uncoupled else _coupled_starts(system, conditions)
    roots = newton(conditions, starts)
    roots[:, :2] = wrapped(roots[:, :2], system.period)
    return distinct(roots, system.period, 2)[0]


def _uncoupled_starts(conditions):
    """Each module alone: |P_ii C_i + i| = |a_i| is quadratic in C_i. All pairs of its roots."""
    diagonal = np.diagonal(conditions.matrix(np.zeros((1, 2)))[0][0])
    single = []
    for i in range(2):
        p, a = diagonal[i], conditions.amplitude[i]
        C = np.roots([abs(p) ** 2, 2 * p.imag, 1 - abs(a) ** 2])
        C = C.real[abs(C.imag) < _NEAR]
        single.append([(np.angle((p * c + 1j) / a) / conditions.omega, c) for c in C])
    return np.array([(t1, t2, c1, c2) for t1, c1 in single[0] for t2, c2 in single[1]]).reshape(-1, 4)


def _coupled_starts(system, conditions):
    """Newton starts at the real roots delta of the condition c^2 + s^2 = 1."""
    delta = _roots_of_condition(system, conditions)
    matrices, constant = conditions.linear_system(delta)
    starts = [_circle_points(matrix, constant) for matrix in matrices]
    unknowns = [
        (math.atan2(s, c) / system.Omega, math.atan2(s, c) / system.Omega + d, C1, C2)
        for d, points in zip(delta, starts, strict=True)
        for C1, C2, c, s in points
    ]
    return np.array(unknowns).reshape(-1, 4)


def _roots_of_condition(system, conditions):
    """Real parts of the near-real roots delta in [0, T], by Chebyshev interpolation piece by piece."""
    fastest = max(system.Omega, math.sqrt(np.linalg.norm(stiffness_matrix(system), 2)))
    pieces = 2 * math.ceil(system.period / 2 * fastest / _RADIANS_PER_PIECE)
    nodes = chebyshev.chebpts1(_DEGREE + 1)
    half = system.period / pieces / 2
    centres = half * (2 * np.arange(pieces) + 1)
    roots = []
    for some in np.array_split(centres, math.ceil(pieces / _PIECES_AT_ONCE)):
        values = _condition(conditions, (some[:, None] + half * nodes).ravel()).reshape(len(some), -1)
        series = chebyshev.chebfit(nodes, values.T, _DEGREE).T
        rootless = abs(series[:, 0]) > (1 + _NEAR) * abs(series[:, 1:]).sum(axis=1)
        for centre, one in zip(some[~rootless], series[~rootless], strict=True):
            near = chebyshev.chebroots(chebyshev.chebtrim(one, _NOISE * abs(one).max()))
            near = near[(abs(near.imag) < _NEAR) & (abs(near.real) < 1 + _NEAR)]
            roots.append(centre + half * near.real)
    return np.concatenate([*roots, []])


def _condition(conditions, delta):
    """N_c^2 + N_s^2 - D^2 with Cramer's determinants of the linear system for (C_1, C_2, c, s), c = N_c / D.

    Up to a factor, chosen so that no force is too weak or too strong to be squared.
    """
    matrices, constant = conditions.linear_system(delta)
    size = np.abs(matrices).max(axis=1).mean(axis=0)  # one scale per unknown: keeps the determinants of order one
    matrices, force = matrices / size, size[2]

    def cramer(column):
        replaced = matrices.copy()
        replaced[:, :, column] = constant
        return np.linalg.det(replaced) / max(force, 1.0)

    return cramer(2) ** 2 + cramer(3) ** 2 - (np.linalg.det(matrices) * min(force, 1.0)) ** 2


def _circle_points(matrix, constant):
    """Points (C_1, C_2, c, s) of the solution set that are on, or nearest to, c^2 + s^2 = 1.

    Where the matrix is singular (identical modules in step, say) the solution set is a line and meets the circle twice;
    near such a matrix both points are needed as starts, so the line through the weakest direction is always taken.
    """
    u, values, v = np.linalg.svd(matrix)
    strong = v[:3].T @ ((u[:, :3].T @ constant) / values[:3])
    weak = v[3]
    plain = np.linalg.solve(matrix, constant) if values[3] > 0 else strong
    a, b, c = weak[2:] @ weak[2:], weak[2:] @ strong[2:], strong[2:] @ strong[2:] - 1
    depth = math.sqrt(max(b * b - a * c, 0.0))
    line = [strong + (-b + side * depth) / a * weak for side in (-1, 1)] if a > 0 else []
    return [plain, *line]


def wrapped(value, modulus):
    """value modulo modulus, in [0, modulus) also after rounding."""
    value = np.mod(value, modulus)
    return np.where(value >= modulus, 0.0, value)


def distinct(roots: np.ndarray, period: float, phases: int):
    """One of each group of equal rows, and the size of each group.

    The first `phases` columns are compared on the circle of the given period.
    """
    kept, sizes = np.empty((0, roots.shape[1])), []
    for root in roots:
        gap = np.abs(kept - root)
        gap[:, :phases] = np.minimum(gap[:, :phases], period - gap[:, :phases])
        same = (gap < _SAME * (1 + np.abs(root))).all(axis=1)
        if same.any():
            sizes[int(same.argmax())] += 1
        else:
            kept, sizes = np.vstack([kept, root]), [*sizes, 1]
    return kept, np.array(sizes, dtype=int)
