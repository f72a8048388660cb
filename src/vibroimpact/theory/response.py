"""Compute the leading-order steady-state response at a fixed point, (10.9)-(10.10)."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import impact_phase, rho, sawtooth


@dataclass(frozen=True, eq=False)
class Response:
    """Coordinates of both modules at n times, each (n, 2), dimensionless.

    Attributes
    ----------
    U, X : ndarray
        Coordinates U_i = X_i + epsilon Y_i, and displacements X_i of the boxes.
    W, Y : ndarray
        Relative displacements W_i = X_i - Y_i, and displacements Y_i of the balls.
    """

    U: np.ndarray
    X: np.ndarray
    W: np.ndarray
    Y: np.ndarray


def leading_order(system, point, tau) -> Response:
    """Return U_i0 and W_i0 of (10.9), (10.10) for a fixed point, with the corresponding X_i and Y_i, at times `tau`.

    All coordinates of an inactive module are 0.

    Parameters
    ----------
    point
        A fixed point, of which C, B and psi are used.
    tau
        Times, shape (n,), dimensionless; the forcing is f_i sin(Omega tau).
    """
    phase = system.Omega * np.asarray(tau, dtype=float)[:, None] - point.psi
    U = point.B * np.sin(phase)
    W = U + sawtooth(phase, point.C, impact_phase(point.C, rho(system.kappa)))
    U, W = (np.where(np.isin([1, 2], system.modules), of, 0.0) for of in (U, W))
    X = (U + system.epsilon * W) / (1 + system.epsilon)
    return Response(U=U, X=X, W=W, Y=X - W)


def impact_times(system, point) -> np.ndarray:
    """Return the time tau in [0, period) at which each ball meets the wall W = +1, shape (2,).

    Each ball meets the wall W = -1 half a period later.

    The time is NaN for an inactive module.

    Parameters
    ----------
    point
        A fixed point, of which C and psi are used.
    """
    phase = impact_phase(point.C, rho(system.kappa)) + point.psi
    return np.remainder(phase, 2 * np.pi) / system.Omega
