"""The verdict of the Floquet multipliers on an orbit, with three states."""

import numpy as np
from scipy.linalg import eig

from vibroimpact.system.verdict import all_stable, verdict

_ROUNDING = 100 * np.finfo(float).eps


def floquet(orbit) -> str:
    """ "stable" if all multipliers are inside the unit circle, "unstable" if one is outside, else "undecided".

    A multiplier decides where its modulus differs from 1 by more than its own error, estimated to first order: the
    condition number of the eigenvalue times the error of the monodromy matrix. That is rounding and the error of the
    orbit (its residual over the distance of the nearest multiplier from +1), relative to the norm of the matrix.
    """
    jacobian = orbit.passage.jacobian
    values, left, right = eig(jacobian, left=True, right=True)
    size = np.linalg.norm(jacobian)
    condition = 1 / np.abs(np.einsum("ij,ij->j", left.conj(), right))
    displaced = (orbit.residual + _ROUNDING) / np.abs(values - 1).min()
    errors = size * condition * (_ROUNDING + displaced / np.abs(orbit.ball_speeds).min())
    return all_stable(verdict(1 - abs(value), error) for value, error in zip(values, errors, strict=True))
