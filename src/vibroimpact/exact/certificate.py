"""What a run can vouch for: that no impact was missed, and how far its states can be trusted."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.exact import books

KNOWN = 1e-3
"""A trajectory counts as known while its estimated error is below this: what a printed figure can show."""


@dataclass(frozen=True)
class Certificate:
    """The proof and its limits, for one run.

    flights, exclusions: flights, and proofs along them that nothing happens over an interval; every instant of the
    run is covered by one, or the run raises. chatters: infinite sequences of impacts completed; neglected: bound on
    what completing them changed. wall_residual: largest ||W| - 1| at an impact before it was set to zero.
    nearest_miss: smallest gap at which a ball turned before a wall (inf if none did); shallowest_hit: smallest
    depth that an impact prevented; clearance: smallest ratio of such a gap or depth to the estimated error when it
    happened; undecided: turns and impacts that rounding alone cannot tell from each other.
    error: estimated error of the final state, from unit rounding after every event carried by the variational flow
    (inf past the horizon); horizon: time tau at which this estimate passed 1e-3 (inf if never), beyond which the
    trajectory is one possible motion and not the one asked for.
    """

    flights: int
    exclusions: int
    chatters: int
    neglected: float
    wall_residual: float
    nearest_miss: float
    shallowest_hit: float
    clearance: float
    undecided: int
    error: float
    horizon: float

    @classmethod
    def of(cls, ledger: np.ndarray, turns: np.ndarray, variation: tuple, tau0: float) -> "Certificate":
        """From the kernel's ledger (6,) and turns (n, 2), and what variation.propagate returns, for a run from tau0."""
        unit = np.finfo(float).eps
        _, covariance, horizon, shallowest, clearance = variation
        variance = np.trace(covariance)
        return cls(
            flights=int(ledger[books.FLIGHTS]),
            exclusions=int(ledger[books.EVALUATIONS]),
            chatters=int(ledger[books.CHATTERS]),
            neglected=float(ledger[books.NEGLECTED]),
            wall_residual=float(ledger[books.RESIDUAL]),
            nearest_miss=float(turns[:, 1].min(initial=np.inf)),
            shallowest_hit=shallowest,
            clearance=float(clearance / unit),
            undecided=int(ledger[books.UNDECIDED]),
            error=float(unit * np.sqrt(variance)) if variance >= 0 else np.inf,
            horizon=tau0 + horizon,
        )

    @property
    def decided(self) -> bool:
        """Whether every miss and every hit is clear beyond the error when it happened, all within the horizon."""
        return not self.undecided and self.clearance > 1.0 and bool(np.isfinite(self.error))
