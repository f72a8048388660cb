"""Leading-order steady-state response of a fixed point, (10.9)-(10.10), and its power balance.

The power balance is derived in docs/derivation.md, section 6.
"""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import impact_phase, rho, sawtooth
from vibroimpact.theory.slow_flow import FIRST_HARMONIC


@dataclass(frozen=True, eq=False)
class Response:
    """Coordinates of both modules over time, each shape (n, 2), dimensionless.

    Attributes
    ----------
    U, X : ndarray
        Coordinate U_i = X_i + epsilon Y_i, and displacement of the boxes.
    W, Y : ndarray
        Relative displacement W_i = X_i - Y_i, and displacement of the balls.
    """

    U: np.ndarray
    X: np.ndarray
    W: np.ndarray
    Y: np.ndarray


def leading_order(system, point, tau) -> Response:
    """Return U_i0 and W_i0 of (10.9), (10.10) at a fixed point, and the corresponding X_i, Y_i.

    All coordinates of a module that takes no part are 0.

    Parameters
    ----------
    point
        A fixed point (its C, B, psi are used).
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

    The time is NaN for a module that takes no part.

    Parameters
    ----------
    point
        A fixed point (its C and psi are used).
    """
    phase = impact_phase(point.C, rho(system.kappa)) + point.psi
    return np.remainder(phase, 2 * np.pi) / system.Omega


@dataclass(frozen=True, eq=False)
class MeanPower:
    """Mean power balance over a cycle, per unit of tau and in units of M L^2 omega_10^2.

    Relative errors are of the order epsilon. The names are those of `Run.energy`, whose values are these times the
    period.

    work: (2,), of the forces. ground: (2,), of the dampers to ground. coupling: of the damper between the boxes.
    impacts: (2,). At a fixed point work = ground + coupling + impacts, all summed.
    """

    work: np.ndarray
    ground: np.ndarray
    coupling: float
    impacts: np.ndarray

    @property
    def impact_share(self) -> float:
        """Share of the power of both forces that impacts dissipate."""
        return float(self.impacts.sum() / self.work.sum())


def mean_power(system, point) -> MeanPower:
    """Return the power balance at a fixed point of (10.23).

    It is the imaginary part of the complex balance times conj(b_i).

    A module that takes no part has no power.

    Parameters
    ----------
    point
        A FixedPoint of the system, or another object with the slow variables B, psi, C (2,) of a motion on the
        manifold; power that is not dissipated is stored.
    """
    half = system.epsilon / 2
    B, psi, C = (np.where(np.isin([1, 2], system.modules), of, 0.0) for of in (point.B, point.psi, point.C))
    b = B * np.exp(-1j * psi)
    return MeanPower(
        work=-half * np.array([system.f10_hat, system.f20_hat]) * b.imag,
        ground=half * np.array([system.gamma1_hat, system.gamma2_hat]) * B**2,
        coupling=float(half * system.gamma12_hat * abs(b[0] - b[1]) ** 2),
        impacts=half * FIRST_HARMONIC * rho(system.kappa) * C**2,
    )
