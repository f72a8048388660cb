"""Find the regime that each initial state ends in.

A motion is simulated in runs of equal length (rounds) until it repeats. If the motion has not repeated by the end of
the last round, quantities such as the Lyapunov exponent determine its regime. A longer run then tests this regime.
"""

from dataclasses import dataclass, replace

import numpy as np

from vibroimpact.exact.engine.simulation import MOST_CYCLES, simulate
from vibroimpact.exact.lanes.ensemble import finals
from vibroimpact.studies.regimes.aperiodic import name_aperiodic
from vibroimpact.studies.regimes.classification import (
    APERIODIC,
    CHAOS,
    IDLE,
    PERIODIC,
    UNSETTLED,
    Regime,
    classify_after,
)
from vibroimpact.system.arguments import positive, whole
from vibroimpact.system.progress import track
from vibroimpact.system.state import inactive_at_rest

MOST_WITNESSES = 5


@dataclass(frozen=True)
class Observation:
    """Settings that control the search for the regime of a motion.

    Parameters
    ----------
    cycles, rounds : int, default 250 and 3
        Number of forcing periods in a round (one run), and largest number of successive rounds for each initial state.
        As soon as the motion repeats, no further round follows.
    window : int, default 24
        Number of forcing periods that are simulated after each round to find a repetition of the motion.
    nearness : float, default 0.02
        Largest dimensionless change of a displacement in a repetition. A motion repeats if all displacements change by
        at most this number over a whole number of forcing periods.
    blocks, block : int, default 6 and 20
        Number of blocks from which the Lyapunov exponent is estimated, and number of forcing periods per block.
    retest : int, default 10000
        Number of forcing periods of the longer run that tests the regime of a motion that does not repeat.

    Raises
    ------
    ValueError
        If a setting is not a number or is out of range.

    Examples
    --------
    >>> observation = vi.Observation(cycles=400, rounds=5)
    """

    cycles: int = 250
    rounds: int = 3
    window: int = 24
    nearness: float = 0.02
    blocks: int = 6
    block: int = 20
    retest: int = 10_000

    def __post_init__(self):
        for name, least in {"cycles": 1, "rounds": 1, "window": 4, "blocks": 2, "block": 1, "retest": 1}.items():
            whole(name, getattr(self, name), least, MOST_CYCLES)
        positive("nearness", self.nearness)


def settle(system, states, observation: Observation, progress: bool = False) -> list[Regime]:
    """Return the regime in which the motion from each initial state ends, in the order of `states`.

    states: initial states, shape (n, 8). An inactive module is put at rest.

    If a motion does not repeat, its regime is tested by longer runs. One motion of each such regime is continued, or up
    to five if other motions are periodic. If one of them leaves the regime, all motions of the regime are continued,
    and those that stay in the regime are called unsettled.
    """
    first = _rounds(system, inactive_at_rest(system, states), observation, progress)
    regimes = list(first)
    for name in (*APERIODIC, IDLE):
        # A test can replace one chaotic regime of a motion by another. So that no motion is tested twice, chaotic
        # motions are selected by the regimes that they had before the first test.
        now = first if name in CHAOS else regimes
        members = [k for k, regime in enumerate(now) if regime.name == name and regime.repeats is None]
        if members:
            _test_classification(regimes, members, observation, progress)
    return regimes


def _rounds(system, states, observation, progress):
    """Return the regime of the motion from each state.

    A motion runs in rounds of equal length until it repeats, or until the last round.
    """
    found: list[Regime | None] = [None] * len(states)
    waiting, now = np.arange(len(states)), states
    for number in range(1, observation.rounds):
        now = finals(system, now, observation.cycles)
        for place, state in track([*zip(waiting, now, strict=True)], f"initial states, round {number}:", progress):
            found[place] = classify_after(system, state, observation.window, observation.nearness)
        # Motions continue if they are unsettled, or if a ball is idle and the motion does not repeat.
        regimes = [found[place] for place in waiting]
        open_ones = [one.name == UNSETTLED or (one.name == IDLE and one.repeats is None) for one in regimes]
        waiting, now = waiting[open_ones], now[open_ones]
    # The runs of the last round also keep their events, which are needed for the classification.
    for place, state in track([*zip(waiting, now, strict=True)], "initial states, last round:", progress):
        found[place] = named(simulate(system, state, observation.cycles), observation)
        if found[place].name == UNSETTLED:
            found[place] = _continued(found[place], observation)
    return found


def named(run, observation: Observation) -> Regime:
    """Return the regime at the end of a run.

    If the motion does not repeat, `name_aperiodic` determines the regime.
    """
    regime = classify_after(run.system, run.final, observation.window, observation.nearness)
    if regime.name == UNSETTLED:
        return replace(regime, name=name_aperiodic(run, observation.blocks, observation.block))
    return regime


def _continued(regime, observation):
    return named(simulate(regime.run.system, regime.run.final, observation.retest), observation)


def _test_classification(regimes, members, observation, progress):
    """Test one regime by longer runs: do its motions stay in the regime? Update `regimes` in place.

    regimes: regime of each motion.
    members: indices of the motions that are in the tested regime.
    """
    before = regimes[members[-1]].name
    # Some motions of the regime, called witnesses, are continued in longer runs. If other motions are periodic, the
    # motions of the regime may be chaotic transients. Then several witnesses are needed, otherwise one.
    coexist = any(regime.name in PERIODIC for regime in regimes)
    witnesses = members[-MOST_WITNESSES if coexist else -1 :]
    _continue(regimes, witnesses, observation, progress)
    # If all witnesses stay in the regime, the other motions of the regime are not continued. They get the
    # regime that the longer run of the last witness has, which may be another chaotic regime.
    if all(_same_kind(before, regimes[k].name) for k in witnesses):
        for k in set(members) - set(witnesses):
            regimes[k] = replace(regimes[k], name=regimes[members[-1]].name)
        return
    _continue(regimes, set(members) - set(witnesses), observation, progress)
    # A witness has left the regime. Therefore motions that stay in the regime may still leave it later, and they are
    # called unsettled.
    for k in members:
        if _same_kind(before, regimes[k].name):
            regimes[k] = replace(regimes[k], name=UNSETTLED)


def _continue(regimes, places, observation, progress):
    for k in track([*places], f"initial states, longer runs of {observation.retest} cycles:", progress):
        regimes[k] = _continued(regimes[k], observation)


def _same_kind(before, after):
    """Return True if two names of regimes are equal, or if both are in CHAOS."""
    return before == after or (before in CHAOS and after in CHAOS)
