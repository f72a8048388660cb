"""Find all symmetric 1:1 responses, state(tau + T/2) = -state(tau), as roots of a function of one variable.

Ball i hits wall +1 at tau_i and wall -1 half a period later. Let C_i = 1 - U_i(tau_i), as in (10.12). In half a
period, the ball flies the distance 2 C_i / (1 + epsilon). Its speed is therefore V_i = 4 C_i / ((1 + epsilon) T). The
velocity of box i changes by -2 epsilon V_i at wall +1 and by +2 epsilon V_i at wall -1. The boxes respond to the
forcing and to the trains of impulses of both balls. Module i has two conditions: the ball is at the wall, and
Newton's rule holds. They are the imaginary part and the real part of component i of the equation

    P(delta) C + i (1, 1) = (a_1 exp(i Omega tau_1), a_2 exp(i Omega tau_2)),        delta = tau_2 - tau_1,

with the imaginary unit i, C = (C_1, C_2), a complex 2 x 2 matrix P and the forced amplitudes a_1, a_2. For a given
delta, these equations are linear in C_1, C_2, c = cos(Omega tau_1) and s = sin(Omega tau_1). Their solution must also
satisfy c^2 + s^2 = 1. This condition is one equation for delta. After multiplication by the squared determinant of the
linear system, this equation has no poles. It is analytic except at delta = 0 and delta = T/2, where it has kinks.
Chebyshev interpolants between the kinks therefore give all roots up to rounding. An inactive module (see
`System.modules`) has tau_i = C_i = 0.
"""

import math

import numpy as np
from numpy.polynomial import chebyshev

from vibroimpact.exact.orbits.impulse_response import forced_amplitude, impulse_response
from vibroimpact.exact.orbits.newton import newton
from vibroimpact.system.amplitude import path_of
from vibroimpact.system.matrices import stiffness_matrix

_DEGREE = 32
_PIECES_AT_ONCE = 256  # largest number of pieces in memory at a time; a piece is an interval of delta
_RADIANS_PER_PIECE = 1.0  # phase change [rad] of the fastest oscillation per piece; degree 32 is then exact to rounding
_NOISE = 16 * np.finfo(float).eps  # last coefficients below _NOISE times the largest one are rounding errors
_NEAR = 1e-3  # smaller imaginary parts of roots count as zero, since rounding makes double roots complex
_SAME = 1e-8
_BOXES = np.array([0, 1])
MODULES = np.array([1, 2, 1, 2])
"""Module of each unknown (tau_1, tau_2, C_1, C_2), and of each condition."""


class SymmetricConditions:
    """Conditions of symmetric 1:1 motions: each ball is at its wall, and Newton's rule holds.

    forced: complex amplitudes of the boxes without balls, one row per pair of forces (f10_hat, f20_hat), shape (m, 2).
    If it is None, the only pair is that of `system`. The constructor raises ValueError if the boxes have an undamped
    resonance.
    """

    def __init__(self, system, forced=None):
        self.omega = system.Omega
        self._idle = ~np.isin(MODULES, system.modules)
        self.amplitudes = forced_amplitude(system)[None] if forced is None else forced
        self._response = impulse_response(system, sign=-1)
        self._place = -1 / (1 + system.epsilon)  # Y_i / C_i at the impact at wall +1
        speed = path_of(system.epsilon, 1.0) / (system.period / 2)
        self._kick = 2 * system.epsilon * speed
        self._incoming = speed * (1 + 2 * system.epsilon - system.kappa) / (1 + system.kappa)

    def matrix(self, times: np.ndarray):
        """Return the complex matrix P of the conditions and its derivatives, each of shape (..., 2, 2).

        The derivative of entry (m, k) of P is taken with respect to tau_m - tau_k. times: impact times, shape (..., 2).
        """
        x, v, a = self._response.between(times, _BOXES)
        own = np.eye(2)
        matrix = (self._incoming * own + self._kick * v) / self.omega + 1j * (self._kick * x + self._place * own)
        change = self._kick * (a / self.omega + 1j * v) * (1 - own)
        return matrix, change

    def __call__(self, unknowns: np.ndarray):
        """Return the residuals of the conditions, shape (n, 4), and their Jacobians, shape (n, 4, 4).

        unknowns: tau_1, tau_2, C_1, C_2 in each row, shape (n, 4). A fifth column, if present, is the index of the pair
        of forces.
        """
        times, C = unknowns[:, :2], unknowns[:, 2:4]
        amplitudes = self.amplitudes[unknowns[:, 4].astype(int)] if unknowns.shape[1] > 4 else self.amplitudes
        matrix, change = self.matrix(times)
        forced = amplitudes * np.exp(1j * self.omega * times)
        residual = (matrix @ C[..., None])[..., 0] + 1j - forced
        moved = -change * C[:, None, :]
        moved[:, _BOXES, _BOXES] = (change @ C[..., None])[..., 0] - 1j * self.omega * forced
        jacobian = np.concatenate([moved, matrix], axis=2)
        residual, jacobian = (np.concatenate([of.real, of.imag], axis=1) for of in (residual, jacobian))
        residual[:, self._idle], jacobian[:, self._idle] = unknowns[:, :4][:, self._idle], np.eye(4)[self._idle]
        return residual, jacobian

    def linear_system(self, delta: np.ndarray, force: np.ndarray):
        """Return the linear system of the conditions for given delta = tau_2 - tau_1.

        The matrix has shape (..., 4, 4) and the right-hand side has shape (4,). The unknowns are C_1, C_2, cos(Omega
        tau_1) and sin(Omega tau_1). force: index of the pair of forces.
        """
        times = np.stack([np.zeros_like(delta), delta], axis=-1)
        forced = (self.amplitudes[force] * np.exp(1j * self.omega * times))[..., None]
        columns = np.concatenate([self.matrix(times)[0], -forced, -1j * forced], axis=-1)
        return np.concatenate([columns.real, columns.imag], axis=-2), np.array([0.0, 0.0, -1.0, -1.0])


