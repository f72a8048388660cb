"""Measure the errors of a run against the reference: final state, impact times, missed and spurious impacts."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.system.state import IMPACT

FAINT = 1e-3
"""Rebound speed |W'| up to which an impact belongs to the tail of a chatter, which every method truncates. Such impacts
are neither required nor counted as spurious."""
WINDOW = 0.05
"""Largest distance in time, in forcing periods, of impacts that count as the same one."""


@dataclass(frozen=True)
class Errors:
    """Errors of a run.

    final: largest difference of a coordinate of the final state (inf without one). times: largest difference of the
    times [tau] of matching impacts (0 without any). missed, spurious: numbers of unmatched impacts of the reference and
    of the run.
    """

    final: float
    times: float
    missed: int
    spurious: int

    def columns(self) -> dict[str, float]:
        """Return the errors by the names of table columns."""
        names = "error_state", "error_time", "missed", "spurious"
        return dict(zip(names, (self.final, self.times, self.missed, self.spurious), strict=True))


def run_errors(run, reference, period: float, faint: float = FAINT, events: bool = True) -> Errors:
    """Return the errors of a MethodRun against a reference run of the same motion.

    The reference has `events` and `final` as a run of `vibroimpact.simulate`.

    Parameters
    ----------
    period : float
        Forcing period, in units of tau.
    faint : float, default FAINT
        Rebound speed at and below which an impact need not be found.
    events : bool, default True
        False if the reference has the same final state but not all events before it.
    """
    if run.final is None:
        return Errors(np.inf, np.inf, 0, 0)
    times, missed, spurious = 0.0, 0, 0
    speeds = rebound_speeds(reference.events)
    hits = reference.events["kind"] == IMPACT
    for module in (1, 2) if events else ():
        for wall in (1, -1):
            here = hits & (reference.events["module"] == module) & (reference.events["wall"] == wall)
            taus = reference.events["tau"][here]
            plain = speeds[here] > faint
            theirs = run.impacts[(run.impacts["module"] == module) & (run.impacts["wall"] == wall)]
            theirs = theirs[(theirs["speed"] > faint) | _near(theirs["tau"], taus[plain], WINDOW * period)]
            apart, lost, extra = _align(taus[plain], theirs["tau"], WINDOW * period)
            in_tail = _near(extra, taus[~plain], WINDOW * period)
            times, missed, spurious = max(times, apart), missed + lost, spurious + int(np.sum(~in_tail))
    return Errors(float(np.abs(run.final - reference.final).max()), times, missed, spurious)


def rebound_speeds(events) -> np.ndarray:
    """Return |W'| just after each of the events of a run, shape (n,), in its own module."""
    box = 4 + 2 * (events["module"].astype(int) - 1)
    rows = np.arange(len(events))
    return np.abs(events["state"][rows, box] - events["state"][rows, box + 1])


def _near(times, others, window) -> np.ndarray:
    """Return True for each time with another time within the window."""
    apart = np.abs(np.subtract.outer(np.asarray(times, dtype=float), others))
    return apart.min(axis=1, initial=np.inf) <= window


def _align(expected, found, window):
    """Pair two ascending sequences in order.

    Returns (largest distance in a pair, number of expected and list of found without a pair).
    """
    apart, lost, extra = 0.0, 0, []
    i = j = 0
    while i < len(expected) and j < len(found):
        distance = found[j] - expected[i]
        if abs(distance) <= window:
            apart, i, j = max(apart, abs(distance)), i + 1, j + 1
        elif distance > 0:
            lost, i = lost + 1, i + 1
        else:
            extra.append(found[j])
            j += 1
    return apart, lost + len(expected) - i, [*extra, *found[j:]]
