"""Leading-order power balance of a fixed point, (10.23); derived in docs/derivation.md, section 6."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC


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