def symmetric_solutions(system) -> np.ndarray:
    """Return every root (tau_1, tau_2, C_1, C_2) of `SymmetricConditions` with 0 <= tau_i < T, shape (n, 4).

    Roots that are not motions of the system (see `Orbit.admissible`) are included.
    """
    return _solutions(system, [system])[0]


def symmetric_solutions_under(system, forces) -> list[np.ndarray]:
    """Return the result of `symmetric_solutions` for each pair of forces (f10_hat, f20_hat), as a list.

    The other parameters are those of `system`. Raise ValueError if a pair of forces does not give a valid system.
    """
    return _solutions(system, [system.with_(f10_hat=one, f20_hat=other) for one, other in forces])


def _solutions(system, systems):
    """Return a list with the roots of `SymmetricConditions` for each of `systems`, shape (n, 4) per system.

    The elements of `systems` differ from `system` only in their forces.
    """
    found = [np.empty((0, 4))] * len(systems)
    for modules in {one.modules for one in systems} - {()}:
        alike = [k for k, one in enumerate(systems) if one.modules == modules]
        forced = np.array([forced_amplitude(systems[k]) for k in alike])
        conditions = SymmetricConditions(systems[alike[0]], forced)
        uncoupled = system.alpha12 == 0 and system.gamma12 == 0
        starts = _uncoupled_starts(conditions, modules) if uncoupled else _coupled_starts(system, conditions)
        roots = newton(conditions, starts)
        roots[:, :2] = wrapped(roots[:, :2], system.period)
        for number, k in enumerate(alike):
            found[k] = distinct(roots[roots[:, 4] == number, :4], system.period, 2)[0]
    return found


def _uncoupled_starts(conditions, modules):
    """Return starting values of Newton's method for uncoupled modules, shape (n, 5).

    Each row combines a root of module 1 with a root of module 2. The last column is the index of the pair of forces.
    """
    diagonal = np.diagonal(conditions.matrix(np.zeros((1, 2)))[0][0])
    starts = []
    for force, amplitudes in enumerate(conditions.amplitudes):
        single = [[(0.0, 0.0)], [(0.0, 0.0)]]
        for i in (module - 1 for module in modules):
            p, a = diagonal[i], amplitudes[i]
            # The equation |P_ii C_i + j| = |a_i| is quadratic in C_i; a_i: forced amplitude, j: imaginary unit.
            C = np.roots([abs(p) ** 2, 2 * p.imag, 1 - abs(a) ** 2])
            C = C.real[abs(C.imag) < _NEAR]
            single[i] = [(np.angle((p * c + 1j) / a) / conditions.omega, c) for c in C]
        starts += [(t1, t2, c1, c2, force) for t1, c1 in single[0] for t2, c2 in single[1]]
    return np.array(starts).reshape(-1, 5)


def _coupled_starts(system, conditions):
    """Return starting values of Newton's method for coupled modules, shape (n, 5).

    Each root delta of `_roots_of_condition` gives a linear system. `_line_starts` computes three starting values from
    this system. The last column is the index of the pair of forces.
    """
    delta, force = _roots_of_condition(system, conditions)
    C1, C2, c, s = np.moveaxis(_line_starts(*conditions.linear_system(delta, force)), -1, 0)
    time = np.arctan2(s, c) / conditions.omega
    return np.stack(np.broadcast_arrays(time, time + delta[:, None], C1, C2, force[:, None]), axis=-1).reshape(-1, 5)


