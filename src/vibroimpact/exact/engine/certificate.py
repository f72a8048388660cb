"""What a run can vouch for: that no impact was missed, and how far its states can be trusted."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.exact.engine import event_log
from vibroimpact.exact.engine.errors import errors_of
from vibroimpact.exact.engine.flow import flow_of
from vibroimpact.exact.engine.margins import DEPTH, DOUBT, hits_of, margins_of
from vibroimpact.exact.engine.phase import phase_at
from vibroimpact.exact.engine.turning_points import DOUBTS, GAP, turning_points
from vibroimpact.system.glance import Glance, brief

KNOWN = 1e-3
"""A trajectory counts as known while its estimated error is below this: what a printed figure can show."""

CLEAR = 4.0
"""What is this many times the estimated error away is decided: true errors stay below 2.6 times the estimate."""


@dataclass(frozen=True, repr=False)
class Certificate(Glance):
    """The proof and its limits, for one run.

    flights, exclusions: flights, and proofs along them that nothing happens over an interval; every instant of the
    run is covered by one, or the run raises. chatters: infinite sequences of impacts completed; neglected: bound on
    what completing them changed. wall_residual: largest ||W| - 1| at an impact before it was set to zero.
    nearest_miss: smallest gap at which a ball turned before a wall, in that half of its box (inf if none did);
    shallowest_hit: smallest depth that an impact prevented; clearance: smallest ratio of a distance to the estimated
    error when it counted, over all by which the run would have had other events: those two, the least contact force of
    a ball that sticks, the depth to which it falls at a release, what an impact leaves of it, and how far from the
    start and the end of the run its events are; undecided: turns and impacts that rounding alone cannot tell from each
    other.
    error: estimated error of the final state, from unit rounding after every event carried by the variational flow
    (inf past the horizon); horizon: time tau of the first event, or end, at which this estimate is above 1e-3 (inf if
    never), beyond which the trajectory is one possible motion and not the one asked for.
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
    def of(cls, run) -> "Certificate":
        """The certificate of a finished run."""
        q, ledger, (flow, flights, rows) = flow_of(run.system).coefficients, run.ledger, run.course
        phase, duration = phase_at(run.begin, run.system.Omega)[0], run.cycles * run.system.period
        turns, hits = turning_points(flow, flights), hits_of(q, flights, rows)
        errors, error = errors_of(flow, flights, rows, KNOWN)
        margins = margins_of(q, flights, turns, hits, rows, phase, duration)
        return cls(
            flights=int(ledger[event_log.FLIGHTS]),
            exclusions=int(ledger[event_log.EVALUATIONS]),
            chatters=int(ledger[event_log.CHATTERS]),
            neglected=float(ledger[event_log.NEGLECTED]),
            wall_residual=float(ledger[event_log.RESIDUAL]),
            nearest_miss=float(turns[:, GAP].min()),
            shallowest_hit=float(hits[:, DEPTH].min(initial=np.inf)),
            clearance=_least_ratio(margins, errors),
            undecided=int(ledger[event_log.UNDECIDED] + turns[:, DOUBTS].sum() + hits[:, DOUBT].sum()),
            error=error,
            horizon=run.tau0 + _horizon(errors, error, rows[:, 0], duration),
        )

    def _glance(self):
        shown = ("clearance", "error", "horizon", "nearest_miss", "undecided")
        return {"decided": str(self.decided), **{name: brief(getattr(self, name)) for name in shown}}

    @property
    def decided(self) -> bool:
        """Whether all that happened is clear beyond the error when it did, within the horizon."""
        return not self.undecided and self.clearance > CLEAR and bool(np.isfinite(self.error))


def _least_ratio(margins, errors):
    """The smallest ratio of a margin to its error; nothing is clear past the horizon."""
    known = np.isfinite(errors)
    return float((margins[known] / errors[known]).min()) if known.all() else 0.0


def _horizon(errors, error, times, duration):
    """When the error passes its limit: the time of the event, or end, from which on it is infinite."""
    if np.isfinite(error):
        return np.inf
    return [*times, duration][np.count_nonzero(np.isfinite(errors[:, 0])) - 1]
