"""Find all symmetric 1:1 responses, state(tau + T/2) = -state(tau), as roots of a function of one variable.

Ball i meets wall +1 at tau_i and wall -1 half a period later. Let C_i = 1 - U_i(tau_i), as in (10.12). In half a
period, the ball flies the distance 2 C_i / (1 + epsilon). Its speed is therefore V_i = 4 C_i / ((1 + epsilon) T). The
velocity of box i changes by -2 epsilon V_i at wall +1 and by +2 epsilon V_i at wall -1. The boxes respond to the
forcing and to both trains of impulses. Each module has two conditions: the ball meets the wall, and Newton's rule. They
are the imaginary and the real part of its component of

    P(delta) C + i (1, 1) = (a_1 exp(i Omega tau_1), a_2 exp(i Omega tau_2)),        delta = tau_2 - tau_1,

with the imaginary unit i, C = (C_1, C_2), a complex 2 x 2 matrix P and the forced amplitudes a_1, a_2. For a given
delta these equations are linear in C_1, C_2, c = cos(Omega tau_1) and s = sin(Omega tau_1). Their solution turns c^2 +
s^2 = 1 into one equation for delta. Multiplied by the squared determinant of the linear system, this equation has no
poles. It is analytic except at the kinks delta = 0 and T/2. Chebyshev interpolants between the kinks therefore give all
roots to rounding. An inactive module (see `System.modules`) has tau_i = C_i = 0.
"""

import math

import numpy as np
from numpy.polynomial import chebyshev

from vibroimpact.exact.orbits.impulse_response import forced_amplitude, impulse_response
from vibroimpact.exact.orbits.newton import newton
from vibroimpact.system.amplitude import path_of
from vibroimpact.system.matrices import stiffness_matrix

_DEGREE = 32
_PIECES_AT_ONCE = 256  # pieces of the range of delta in memory at a time
_RADIANS_PER_PIECE = 1.0  # of the fastest oscillation; interpolation of degree 32 is then exact to rounding
_NOISE = 16 * np.finfo(float).eps  # smaller coefficients at the end of a series are rounding errors
_NEAR = 1e-3  # smaller imaginary parts count as zero; rounding makes double roots complex
_SAME = 1e-8
_BOXES = np.array([0, 1])
MODULES = np.array([1, 2, 1, 2])
"""Module of each unknown (tau_1, tau_2, C_1, C_2), and of each condition."""


class SymmetricConditions:
    """Conditions of symmetric 1:1 motions: each ball is at its wall, and Newton's rule holds.

    forced: complex amplitudes of the boxes without balls, one row per force, (m, 2). An undamped resonance raises
    ValueError.
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
        """Return the complex matrix P (..., 2, 2) of the conditions at impact times (..., 2), and its derivatives.

        Entry (m, k) of P is differentiated by tau_m - tau_k.
        """
        x, v, a = self._response.between(times, _BOXES)
        own = np.eye(2)
        matrix = (self._incoming * own + self._kick * v) / self.omega + 1j * (self._kick * x + self._place * own)
        change = self._kick * (a / self.omega + 1j * v) * (1 - own)
        return matrix, change

    def __call__(self, unknowns: np.ndarray):
        """Return the residual (n, 4) and Jacobian (n, 4, 4) for `unknowns` (n, 4).

        A fifth column of the unknowns, if present, is the index of the force.
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
        """Return the matrix (..., 4, 4) and right-hand side (4,) for (C_1, C_2, cos Omega tau_1, sin Omega tau_1).

        delta: tau_2 - tau_1. force: index of the force.
        """
        times = np.stack([np.zeros_like(delta), delta], axis=-1)
        forced = (self.amplitudes[force] * np.exp(1j * self.omega * times))[..., None]
        columns = np.concatenate([self.matrix(times)[0], -forced, -1j * forced], axis=-1)
        return np.concatenate([columns.real, columns.imag], axis=-2), np.array([0.0, 0.0, -1.0, -1.0])


