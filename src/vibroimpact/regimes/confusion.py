"""Do names last? The regime of each start against what a run many times as long ends in."""

from collections import Counter

from vibroimpact.exact.engine.simulation import simulate_many
from vibroimpact.regimes.settling import Observation, named, settle


def confusion(system, states, observation: Observation, times: int) -> Counter:
    """How many starts have each (name, name after a run `times` as long as all rounds of the observation)."""
    regimes = settle(system, states, observation)
    longer = times * observation.cycles * observation.rounds
    runs = simulate_many(system, [regime.run.final for regime in regimes], longer)
    return Counter((regime.name, named(run, observation).name) for regime, run in zip(regimes, runs, strict=True))
