"""Distinguish the attractors that several initial states end in."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.exact.periodic import PeriodicOrbit, refined
from vibroimpact.studies.regimes.classification import PERIODIC, UNSETTLED, Regime
from vibroimpact.system.state import takes_part

OPEN = -1
"""Label of an initial state that has not settled, as in Attractors.jl."""
_SAME, _SAME_IDLE = 1e-6, 1e-4
"""Largest difference of displacements of equal motions; the second if a ball is at rest, where decay limits
accuracy."""


@dataclass(frozen=True, eq=False)
class Attractor:
    """An attractor.

    Attributes
    ----------
    regime : str
        One of `vibroimpact.studies.regimes.classification.REGIMES`.
    cycles : int or None
        Forcing periods after which it repeats, or None.
    states : ndarray
        Stroboscopic section, shape (k, 8): all `cycles` points or, if it does not repeat, those of a window.
    orbit : PeriodicOrbit or None
        Multipliers, impacts and amplitudes of a motion whose regime is periodic; else None.
    """

    regime: str
    cycles: int | None
    states: np.ndarray
    orbit: PeriodicOrbit | None


def attractors(regimes: list[Regime]) -> tuple[np.ndarray, list[Attractor]]:
    """Return the attractor label of each start, or OPEN if it has not settled.

    Labels count from 1 in the order in which the attractors are met.

    Periodic motions are the same attractor if their displacements agree after a shift by whole periods; mirror images
    are two attractors. Motions that do not repeat are distinguished only by their regime. The position of a ball at
    rest is ignored.
    """
    labels, known = np.full(len(regimes), OPEN), []
    for k, regime in enumerate(regimes):
        if regime.name == UNSETTLED:
            continue
        place = next((n for n, one in enumerate(known) if _same(one, regime)), len(known))
        known[place:] = known[place:] or [regime]
        labels[k] = place + 1
    return labels, [_attractor(one) for one in known]


def _attractor(regime):
    run, repeats = regime.run, regime.repeats
    orbit = refined(run.system, run.start, repeats) if regime.name in PERIODIC else None
    return Attractor(regime.name, repeats, run.samples[::2][:repeats], orbit)


def _same(one, other):
    """Return True if two regimes are one attractor."""
    moving = _moving(one)
    if (one.name, one.repeats) != (other.name, other.repeats) or not np.array_equal(moving, _moving(other)):
        return False
    if one.repeats is None:
        return True
    ours, theirs = (regime.run.samples[: 2 * one.repeats, moving] for regime in (one, other))
    gaps = [np.abs(np.roll(ours, 2 * shift, axis=0) - theirs).max() for shift in range(one.repeats)]
    idle = len(moving) < np.count_nonzero(takes_part(one.run.system)[:4])
    return min(gaps) < (_SAME_IDLE if idle else _SAME)


def _moving(regime):
    """Return the displacements of modules that take part, without those of balls at rest."""
    samples, moves = regime.run.samples, takes_part(regime.run.system)
    return np.array([k for k in range(4) if moves[k] and (k in (0, 2) or samples[:, 4 + k].any())])
