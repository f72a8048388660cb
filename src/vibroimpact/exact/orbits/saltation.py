"""Saltation matrix of an impact: how a small perturbation of the whole state passes through it."""

import numpy as np

from vibroimpact.system.matrices import rate_matrix
from vibroimpact.system.restitution import after_impact
from vibroimpact.system.state import BALLS, BOXES


def vector_field(system, state: np.ndarray, tau: float) -> np.ndarray:
    """d state / d tau in free flight at time tau, shape (8,), from (10.2)."""
    rate = rate_matrix(system)
    phase = system.Omega * tau
    field = np.zeros(8)
    field[BOXES] = rate[:4] @ [*state[BOXES], np.sin(phase), np.cos(phase)]
    field[BALLS[:2]] = state[BALLS[2:]]
    return field


def impact_matrix(system, module: int) -> np.ndarray:
    """The linear map R, shape (8, 8), from the state just before an impact in `module` (1 or 2) to just after."""
    matrix = np.eye(8)
    box, ball = 2 * module + 2, 2 * module + 3
    matrix[[box, ball], box] = after_impact(system.epsilon, system.kappa, 1.0, 0.0)
    matrix[[box, ball], ball] = after_impact(system.epsilon, system.kappa, 0.0, 1.0)
    return matrix


def impact_saltation(system, before: np.ndarray, tau: float, module: int) -> np.ndarray:
    """Saltation matrix S, shape (8, 8): perturbation after = S perturbation before, both taken at the time tau.

    before: state (8,) just before the impact of `module` (1 or 2) at time tau. The perturbed motion meets the wall
    n . x = const earlier or later by -n . dx / (n . f-), which gives S = R + (f+ - R f-) n^T / (n . f-)
    (Aizerman and Gantmakher 1958; Leine and Nijmeijer 2004). The forcing enters through f- and f+ alone: wall and
    impact law do not depend on time. det S = kappa^2.

    Raises:
        ValueError: the relative velocity before the impact is zero (grazing), where no such matrix exists.
    """
    normal = np.zeros(8)
    normal[2 * module - 2], normal[2 * module - 1] = 1.0, -1.0
    before_field = vector_field(system, before, tau)
    approach = normal @ before_field
    if approach == 0:
        raise ValueError(f"before: the ball of module {module} touches the wall without relative velocity (grazing)")
    restitution = impact_matrix(system, module)
    after_field = vector_field(system, restitution @ before, tau)
    return restitution + np.outer(after_field - restitution @ before_field, normal) / approach
