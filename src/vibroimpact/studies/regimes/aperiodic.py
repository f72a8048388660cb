"""Classify motions that do not repeat by Lyapunov exponent, time in resonance, and recurrence."""

import numpy as np

from vibroimpact.exact.engine.simulation import Run, simulate
from vibroimpact.exact.measures.modulation import bursts_in
from vibroimpact.studies.regimes.classification import CHAOTIC, HOPPING, QUASI_PERIODIC, STRONGLY_MODULATED, UNSETTLED
from vibroimpact.studies.regimes.lyapunov import Measured, largest_lyapunov

CERTAIN = 3.0
"""Number of standard errors used as the uncertainty of an exponent."""
RESOLVED = 0.02
"""Largest uncertainty, per forcing period, at which an exponent consistent with 0 counts as 0."""
RECURRENT = 0.1
"""A motion recurs if it returns to its start within this fraction of its extent, in every coordinate."""
RESONANT = (0.1, 0.9)
"""Fractions of the time in bursts below which a module is never, and above which it is always, in resonance."""
DISCARDED = 1
"""Number of blocks of the transient."""
LONGER = 10
"""Factor by which the second estimate of an exponent is longer, where the first leaves its sign open."""

POSITIVE, ZERO, OPEN = "positive", "zero", "open"
NEVER, AT_TIMES, ALWAYS = "never", "at times", "always"

NAMES = {
    (POSITIVE, AT_TIMES): STRONGLY_MODULATED,
    (POSITIVE, ALWAYS): CHAOTIC,
    (POSITIVE, NEVER): HOPPING,
    (ZERO, AT_TIMES): QUASI_PERIODIC,
    (ZERO, ALWAYS): QUASI_PERIODIC,
    (ZERO, NEVER): QUASI_PERIODIC,
}
"""Name by (sign of the largest exponent, resonance); combinations that are not listed are unsettled."""


def name_aperiodic(run: Run, blocks: int, block: int) -> str:
    """Return the name of a motion that does not repeat, from a run over whole cycles and its continuation.

    Parameters
    ----------
    blocks, block : int
        Number of blocks of the exponent, and cycles per block.
    """

    def of_length(cycles):
        return sign(largest_lyapunov(run.system, run.final, cycles, 0, blocks, DISCARDED))

    found = of_length(blocks * block)
    if found != POSITIVE:
        found = of_length(LONGER * blocks * block)
    if found == ZERO and not recurs(run.system, run.final, LONGER * blocks * block):
        return UNSETTLED
    return NAMES.get((found, resonance(resonant_shares(run))), UNSETTLED)


def sign(exponent: Measured) -> str:
    """Return POSITIVE or ZERO where the error allows it, else OPEN.

    OPEN also stands for a periodic motion that is not reached yet.
    """
    if exponent.mean > CERTAIN * exponent.error:
        return POSITIVE
    return ZERO if abs(exponent.mean) <= CERTAIN * exponent.scatter <= RESOLVED else OPEN


def resonance(shares) -> str:
    """Return NEVER, AT_TIMES or ALWAYS, from the part of the time that each module is in resonance, shape (2,).

    A module that comes and goes decides.
    """
    low, high = RESONANT
    shares = np.asarray(shares)
    if ((low <= shares) & (shares <= high)).any():
        return AT_TIMES
    return ALWAYS if (shares > high).any() else NEVER


def resonant_shares(run: Run) -> np.ndarray:
    """Return the part of the time that each module is in bursts of resonance, shape (2,)."""
    resonant = np.array([np.diff(bursts_in(run, module)).sum() for module in (1, 2)])
    return resonant / (run.cycles * run.system.period)


def recurs(system, state, cycles: int) -> bool:
    """Return True if a motion comes near its start in the second half of some cycles; a decaying one does not."""
    states = simulate(system, state, cycles, sample_times=np.arange(cycles + 1) * system.period).samples
    extent = np.ptp(states, axis=0)
    away = np.abs(states[cycles // 2 :] - states[0]) / np.where(extent > 0, extent, 1.0)
    return bool(away.max(axis=1).min() <= RECURRENT)
