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

    error_state: largest error of a final coordinate. error_time: largest time error [tau] of a matched impact. Both are
    inf without a final state. missed, spurious: numbers of unmatched impacts of the reference and of the run.
    """

    error_state: float
    error_time: float
    missed: int
    spurious: int


def run_errors(run, reference, period: float, faint: float = FAINT, events: bool = True) -> Errors:
    """Return the errors of a MethodRun against a reference run.

    faint: rebound speed up to which impacts may be missed. events: False to ignore impacts.
    """
    if run.final is None:
        return Errors(np.inf, np.inf, 0, 0)
    times, missed, spurious = 0.0, 0, 0
    hits = reference.events[reference.events["kind"] == IMPACT]
    for module in (1, 2) if events else ():
        for wall in (1, -1):
            here = hits[(hits["module"] == module) & (hits["wall"] == wall)]
            taus, box = here["tau"], 4 + 2 * (module - 1)
            plain = np.abs(here["state"][:, box] - here["state"][:, box + 1]) > faint  # rebound speeds |W'|
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
    """Pair times of two ascending sequences that differ by at most `window`.

    Return (largest difference in a pair, number of unpaired expected times, unpaired found times).
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
