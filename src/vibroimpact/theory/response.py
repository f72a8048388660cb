"""The leading-order steady-state response of a fixed point, (10.9)-(10.10)."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import impact_phase, rho
from vibroimpact.theory.sawtooth import sawtooth


@dataclass(frozen=True, eq=False)
class Response:
    """Coordinates of both modules over time, each shape (n, 2), dimensionless.

    Attributes:
        U, X: coordinate U_i = X_i + epsilon Y_i and displacement of the boxes.
        W, Y: relative displacement W_i = X_i - Y_i and displacement of the balls.
    """

    U: np.ndarray
    X: np.ndarray
    W: np.ndarray
    Y: np.ndarray


def leading_order(system, point, tau) -> Response:
    """U_i0 and W_i0 of (10.9), (10.10) at a fixed point, and X_i, Y_i that belong to them.

    Args:
        point: a fixed point (its C, B, psi are used).
        tau: times, shape (n,), dimensionless; the forcing is f_i sin(Omega tau).
    """
    phase = system.Omega * np.asarray(tau, dtype=float)[:, None] - point.psi
    U = point.B * np.sin(phase)
    W = U + sawtooth(phase, point.C, impact_phase(point.C, rho(system.kappa)))
    X = (U + system.epsilon * W) / (1 + system.epsilon)
    return Response(U=U, X=X, W=W, Y=X - W)


def impact_times(system, point) -> np.ndarray:
    """Time tau in [0, period) at which each ball meets the wall W = +1, shape (2,); half a period later it is at -1.

    Args:
        point: a fixed point (its C and psi are used).
    """
    phase = impact_phase(point.C, rho(system.kappa)) + point.psi
    return np.remainder(phase, 2 * np.pi) / system.Omega
