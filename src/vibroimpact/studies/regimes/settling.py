"""Find the regime that each start ends in.

A motion is followed in rounds until it repeats; one that does not is named, and longer runs test the name.
"""

from dataclasses import dataclass, replace

import numpy as np

from vibroimpact.exact.engine.ensemble import finals
from vibroimpact.exact.engine.simulation import MOST_CYCLES, simulate
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
from vibroimpact.system.arguments import real, whole
from vibroimpact.system.progress import track
from vibroimpact.system.state import idle_at_rest

MOST_WITNESSES = 5


@dataclass(frozen=True)
class Observation:
    """Settings of an observation: lengths of runs, in cycles, and tolerance.

    cycles, rounds: a start is given so many cycles, up to so many times, until it repeats. window, nearness: as in
    `classify_after`. blocks, block: of the Lyapunov exponent of what does not repeat, so many blocks of so many cycles.
    retest: cycles over which such a name is tried.

    Raises
    ------
    ValueError
        If one of them is not a number, or below the least with a meaning.
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
        if real("nearness", self.nearness) <= 0:
            raise ValueError(f"nearness: {self.nearness} is not above 0")


def settle(system, states, observation: Observation, progress: bool = False) -> list[Regime]:
    """Return the regime that each start ends in, one per start, in their order.

    A name for a motion that does not repeat has to last: of the starts with this name one, the witness, runs on for
    `retest` cycles; up to MOST_WITNESSES do where another start has become periodic, so that chaos may be a transient.
    If all witnesses stay with a name of this kind, all starts bear the name of a longer run. If one ends elsewhere, so
    may the others: each runs on as long, and is unsettled if it has ended nowhere by then. Unsettled ones run on, too.

    Parameters
    ----------
    states
        (n, 8) starts at tau = 0; a module that takes no part is put at rest.
    observation : Observation
        How long they are looked at.
    progress : bool, default False
        Count them on standard error, if that is a terminal.
    """
    first = _rounds(system, idle_at_rest(system, states), observation, progress)
    regimes = list(first)
    for name in (*APERIODIC, IDLE):
        now = first if name in CHAOS else regimes  # with what chaos has turned into since
        members = [k for k, regime in enumerate(now) if regime.name == name and regime.repeats is None]
        if members:
            _try(system, regimes, members, observation, progress)
    return regimes


def _rounds(system, states, observation, progress):
    """Return the regimes after the rounds; those that do not repeat are named, and run on if that fails."""
    found: list[Regime | None] = [None] * len(states)
    waiting, now = np.arange(len(states)), states
    for number in range(1, observation.rounds):
        now = finals(system, now, observation.cycles)
        for place, state in track([*zip(waiting, now, strict=True)], f"starts: round {number},", progress):
            found[place] = classify_after(system, state, observation.window, observation.nearness)
        passing = [_passing(found[place]) for place in waiting]
        waiting, now = waiting[passing], now[passing]
    # the last round, with the events that a name needs
    for place, state in track([*zip(waiting, now, strict=True)], "starts: last round,", progress):
        found[place] = named(simulate(system, state, observation.cycles), observation)
        if found[place].name == UNSETTLED:
            found[place] = _later(system, found[place], observation)
    return found


def named(run, observation: Observation) -> Regime:
    """Return the regime at the end of a run, with a name for one that does not repeat."""
    regime = classify_after(run.system, run.final, observation.window, observation.nearness)
    if regime.name == UNSETTLED:
        return replace(regime, name=name_aperiodic(run, observation.blocks, observation.block))
    return regime


def _passing(regime):
    """Return True if a longer run may end in another regime."""
    return regime.name == UNSETTLED or (regime.name == IDLE and regime.repeats is None)


def _later(system, regime, observation):
    return named(simulate(system, regime.run.final, observation.retest), observation)


def _try(system, regimes, members, observation, progress):
    """Rename, in place, the members of one name by the ends of their witnesses."""
    before = regimes[members[-1]].name
    coexist = any(regime.name in PERIODIC for regime in regimes)
    witnesses = members[-MOST_WITNESSES if coexist else -1 :]
    _run_on(system, regimes, witnesses, observation, progress)
    if all(_same_kind(before, regimes[k].name) for k in witnesses):
        for k in set(members) - set(witnesses):
            regimes[k] = replace(regimes[k], name=regimes[members[-1]].name)
        return
    _run_on(system, regimes, set(members) - set(witnesses), observation, progress)
    for k in members:
        if _same_kind(before, regimes[k].name):
            regimes[k] = replace(regimes[k], name=UNSETTLED)


def _run_on(system, regimes, places, observation, progress):
    for k in track([*places], f"starts: longer run, {observation.retest} cycles,", progress):
        regimes[k] = _later(system, regimes[k], observation)


def _same_kind(before, after):
    """Return True if a motion has kept its kind: chaos may turn out to be in resonance more or less often."""
    return before == after or (before in CHAOS and after in CHAOS)
