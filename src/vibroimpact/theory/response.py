"""Compute the leading-order steady-state response at a fixed point, (10.9)-(10.10), and its power balance.

The power balance is derived in docs/derivation.md, section 6.
"""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import impact_phase, rho, sawtooth
from vibroimpact.theory.slow_flow import FIRST_HARMONIC


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


@dataclass(frozen=True, eq=False)
class MeanPower:
    """Mean powers over a cycle, per unit of tau and in units of M L^2 omega_10^2.

    The powers are leading-order values, with relative errors of the order epsilon. `Run.energy.per_cycle` has the same
    names for energies; in a steady motion, the energies of a cycle are the powers times the period, up to these errors.

    work (2,): power of the forces. ground (2,): dissipation of the dampers to ground. coupling: dissipation of the
    damper between the boxes. impacts (2,): dissipation of the impacts. At a fixed point the sum of `work` is the sum of
    all dissipation.
    """

    work: np.ndarray
    ground: np.ndarray
    coupling: float
    impacts: np.ndarray

    @property
    def impact_share(self) -> float:
        """Share of the total power of the forces that is dissipated by impacts."""
        return float(self.impacts.sum() / self.work.sum())


def mean_power(system, point) -> MeanPower:
    """Return the power balance at a fixed point, (10.23).

    Each term of the complex balance for b_i = B_i exp(-i psi_i) is multiplied by conj(b_i). The imaginary part of
    the product gives a power.

    The powers of an inactive module are 0.

    Parameters
    ----------
    point
        A FixedPoint of the system, or another object with the slow variables B, psi, C (2,) of a motion on the
        manifold. In a motion that is not steady, the power that is not dissipated is stored.
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
