"""Measure the errors of a run against the reference: final state, impact times, missed and spurious impacts."""

from typing import NamedTuple

import numpy as np

from vibroimpact.system.state import IMPACT

FAINT = 1e-3
"""Largest rebound speed |W'| of impacts in the tail of a chatter. Every method truncates this tail, so that its impacts
are neither required nor counted as spurious."""
WINDOW = 0.05
"""Largest time difference, in forcing periods, between an impact of a run and its match in the reference run."""


class Errors(NamedTuple):
    """Errors of a run against a reference run.

    - error_state: largest error of a coordinate of the final state.
    - error_time: largest error of the time tau of an impact that both runs have.
    - missed: number of impacts that only the reference run has.
    - spurious: number of impacts that the reference run does not have.

    If no impacts match, error_time is 0. If the run has no final state, error_state and error_time are inf.
    """

    error_state: float
    error_time: float
    missed: int
    spurious: int


def run_errors(run, reference, period: float, faint: float = FAINT, events: bool = True) -> Errors:
    """Return the errors of a MethodRun against a reference run.

    faint: a run may miss impacts whose rebound speed is at most `faint`. events: False to compare only final states.
    """
    if run.final is None:
        return Errors(np.inf, np.inf, 0, 0)
    times, missed, spurious = 0.0, 0, 0
    hits = reference.events[reference.events["kind"] == IMPACT]
    for module in (1, 2) if events else ():
        for wall in (1, -1):
            here = hits[(hits["module"] == module) & (hits["wall"] == wall)]
            taus, box = here["tau"], 4 + 2 * (module - 1)
            # A plain impact has a rebound speed |W'| above `faint`.
            plain = np.abs(here["state"][:, box] - here["state"][:, box + 1]) > faint
            theirs = run.impacts[(run.impacts["module"] == module) & (run.impacts["wall"] == wall)]
            theirs = theirs[(theirs["speed"] > faint) | _near(theirs["tau"], taus[plain], WINDOW * period)]
            apart, lost, extra = _align(taus[plain], theirs["tau"], WINDOW * period)
            in_tail = _near(extra, taus[~plain], WINDOW * period)
            times, missed, spurious = max(times, apart), missed + lost, spurious + int(np.sum(~in_tail))
    return Errors(float(np.abs(run.final - reference.final).max()), times, missed, spurious)


def _near(times, others, window) -> np.ndarray:
    """Return True for each time that is within `window` of one of `others`, else False."""
    apart = np.abs(np.subtract.outer(np.asarray(times, dtype=float), others))
    return apart.min(axis=1, initial=np.inf) <= window


def _align(expected, found, window):
    """Pair the times of two ascending sequences. The two times of a pair differ by at most `window`.

    Return the largest difference in a pair, the number of expected times without a pair, and the found times without a
    pair.
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
