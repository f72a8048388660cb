"""What a run can vouch for: that no impact was missed, and how far its states can be trusted."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.exact import events as kernel

KNOWN = 1e-3
"""A trajectory counts as known while its estimated error is below this: what a printed figure can show."""


@dataclass(frozen=True)
class Certificate:
    """The proof and its limits, for one run.

    flights, exclusions: flights, and proofs along them that nothing happens over an interval; every instant of the
    run is covered by one, or the run raises. chatters: infinite sequences of impacts completed; neglected: bound on
    what completing them changed. wall_residual: largest ||W| - 1| at an impact before it was set to zero.
    nearest_miss: smallest gap at which a ball turned before a wall (inf if none did); shallowest_hit: smallest
    depth that an impact prevented. undecided: turns and impacts that rounding alone cannot tell from each other.
    error: estimated error of the final state, from unit rounding after every event carried by the variational flow
    (inf past the horizon); error_at_miss, error_at_hit: the same just before the event that follows the nearest
    miss, and before the shallowest hit; horizon: time tau at which this estimate passed 1e-3 (inf if never), beyond
    which the trajectory is one possible motion and not the one asked for.
    """

    flights: int
    exclusions: int
    chatters: int
    neglected: float
    wall_residual: float
    nearest_miss: float
    shallowest_hit: float
    undecided: int
    error: float
    error_at_miss: float
    error_at_hit: float
    horizon: float

    @property
    def decided(self) -> bool:
        """Whether the nearest miss and the shallowest hit are clear beyond the error there, all within the horizon."""
        clear = self.nearest_miss > self.error_at_miss and self.shallowest_hit > self.error_at_hit
        return not self.undecided and clear and bool(np.isfinite(self.error))


def certify(ledger: np.ndarray, covariance: np.ndarray, horizon: float, marked: np.ndarray) -> Certificate:
    """The certificate from the kernel's ledger (10,), the covariance (8, 8) of unit rounding errors at the end, and its
    root (2,) at the nearest miss and the shallowest hit.
    """
    unit = np.finfo(float).eps
    variance = np.trace(covariance)
    no_miss, no_hit = np.isinf(ledger[[kernel.CLEARED, kernel.PIERCED]])
    return Certificate(
        flights=int(ledger[kernel.FLIGHTS]),
        exclusions=int(ledger[kernel.EVALUATIONS]),
        chatters=int(ledger[kernel.CHATTERS]),
        neglected=float(ledger[kernel.NEGLECTED]),
        wall_residual=float(ledger[kernel.RESIDUAL]),
        nearest_miss=float(ledger[kernel.CLEARED]),
        shallowest_hit=float(ledger[kernel.PIERCED]),
        undecided=int(ledger[kernel.UNDECIDED]),
        error=float(unit * np.sqrt(variance)) if variance >= 0 else np.inf,
        error_at_miss=0.0 if no_miss else float(unit * marked[0]),
        error_at_hit=0.0 if no_hit else float(unit * marked[1]),
        horizon=horizon,
    )
