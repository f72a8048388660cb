"""Find the regime that each initial state ends in.

A motion is followed in a given number of runs of equal length (rounds), or until it repeats. A motion that does not
repeat is classified, and a longer run tests the classification.
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
    """Settings of the search for the regime of a motion: lengths of runs and a tolerance.

    Parameters
    ----------
    cycles, rounds : int
        Each initial state runs for up to `rounds` times `cycles` forcing periods, until the motion repeats.
    window : int
        Number of forcing periods that are searched for a repetition of the motion, see `classify_after`.
    nearness : float
        Largest difference between the displacements of a motion and of its repetition, see `classify_after`.
    blocks, block : int
        Number of blocks and forcing periods per block for the Lyapunov exponent of a motion that does not repeat.
    retest : int
        Forcing periods of a longer run that tests the classification of a motion that does not repeat.

    Raises
    ------
    ValueError
        If a setting is not a number, or too small.

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

    Motions that cannot be classified after the last round (see `Observation`) are continued for `retest` more cycles
    and classified again.

    The regimes of motions that do not repeat are then tested one after another. To test a regime, one of its motions,
    the witness, runs for `retest` more cycles. If any initial state ends in a periodic motion, up to MOST_WITNESSES
    motions are witnesses, since the motions of the regime may be chaotic transients towards the periodic motion.

    All kinds of chaos count as one regime in this test. If all witnesses stay in the regime, the other motions of the
    regime get the same name as the last witness, which may have changed to another kind of chaos. If any witness leaves
    the regime, the other motions also run for `retest` more cycles. All motions that do not leave the regime are then
    named unsettled.

    Parameters
    ----------
    states
        Initial states (n, 8) at tau = 0; an inactive module is put at rest.
    observation : Observation
        Lengths of the runs.
    progress : bool, default False
        Show on standard error, if it is a terminal, how many initial states are done.
    """
    first = _rounds(system, inactive_at_rest(system, states), observation, progress)
    regimes = list(first)
    for name in (*APERIODIC, IDLE):
        # Chaotic motions are selected by their regimes before all tests, so that no chaotic motion is tested twice.
        now = first if name in CHAOS else regimes
        members = [k for k, regime in enumerate(now) if regime.name == name and regime.repeats is None]
        if members:
            _test_classification(regimes, members, observation, progress)
    return regimes


def _rounds(system, states, observation, progress):
    """Return, for each initial state, the regime of the motion after its last round.

    Motions that do not repeat are classified after the last round. If the classification of a motion fails, the motion
    runs for `retest` more cycles and is classified again.
    """
    found: list[Regime | None] = [None] * len(states)
    waiting, now = np.arange(len(states)), states
    for number in range(1, observation.rounds):
        now = finals(system, now, observation.cycles)
        for place, state in track([*zip(waiting, now, strict=True)], f"initial states, round {number}:", progress):
            found[place] = classify_after(system, state, observation.window, observation.nearness)
        # a motion may still end in another regime if it is unsettled, or if it does not repeat and a ball is idle
        regimes = [found[place] for place in waiting]
        open_ones = [one.name == UNSETTLED or (one.name == IDLE and one.repeats is None) for one in regimes]
        waiting, now = waiting[open_ones], now[open_ones]
    # the last round also keeps the events, which are needed for the classification
    for place, state in track([*zip(waiting, now, strict=True)], "initial states, last round:", progress):
        found[place] = named(simulate(system, state, observation.cycles), observation)
        if found[place].name == UNSETTLED:
            found[place] = _continued(found[place], observation)
    return found


def named(run, observation: Observation) -> Regime:
    """Return the regime at the end of a run, also for a motion that does not repeat."""
    regime = classify_after(run.system, run.final, observation.window, observation.nearness)
    if regime.name == UNSETTLED:
        return replace(regime, name=name_aperiodic(run, observation.blocks, observation.block))
    return regime


def _continued(regime, observation):
    return named(simulate(regime.run.system, regime.run.final, observation.retest), observation)


def _test_classification(regimes, members, observation, progress):
    """Test the regime of the motions with indices `members` by longer runs; update `regimes` in place, see `settle`."""
    before = regimes[members[-1]].name
    coexist = any(regime.name in PERIODIC for regime in regimes)
    witnesses = members[-MOST_WITNESSES if coexist else -1 :]
    _continue(regimes, witnesses, observation, progress)
    if all(_same_kind(before, regimes[k].name) for k in witnesses):
        for k in set(members) - set(witnesses):
            regimes[k] = replace(regimes[k], name=regimes[members[-1]].name)
        return
    _continue(regimes, set(members) - set(witnesses), observation, progress)
    for k in members:
        if _same_kind(before, regimes[k].name):
            regimes[k] = replace(regimes[k], name=UNSETTLED)


def _continue(regimes, places, observation, progress):
    for k in track([*places], f"initial states, longer runs of {observation.retest} cycles:", progress):
        regimes[k] = _continued(regimes[k], observation)


def _same_kind(before, after):
    """Return True if two names of regimes are equal, or if both are in CHAOS."""
    return before == after or (before in CHAOS and after in CHAOS)