def _roots_of_condition(system, conditions):
    """Return the roots delta of `_condition` in [0, T], and for each root the index of the pair of forces.

    A root with a small imaginary part counts as real.
    """
    fastest = max(system.Omega, math.sqrt(np.linalg.norm(stiffness_matrix(system), 2)))
    pieces = 2 * math.ceil(system.period / 2 * fastest / _RADIANS_PER_PIECE)
    nodes = chebyshev.chebpts1(_DEGREE + 1)
    half = system.period / pieces / 2
    number, force = np.tile(np.arange(pieces), len(conditions.amplitudes)), np.arange(len(conditions.amplitudes))
    centres, forces = half * (2 * number + 1), np.repeat(force, pieces)
    roots = [np.empty((0, 2))]
    for some in np.array_split(np.arange(len(centres)), math.ceil(len(centres) / _PIECES_AT_ONCE)):
        values = _condition(conditions, centres[some, None] + half * nodes, forces[some, None])
        series = chebyshev.chebfit(nodes, values.T, _DEGREE).T
        rootless = abs(series[:, 0]) > (1 + _NEAR) * abs(series[:, 1:]).sum(axis=1)
        for place, one in zip(some[~rootless], series[~rootless], strict=True):
            near = chebyshev.chebroots(chebyshev.chebtrim(one, _NOISE * abs(one).max()))
            near = near[(abs(near.imag) < _NEAR) & (abs(near.real) < 1 + _NEAR)].real
            roots.append(np.stack([centres[place] + half * near, np.full(len(near), forces[place])], axis=1))
    delta, force = np.concatenate(roots).T
    return delta, force.astype(int)


def _condition(conditions, delta, force):
    """Return N_c^2 + N_s^2 - D^2 for each value in `delta`, shape (pieces, n).

    By Cramer's rule, N_c / D and N_s / D are the values of cos(Omega tau_1) and sin(Omega tau_1) that solve the linear
    system. If their squares add up to 1, the result is zero.

    delta: values of tau_2 - tau_1, one row of n values for each interval, shape (pieces, n).
    force: index of the pair of forces for each row of `delta`, shape (pieces, 1).
    """
    matrices, constant = conditions.linear_system(delta, force)
    size = np.abs(matrices).max(axis=2).mean(axis=1)  # one scale per unknown, so that the determinants are of order 1
    matrices, strength = matrices / size[:, None, None, :], size[:, 2, None]

    # N_c, N_s and D are multiplied by the same positive factor, which keeps their squares within the range of floats.
    def cramer(column):
        replaced = matrices.copy()
        replaced[..., column] = constant
        return np.linalg.det(replaced) / np.maximum(strength, 1.0)

    return cramer(2) ** 2 + cramer(3) ** 2 - (np.linalg.det(matrices) * np.minimum(strength, 1.0)) ** 2


def _line_starts(matrices, constant):
    """Return three starting values of Newton's method for each of n linear systems, shape (n, 3, 4).

    A starting value is (C_1, C_2, c, s), with c = cos(Omega tau_1) and s = sin(Omega tau_1). The first of the three is
    the solution of the system. The two others are points of a line. If the matrix is singular, as for identical modules
    in phase, each point of this line solves the system. If a division by zero occurs, some numbers are not finite.

    matrices, constant: result of `SymmetricConditions.linear_system`.
    """
    u, values, v = np.linalg.svd(matrices)
    parts = constant @ u
    with np.errstate(divide="ignore", invalid="ignore"):
        strong = ((parts / values)[:, None, :3] @ v[:, :3])[:, 0]
        # The line runs along the right singular vector of the smallest singular value. Two starting values are the
        # points of the line with c^2 + s^2 = 1. If there are none, both are the point with the smallest c^2 + s^2.
        weak, along = v[:, 3], np.where(values[:, 3] > 0, parts[:, 3] / values[:, 3], 0.0)
        a, b, c = (weak[:, 2:] ** 2).sum(1), (weak * strong)[:, 2:].sum(1), (strong[:, 2:] ** 2).sum(1) - 1
        depth = np.sqrt(np.maximum(b * b - a * c, 0.0))
        steps = np.stack([along, (-b - depth) / a, (-b + depth) / a], axis=1)
        return strong[:, None] + steps[..., None] * weak[:, None]


def wrapped(value, modulus):
    """Return `value` modulo `modulus`; the result is below `modulus` even after rounding."""
    value = np.mod(value, modulus)
    return np.where(value >= modulus, 0.0, value)


def distinct(roots: np.ndarray, period: float, phases: int):
    """Return the first row of each group of equal rows, and the number of rows in each group.

    Rows are equal if they differ only by rounding. The first `phases` columns are compared modulo the period.
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