def symmetric_solutions(system) -> np.ndarray:
    """Return every root (tau_1, tau_2, C_1, C_2) of `SymmetricConditions` with 0 <= tau_i < T, shape (n, 4).

    Inadmissible roots are included.
    """
    return _solutions(system, [system])[0]


def symmetric_solutions_under(system, forces) -> list[np.ndarray]:
    """Return `symmetric_solutions` of the system for each pair of forces (f10_hat, f20_hat).

    A force that gives no valid system raises ValueError.
    """
    return _solutions(system, [system.with_(f10_hat=one, f20_hat=other) for one, other in forces])


def _solutions(system, systems):
    """Return the roots (n, 4) of `SymmetricConditions` for each of several systems that differ only in their forces."""
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
    """Return the Newton starts of uncoupled modules: each root of module 1 with each root of module 2."""
    diagonal = np.diagonal(conditions.matrix(np.zeros((1, 2)))[0][0])
    starts = []
    for force, amplitudes in enumerate(conditions.amplitudes):
        single = [[(0.0, 0.0)], [(0.0, 0.0)]]
        for i in (module - 1 for module in modules):
            p, a = diagonal[i], amplitudes[i]
            # |P_ii C_i + i| = |a_i|, with the forced amplitude a_i, is quadratic in C_i.
            C = np.roots([abs(p) ** 2, 2 * p.imag, 1 - abs(a) ** 2])
            C = C.real[abs(C.imag) < _NEAR]
            single[i] = [(np.angle((p * c + 1j) / a) / conditions.omega, c) for c in C]
        starts += [(t1, t2, c1, c2, force) for t1, c1 in single[0] for t2, c2 in single[1]]
    return np.array(starts).reshape(-1, 5)


def _coupled_starts(system, conditions):
    """Return the Newton starts of coupled modules: those of `_line_starts` for each root of `_roots_of_condition`."""
    delta, force = _roots_of_condition(system, conditions)
    C1, C2, c, s = np.moveaxis(_line_starts(*conditions.linear_system(delta, force)), -1, 0)
    time = np.arctan2(s, c) / conditions.omega
    return np.stack(np.broadcast_arrays(time, time + delta[:, None], C1, C2, force[:, None]), axis=-1).reshape(-1, 5)


def _roots_of_condition(system, conditions):
    """Return the roots delta of `_condition` in [0, T], and the index of the force for each root.

    Nearly real roots are included.
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
    """Return N_c^2 + N_s^2 - D^2 at each delta (pieces, n), which is zero where c^2 + s^2 = 1.

    By Cramer's rule, c = N_c / D and s = N_s / D are the cosine and sine of Omega tau_1. force: its index, (pieces, 1).
    """
    matrices, constant = conditions.linear_system(delta, force)
    size = np.abs(matrices).max(axis=2).mean(axis=1)  # one scale per unknown, so that the determinants are of order 1
    matrices, strength = matrices / size[:, None, None, :], size[:, 2, None]

    # Positive factors keep the squares within the range of floats.
    def cramer(column):
        replaced = matrices.copy()
        replaced[..., column] = constant
        return np.linalg.det(replaced) / np.maximum(strength, 1.0)

    return cramer(2) ** 2 + cramer(3) ** 2 - (np.linalg.det(matrices) * np.minimum(strength, 1.0)) ** 2


def _line_starts(matrices, constant):
    """Return three starts (C_1, C_2, c, s) for each linear system, (n, 3, 4): its solution and two points of a line.

    If the matrix is singular, as for identical modules in phase, the whole line solves the system. A division by zero
    gives a start that is not finite.
    """
    u, values, v = np.linalg.svd(matrices)
    parts = constant @ u
    with np.errstate(divide="ignore", invalid="ignore"):
        strong = ((parts / values)[:, None, :3] @ v[:, :3])[:, 0]
        # The line runs along the right singular vector of the smallest singular value. The starts are its points with
        # c^2 + s^2 = 1 or, if there are none, with the smallest c^2 + s^2.
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
    """Return the first row of each group of equal rows, and the size of each group.

    The first `phases` columns are compared modulo the period.
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
