"""Names of regimes, and the recognition of those that repeat, from displacements and impacts over a window."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vibroimpact.exact.engine.simulation import Run, simulate
from vibroimpact.exact.measures.periodicity import mirror_distance, repeats_after
from vibroimpact.system.amplitude import sawtooth_amplitude
from vibroimpact.system.state import IMPACT

SYMMETRIC, ASYMMETRIC, OTHER = "symmetric", "asymmetric", "other periodic"
STRONGLY_MODULATED, CHAOTIC, HOPPING = "strongly modulated", "chaotic", "hopping"
QUASI_PERIODIC, IDLE, NO_IMPACTS = "quasi-periodic", "one ball idle", "no impacts"
UNSETTLED = "unsettled"
PERIODIC = (SYMMETRIC, ASYMMETRIC, OTHER)
CHAOS = (STRONGLY_MODULATED, CHAOTIC, HOPPING)
APERIODIC = (*CHAOS, QUASI_PERIODIC)
REGIMES = (*PERIODIC, *APERIODIC, IDLE, NO_IMPACTS, UNSETTLED)
"""All names; docs/studies/regimes.md states the test of each."""

_PER_CYCLE = 2
_NEWTON, _SETTLED = 12, 1e-11
_REPEATED, _MIRRORED = 1e-8, 1e-6  # on a periodic motion known to rounding; mirror images part with a square root


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
        """C_i of half of each ball's mean path per cycle, shape (2,): on a 1:1 response that of its saw-tooth."""
        path = np.array([self._path(ball) for ball in (1, 3)])
        return sawtooth_amplitude(self.run.system.epsilon, path / (2 * self.run.cycles))

    @property
    def flight_asymmetry(self) -> float:
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


def classify_after(system, state, window: int, nearness: float) -> Regime:
    """The regime of a motion with `state` (8,) at the start of a forcing cycle, from a window of cycles.

    Where no displacement changes by more than `nearness` after some number of cycles, Newton's method goes from there
    to the periodic motion itself, if an attracting one is that near; the window is then on that motion. This tells a
    slow spiral into a 1:1 response from a modulated motion long before the spiral ends. What does not repeat is called
    unsettled here (see `settling`).
    """
    run = _window(system, state, window)
    if not _at_rest(run).any():
        repeats = repeats_after(run.samples[:, :4], _PER_CYCLE, nearness)
        cycle = None if repeats is None else attracting_cycle(system, run.final, repeats, reach=10 * nearness)
        if cycle is None:
            return Regime(run, UNSETTLED, None)
        run = _window(system, cycle, window)
    return Regime(run, *classify(run))


def attracting_cycle(system, state, cycles: int, reach: float) -> np.ndarray | None:
    """State (8,) on the attracting periodic motion of a number of cycles that Newton's method finds near a state.

    None if there is none within `reach`, or one with a multiplier on or outside the unit circle.
    """
    x = np.array(state)
    for _ in range(_NEWTON):
        if max(abs(x[0] - x[1]), abs(x[2] - x[3])) > 1:
            return None
        run = simulate(system, x, cycles)
        jacobian = run.jacobian
        try:
            step = np.linalg.solve(np.eye(8) - jacobian, run.final - x)
        except np.linalg.LinAlgError:
            return None
        x = x + step
        if not np.abs(x - state).max() < reach:
            return None
        if np.abs(step).max() < _SETTLED:
            return x if np.abs(np.linalg.eigvals(jacobian)).max() < 1 else None
    return None


def classify(run: Run) -> tuple[str, int | None]:
    """Name of a settled regime and number of cycles after which it repeats (None: it does not), from a window.

    run: samples every half period, both ends included.

    A ball is idle if it is at rest throughout: one that drifts, however slowly, will meet a wall. With both at rest
    there will be no impacts once the boxes repeat. 1:1 responses repeat every cycle with one impact at each wall of
    each module; their symmetry is that of state to minus state, half a period later.
    """
    displacements = run.samples[:, :4]
    repeats = repeats_after(displacements, _PER_CYCLE, _REPEATED)
    at_rest = _at_rest(run)
    if at_rest.all():
        return (UNSETTLED if repeats is None else NO_IMPACTS), repeats
    if at_rest.any():
        return IDLE, repeats
    if repeats is None:
        return UNSETTLED, None
    if repeats > 1 or not _two_impacts(run):
        return OTHER, repeats
    mirrored = mirror_distance(displacements, _PER_CYCLE) <= _MIRRORED
    return (SYMMETRIC if mirrored else ASYMMETRIC), repeats


def _window(system, state, cycles):
    times = np.arange(_PER_CYCLE * cycles + 1) * (system.period / _PER_CYCLE)
    return simulate(system, state, cycles, sample_times=times)


def _at_rest(run):
    """True for each ball that is at rest at all samples, shape (2,)."""
    return ~run.samples[:, [5, 7]].any(axis=0)


def starts(count: int, seed: int, reach: float = 1.0) -> np.ndarray:
    """Starts spread evenly over displacements, relative displacements and velocities, and the start from rest.

    Shape (count, 8): rest first, then scrambled Halton points with |X_i|, |X_i'|, |Y_i'| <= reach, |W_i| < 1.
    """
    from scipy.stats import qmc  # takes a second to load, and few who classify draw starts

    unit = 2 * qmc.Halton(8, rng=seed).random(count - 1) - 1
    states = reach * unit
    states[:, [1, 3]] = states[:, [0, 2]] - unit[:, [1, 3]]
    return np.vstack([np.zeros(8), states])


def _two_impacts(run):
    """True if each ball meets each wall once a cycle, but for an impact on the edge of the window."""
    impacts = run.events[run.events["kind"] == IMPACT]
    counts = [np.sum((impacts["module"] == i) & (impacts["wall"] == w)) for i in (1, 2) for w in (1, -1)]
    return len(impacts) == len(run.events) and bool(np.all(np.abs(np.array(counts) - run.cycles) <= 1))
