"""Saltation matrix of an impact: how a small perturbation of the whole state passes through it."""

import numpy as np

from vibroimpact.system.matrices import rate_matrix
from vibroimpact.system.restitution import after_impact
from vibroimpact.system.state import BALLS, BOXES

_NORMALS = np.array([[1.0, -1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0]]) @ np.eye(4, 8)
"""Of the walls of both modules: W_i of a state."""


def vector_field(system, state: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """d state / d tau in free flight for states (..., 8) at times tau (...), shape (..., 8), from (10.2)."""
    phase = system.Omega * np.asarray(tau)[..., None]
    field = np.zeros(state.shape)
    boxes = np.concatenate([state[..., BOXES], np.sin(phase), np.cos(phase)], axis=-1)
    field[..., BOXES] = boxes @ rate_matrix(system)[:4].T
    field[..., BALLS[:2]] = state[..., BALLS[2:]]
    return field


def impact_matrix(system, module: np.ndarray) -> np.ndarray:
    """The linear map R, shape (..., 8, 8), from the state just before an impact in `module` (1 or 2) to just after."""
    matrices = np.stack([np.eye(8)] * 2)
    for matrix, velocities in zip(matrices, ([4, 5], [6, 7]), strict=True):
        matrix[np.ix_(velocities, velocities)] = after_impact(system.epsilon, system.kappa, *np.eye(2))
    return matrices[np.asarray(module) - 1]


def impact_saltation(system, before: np.ndarray, tau: np.ndarray, module: np.ndarray) -> np.ndarray:
    """Saltation matrix S, shape (..., 8, 8): perturbation after = S perturbation before, both taken at the time tau.

    before: states (..., 8) just before impacts of `module` (1 or 2) at times tau, both (...). The perturbed motion
    meets the wall n . x = const earlier or later by -n . dx / (n . f-), which gives S = R + (f+ - R f-) n^T / (n . f-)
    (Aizerman and Gantmakher 1958; Leine and Nijmeijer 2004). The forcing enters through f- and f+ alone: wall and
    impact law do not depend on time. det S = kappa^2.

    Raises:
        ValueError: the relative velocity before an impact is zero (grazing), where no such matrix exists.
    """
    normal = _NORMALS[np.asarray(module) - 1]
    before_field = vector_field(system, before, tau)
    approach = (normal * before_field).sum(axis=-1)
    if (approach == 0).any():
        grazing = np.asarray(module)[approach == 0].flat[0]
        raise ValueError(f"before: the ball of module {grazing} touches the wall without relative velocity (grazing)")
    restitution = impact_matrix(system, module)
    after, carried = np.moveaxis(restitution @ np.stack([before, before_field], axis=-1), -1, 0)
    change = vector_field(system, after, tau) - carried
    return restitution + change[..., :, None] * (normal / approach[..., None])[..., None, :]
