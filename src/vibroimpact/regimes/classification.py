"""Which regime a start ends in: a simulation until it repeats, and a label read off its displacements and impacts."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.stats import qmc

from vibroimpact.exact.simulation import IMPACT, Run, simulate, simulate_many
from vibroimpact.regimes.periodicity import mirror_distance, repeats_after

SYMMETRIC, ASYMMETRIC, MODULATED = "symmetric", "asymmetric", "modulated"
IDLE, NO_IMPACTS, OTHER = "one ball idle", "no impacts", "other periodic"
REGIMES = (SYMMETRIC, ASYMMETRIC, OTHER, MODULATED, IDLE, NO_IMPACTS)

_PER_CYCLE = 2
_MIRRORED = 10.0  # times the tolerance of a repetition: what still counts as its own mirror image


@dataclass(frozen=True, eq=False)
class Regime:
    """A motion observed over a window of whole cycles.

    run: the window, with samples every half period. name: one of REGIMES. repeats: cycles after which it repeats, or
    None.
    """

    run: Run
    name: str
    repeats: int | None

    @cached_property
    def impacts(self) -> np.ndarray:
        """The impacts of the window."""
        return self.run.events[self.run.events["kind"] == IMPACT]

    @property
    def mean_amplitudes(self) -> np.ndarray:
        """A quarter of each ball's path per cycle, shape (2,): on a symmetric 1:1 response C_i."""
        return np.array([self._path(ball) for ball in (1, 3)]) / (4 * self.run.cycles)

    @property
    def lean(self) -> float:
        """Difference of the mean times that the balls fly from wall +1 and from wall -1, over the period, summed.

        It tells mirror images of an asymmetric response apart.
        """
        total = 0.0
        for module in (1, 2):
            mine = self.impacts[self.impacts["module"] == module]
            flights, walls = np.diff(mine["tau"]), mine["wall"][:-1]
            total += np.sum(flights * walls) / (self.run.cycles * self.run.system.period)
        return float(total)

    def _path(self, ball):
        run = self.run
        turns = run.events[run.events["module"] == (ball + 1) // 2]["state"][:, ball]
        return np.abs(np.diff([run.samples[0, ball], *turns, run.final[ball]])).sum()


def settle(system, states, cycles: int, rounds: int, window: int, tolerance: float) -> list[Regime]:
    """The regime that each start ends in.

    Every start is simulated for so many cycles, then observed over a window; those that do not repeat are given as
    many cycles again, up to so many rounds. What still does not repeat is called modulated: quasi-periodic, chaotic, or
    of a period above half the window. A response whose largest multiplier is so near the unit circle that
    |mu|^(cycles rounds) is above the tolerance is taken for modulated as well.

    Args:
        states: (n, 8) starts at tau = 0.
        tolerance: largest change of a displacement in a motion that repeats.

    Returns one Regime per start, in their order.
    """
    found: list[Regime | None] = [None] * len(states)
    waiting, now = list(range(len(states))), np.array(states, dtype=float)
    for _ in range(rounds):
        now = np.array([run.final for run in simulate_many(system, now, cycles)])
        regimes = [observe(system, state, window, tolerance) for state in now]
        for place, regime in zip(waiting, regimes, strict=True):
            found[place] = regime
        again = [k for k, regime in enumerate(regimes) if regime.name == MODULATED]
        if not again:
            break
        waiting, now = [waiting[k] for k in again], now[again]
    return found


def observe(system, state, window: int, tolerance: float) -> Regime:
    """The regime of a settled motion with `state` (8,) at the start of a forcing cycle, over a window of cycles."""
    times = np.arange(_PER_CYCLE * window + 1) * (system.period / _PER_CYCLE)
    run = simulate(system, state, window, sample_times=times)
    name, repeats = classify(run, tolerance)
    return Regime(run, name, repeats)


def classify(run: Run, tolerance: float) -> tuple[str, int | None]:
    """Name of the regime and number of cycles after which it repeats (None: it does not), from a window.

    run: samples every half period, both ends included.

    A module is idle if nothing happens to its ball in the window. 1:1 responses repeat every cycle with one impact at
    each wall of each module; their symmetry is that of state to minus state, half a period later.
    """
    active = {module: (run.events["module"] == module).any() for module in (1, 2)}
    displacements = run.samples[:, :4]
    repeats = repeats_after(displacements, _PER_CYCLE, tolerance)
    if not any(active.values()):
        return NO_IMPACTS, repeats
    if not all(active.values()):
        return IDLE, repeats
    if repeats is None:
        return MODULATED, None
    if repeats > 1 or not _two_impacts(run):
        return OTHER, repeats
    mirrored = mirror_distance(displacements, _PER_CYCLE) <= _MIRRORED * tolerance
    return (SYMMETRIC if mirrored else ASYMMETRIC), repeats


def starts(count: int, seed: int, reach: float = 1.0) -> np.ndarray:
    """Starts spread evenly over displacements, relative displacements and velocities, and the start from rest.

    Shape (count, 8): rest first, then scrambled Halton points with |X_i|, |X_i'|, |Y_i'| <= reach, |W_i| < 1.
    """
    unit = 2 * qmc.Halton(8, rng=seed).random(count - 1) - 1
    states = reach * unit
    states[:, [1, 3]] = states[:, [0, 2]] - unit[:, [1, 3]]
    return np.vstack([np.zeros(8), states])


def _two_impacts(run):
    """Whether each ball meets each wall once a cycle, but for an impact on the edge of the window."""
    impacts = run.events[run.events["kind"] == IMPACT]
    counts = [np.sum((impacts["module"] == i) & (impacts["wall"] == w)) for i in (1, 2) for w in (1, -1)]
    return len(impacts) == len(run.events) and bool(np.all(np.abs(np.array(counts) - run.cycles) <= 1))
