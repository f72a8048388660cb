"""Compute the leading-order steady-state response at a fixed point, (10.9)-(10.10)."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import impact_phase, rho, sawtooth


@dataclass(frozen=True, eq=False)
class Response:
    """Dimensionless coordinates of both modules at n times; each array has the shape (n, 2).

    - U: sum X + epsilon Y.
    - X: displacement of the box.
    - W: difference X - Y.
    - Y: displacement of the ball.
    """

    U: np.ndarray
    X: np.ndarray
    W: np.ndarray
    Y: np.ndarray


def leading_order(system, point, tau) -> Response:
    """Return the leading-order motion that belongs to a fixed point, at the times `tau` of shape (n,).

    U_i0 and W_i0 follow from (10.9) and (10.10), and X_i and Y_i follow from U_i0 and W_i0. The forcing is
    f_i sin(Omega tau). All coordinates of an inactive module are 0.
    """
    phase = system.Omega * np.asarray(tau, dtype=float)[:, None] - point.psi
    U = point.B * np.sin(phase)
    W = U + sawtooth(phase, point.C, impact_phase(point.C, rho(system.kappa)))
    U, W = (np.where(np.isin([1, 2], system.modules), of, 0.0) for of in (U, W))
    X = (U + system.epsilon * W) / (1 + system.epsilon)
    return Response(U=U, X=X, W=W, Y=X - W)


def impact_times(system, point) -> np.ndarray:
    """Return the time tau in [0, 2 pi / Omega) at which each ball hits the wall W = +1, shape (2,).

    Each ball hits the wall W = -1 half a forcing period later. The time is NaN for an inactive module.
    """
    phase = impact_phase(point.C, rho(system.kappa)) + point.psi
    return np.remainder(phase, 2 * np.pi) / system.Omega
