"""The power balance at a fixed point, to leading order (docs/derivation.md, section 6)."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.theory.manifold import rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC


@dataclass(frozen=True, eq=False)
class MeanPower:
    """Where the power goes, averaged over a cycle, per unit of tau and in units of M L^2 omega_10^2.

    Relative errors are of the order epsilon. The names are those of `Run.energy`, which is this times the period.

    work: (2,), of the forces. ground: (2,), of the dampers to ground; coupling: of the one between the boxes.
    impacts: (2,). At a fixed point work = ground + coupling + impacts, all summed.
    """

    work: np.ndarray
    ground: np.ndarray
    coupling: float
    impacts: np.ndarray

    @property
    def impact_share(self) -> float:
        """What the impacts take of the power of both forces."""
        return float(self.impacts.sum() / self.work.sum())


def mean_power(system, point) -> MeanPower:
    """The power balance at a fixed point of (10.23): the imaginary part of the complex balance times conj(b_i).

    Args:
        point: a FixedPoint of the system, or what else has the slow variables B, psi, C (2,) of a motion on the
            manifold, where what is not dissipated is stored.
    """
    b, half = point.B * np.exp(-1j * point.psi), system.epsilon / 2
    return MeanPower(
        work=-half * np.array([system.f10_hat, system.f20_hat]) * b.imag,
        ground=half * np.array([system.gamma1_hat, system.gamma2_hat]) * point.B**2,
        coupling=float(half * system.gamma12_hat * abs(b[0] - b[1]) ** 2),
        impacts=half * FIRST_HARMONIC * rho(system.kappa) * point.C**2,
    )
