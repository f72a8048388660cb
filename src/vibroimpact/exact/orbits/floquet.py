"""Compute the monodromy matrix and the Floquet multipliers of a motion whose impacts are known."""

from typing import NamedTuple

import numpy as np
from scipy.linalg import eig, expm

from vibroimpact.system.matrices import rate_matrix
from vibroimpact.system.restitution import after_impact
from vibroimpact.system.state import BALLS, BOXES, active_mask
from vibroimpact.system.verdict import all_stable, verdict

_MODULES = np.array([1, 1, 2, 2])
_WALLS = np.array([1, -1, 1, -1])
_NORMALS = np.array([[1.0, -1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0]]) @ np.eye(4, 8)
"""Normals of the walls of both modules, (2, 8): their products with a state are W_1 and W_2."""
_ROUNDING = 100 * np.finfo(float).eps


def vector_field(system, state: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """Return the derivative of each state with respect to tau in free flight, by (10.2).

    state: states, shape (..., 8). tau: time of each state, shape (...).
    """
    phase = system.Omega * np.asarray(tau)[..., None]
    field = np.zeros(state.shape)
    boxes = np.concatenate([state[..., BOXES], np.sin(phase), np.cos(phase)], axis=-1)
    field[..., BOXES] = boxes @ rate_matrix(system)[:4].T
    field[..., BALLS[:2]] = state[..., BALLS[2:]]
    return field


def restitution_matrix(system, module: np.ndarray) -> np.ndarray:
    """Return the matrix that multiplies the state at an impact in `module` (1 or 2), shape (..., 8, 8)."""
    matrices = np.stack([np.eye(8)] * 2)
    for matrix, velocities in zip(matrices, ([4, 5], [6, 7]), strict=True):
        matrix[np.ix_(velocities, velocities)] = after_impact(system.epsilon, system.kappa, *np.eye(2))
    return matrices[np.asarray(module) - 1]


def impact_saltation(system, before: np.ndarray, tau: np.ndarray, module: np.ndarray) -> np.ndarray:
    """Return the saltation matrix S of each impact, shape (..., 8, 8).

    S maps a perturbation just before the impact to the perturbation just after it. The determinant of S is kappa^2. The
    forcing enters only through the vector fields, since neither the wall nor the impact law depends on time. Raise
    ValueError if the relative velocity at an impact is zero (grazing).

    before: state just before each impact, shape (..., 8).
    Sources: Aizerman and Gantmakher 1958; Leine and Nijmeijer 2004.
    """
    normal = _NORMALS[np.asarray(module) - 1]
    before_field = vector_field(system, before, tau)
    approach = (normal * before_field).sum(axis=-1)
    if (approach == 0).any():
        grazing = np.asarray(module)[approach == 0].flat[0]
        raise ValueError(
            f"before: got a state in which the ball of module {grazing} touches the wall at zero relative velocity "
            "(grazing), where the motion has no derivative"
        )
    restitution = restitution_matrix(system, module)
    after, carried = np.moveaxis(restitution @ np.stack([before, before_field], axis=-1), -1, 0)
    # A perturbation dx delays the impact by -n . dx / (n . f-), with the normal n of the wall and the vector fields f-,
    # f+ before and after the impact. Therefore S = R + (f+ - R f-) n^T / (n . f-).
    change = vector_field(system, after, tau) - carried
    return restitution + change[..., :, None] * (normal / approach[..., None])[..., None, :]


class Passage(NamedTuple):
    """Motion from tau = 0 to tau = `end` through n impacts.

    first, final: states at tau = 0 and at tau = `end`, each of shape (8,).
    times: times of the impacts, shape (n,).
    before, after: states just before and just after each impact, each of shape (n, 8).
    jacobian: derivative of `final` with respect to `first`, shape (8, 8).
    """

    first: np.ndarray
    times: np.ndarray
    before: np.ndarray
    after: np.ndarray
    final: np.ndarray
    end: float
    jacobian: np.ndarray

    def flights(self):
        """Return the initial states, initial times and durations of all n + 1 free flights."""
        edges = np.array([0.0, *self.times, self.end])
        return np.vstack([self.first, self.after]), edges[:-1], np.diff(edges)


def impact_sequence(times: np.ndarray, period: float):
    """Return the times, modules and walls of the impacts of one period, each of shape (n,), in order of time.

    times: impact times in [0, T) with T = `period`, shape (2, 2). The indices are [module, wall +1 / wall -1]. The
    times of a module without impacts are NaN.
    """
    # An impact at 0 is moved to T, since the state at tau = 0 is the state after this impact.
    within = np.where(times == 0, period, times).ravel()
    order = np.argsort(within, kind="stable")[: np.isfinite(within).sum()]
    return within[order], _MODULES[order], _WALLS[order]


def free_flights(system, begins: np.ndarray, durations: np.ndarray):
    """Return the matrices A and vectors b of n free flights, each of which maps a state x to A x + b.

    A has shape (n, 8, 8) and b has shape (n, 8). begins, durations: initial time and duration of each flight, shape
    (n,).
    """
    flow = expm(rate_matrix(system) * durations[:, None, None])
    phases = system.Omega * begins
    maps, pushes = np.zeros((len(durations), 8, 8)), np.zeros((len(durations), 8))
    maps[:, BOXES[:, None], BOXES] = flow[:, :4, :4]
    maps[:, BALLS, BALLS] = 1.0
    maps[:, BALLS[:2], BALLS[2:]] = durations[:, None]
    pushes[:, BOXES] = (flow[:, :4, 4:] @ np.stack([np.sin(phases), np.cos(phases)], axis=1)[..., None])[..., 0]
    return maps, pushes


def follow(system, state: np.ndarray, times: np.ndarray, modules: np.ndarray, end: float) -> Passage:
    """Follow the motion from `state` at tau = 0 to tau = `end`, through impacts at the given times.

    state: shape (8,). times: ascending times of the impacts. modules: module (1 or 2) of each impact. The function does
    not check that the ball is at a wall at these times.
    """
    edges = np.array([0.0, *times, end])
    flights, pushes = free_flights(system, edges[:-1], np.diff(edges))
    before, after = np.empty((len(times), 8)), np.empty((len(times), 8))
    now = state
    for k, impact in enumerate(restitution_matrix(system, modules)):
        before[k] = flights[k] @ now + pushes[k]
        after[k] = now = impact @ before[k]
    jacobian = flights[0]
    for saltation, flight in zip(impact_saltation(system, before, edges[1:-1], modules), flights[1:], strict=True):
        jacobian = flight @ saltation @ jacobian
    return Passage(state, edges[1:-1], before, after, flights[-1] @ now + pushes[-1], end, jacobian)


def active_part(system, jacobian: np.ndarray) -> np.ndarray:
    """Return the part of a monodromy matrix for the active modules.

    The shape is (8, 8), or (4, 4) if only one module is active.
    """
    part = active_mask(system)
    return jacobian[part][:, part]


def multipliers(jacobian: np.ndarray) -> np.ndarray:
    """Return the complex eigenvalues of a monodromy matrix of shape (n, n) by descending modulus, shape (n,).

    Eigenvalues of equal modulus are in the order of descending imaginary part.
    """
    values = np.linalg.eigvals(jacobian).astype(complex)
    return values[np.lexsort((-values.imag.round(12), -abs(values).round(12)))]


def floquet(orbit) -> str:
    """Return the stability of an Orbit by its multipliers (see `by_multipliers`)."""
    jacobian = active_part(orbit.system, orbit.passage.jacobian)
    return by_multipliers(jacobian, orbit.residual, np.nanmin(np.abs(orbit.ball_speeds)))


def by_multipliers(jacobian: np.ndarray, residual: float, slowest: float) -> str:
    """Return "stable" if all multipliers are inside the unit circle, "unstable" if one is outside, else "undecided".

    A multiplier counts as inside or outside only if its modulus differs from 1 by more than its error.

    jacobian: monodromy matrix.
    residual: largest difference between the states at the start and at the end of one period.
    slowest: smallest relative speed of a ball at a wall.
    """
    values, left, right = eig(jacobian, left=True, right=True)
    size = np.linalg.norm(jacobian)
    with np.errstate(divide="ignore"):
        condition = 1 / np.abs(np.einsum("ij,ij->j", left.conj(), right))
        displaced = (residual + _ROUNDING) / np.abs(values - 1).min()
    # To first order, the error of an eigenvalue is its condition number times the error of the matrix. The error of the
    # matrix comes from rounding and from the error of the orbit.
    errors = size * condition * (_ROUNDING + displaced / slowest)
    return all_stable(verdict(1 - abs(value), error) for value, error in zip(values, errors, strict=True))
