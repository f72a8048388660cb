"""Name the regime of a motion that does not repeat, from its Lyapunov exponent, resonance and recurrence."""

import numpy as np

from vibroimpact.exact.engine.simulation import Run, simulate
from vibroimpact.exact.measures.modulation import bursts_in
from vibroimpact.studies.regimes.classification import CHAOTIC, HOPPING, QUASI_PERIODIC, STRONGLY_MODULATED, UNSETTLED
from vibroimpact.studies.regimes.lyapunov import Measured, largest_lyapunov

ERROR_FACTOR = 3.0
"""Number of standard errors used as the uncertainty of an exponent."""
RESOLVED = 0.02
"""Largest uncertainty, per forcing period, at which an exponent consistent with 0 counts as 0."""
RECURRENT = 0.1
"""A motion recurs if it returns to its first state within this fraction of the motion's extent in every coordinate."""
RESONANT = (0.1, 0.9)
"""Limits of the share of time in bursts. A module with a share below the first limit counts as never in resonance, with
a share above the second limit as always in resonance."""
DISCARDED = 1
"""Number of blocks at the start of a run that are not used for the exponent. In these blocks, the perturbation turns to
the direction of largest growth."""
SECOND_LENGTH_FACTOR = 10
"""Length of the run for the second estimate of an exponent, relative to the run for the first estimate. The second
estimate is made only if the first one is not certainly positive."""

POSITIVE, ZERO, OPEN = "positive", "zero", "open"
NEVER, AT_TIMES, ALWAYS = "never", "at times", "always"

CHAOTIC_REGIMES = {AT_TIMES: STRONGLY_MODULATED, ALWAYS: CHAOTIC, NEVER: HOPPING}
"""Regime of a motion with a positive exponent, by its resonance."""


def name_aperiodic(run: Run, blocks: int, block: int) -> str:
    """Return the regime of a motion that does not repeat.

    The Lyapunov exponent is computed from a run of `blocks` blocks. If the exponent is not certainly positive, it is
    computed again from a longer run.

    blocks: number of blocks, the same in both runs.
    block: length of each block of the first run, in forcing cycles.
    """

    def of_length(cycles):
        return sign(largest_lyapunov(run.system, run.final, cycles, 0, blocks, DISCARDED))

    found = of_length(blocks * block)
    if found != POSITIVE:
        found = of_length(SECOND_LENGTH_FACTOR * blocks * block)
    if found == ZERO and recurs(run.system, run.final, SECOND_LENGTH_FACTOR * blocks * block):
        return QUASI_PERIODIC
    if found != POSITIVE:
        return UNSETTLED
    resonant = np.array([np.diff(bursts_in(run, module)).sum() for module in (1, 2)])
    return CHAOTIC_REGIMES[resonance(resonant / (run.cycles * run.system.period))]


def sign(exponent: Measured) -> str:
    """Return the sign of a Lyapunov exponent: POSITIVE, ZERO, or OPEN if the sign is uncertain.

    If the exponent is certainly negative, the result is OPEN too, since the motion still approaches a periodic motion.
    """
    if exponent.mean > ERROR_FACTOR * exponent.error:
        return POSITIVE
    return ZERO if abs(exponent.mean) <= ERROR_FACTOR * exponent.scatter <= RESOLVED else OPEN


def resonance(shares) -> str:
    """Return AT_TIMES if a module enters and leaves resonance, else ALWAYS if a module stays in resonance, else NEVER.

    shares: for each module, the share of time during which it is in resonance.
    """
    low, high = RESONANT
    shares = np.asarray(shares)
    if ((low <= shares) & (shares <= high)).any():
        return AT_TIMES
    return ALWAYS if (shares > high).any() else NEVER


def recurs(system, state, cycles: int) -> bool:
    """Return True if the motion from `state` comes back near `state` in the second half of `cycles` cycles.

    RECURRENT defines how near.
    """
    states = simulate(system, state, cycles, sample_times=np.arange(cycles + 1) * system.period).samples
    extent = np.ptp(states, axis=0)
    away = np.abs(states[cycles // 2 :] - states[0]) / np.where(extent > 0, extent, 1.0)
    return bool(away.max(axis=1).min() <= RECURRENT)
