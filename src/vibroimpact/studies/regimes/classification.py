"""Recognise regimes that repeat, from displacements and impacts over a window."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vibroimpact.exact.engine.simulation import Run, simulate
from vibroimpact.exact.lanes.ensemble import finals
from vibroimpact.exact.measures.periodicity import mirror_distance, repeats_after
from vibroimpact.exact.periodic import refined
from vibroimpact.system.amplitude import sawtooth_amplitude
from vibroimpact.system.arguments import MOST_SEED, real, whole
from vibroimpact.system.state import IMPACT, idle_at_rest, takes_part

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
_MOST_STARTS = 1_000_000
_SHRUNK, _LONGEST = 1e-6, 10_000
"""A run that approaches a periodic motion is followed until the multipliers shrink its distance by the factor _SHRUNK,
for at most _LONGEST cycles."""
_REPEATED, _MIRRORED = (
    1e-8,
    1e-6,
)  # the first for a periodic motion known to rounding; near symmetry breaking the asymmetry grows like a square root


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

        Its sign distinguishes the mirror images of an asymmetric response.
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
    """Return the regime of a motion with `state` (8,) at the start of a forcing cycle, from a window of cycles.

    Where no displacement changes by more than `nearness` after some number of cycles, Newton's method goes from there
    to the periodic motion itself, if an attracting one is that near and the run approaches it (`_approaches`); the
    window is then on that motion. This distinguishes a slow spiral into a 1:1 response from a modulated motion before
    the spiral ends. A motion that does not repeat is unsettled here (see `settling`).
    """
    run = _window(system, state, window)
    if not _at_rest(run).any():
        repeats = repeats_after(run.samples[:, :4], _PER_CYCLE, nearness)
        orbit = None if repeats is None else _attracting(system, run.final, repeats, reach=10 * nearness)
        motion = None if orbit is None else _window(system, orbit.state, window)
        if motion is None or not _approaches(run, motion, repeats, abs(orbit.multipliers[0])):
            return Regime(run, UNSETTLED, None)
        run = motion
    return Regime(run, *classify(run))


def _attracting(system, state, cycles, reach):
    """Return the attracting motion that repeats after some cycles within `reach` of a state, or None."""
    try:
        orbit = refined(system, state, cycles)
    except ValueError:
        return None
    near = np.abs(orbit.state - idle_at_rest(system, state)).max() < reach
    return orbit if near and abs(orbit.multipliers[0]) < 1 else None


def _approaches(run, motion, repeats, multiplier):
    """Return True if a run has reached an attracting periodic motion, or approaches it from its end on.

    Chaos may repeat within `nearness` next to a motion whose basin is narrower yet. So the run is followed until the
    largest multiplier has shrunk the distance to _SHRUNK of itself: it has to shrink at half of this rate at least.

    motion: a window on the periodic motion, which repeats after `repeats` cycles; it starts where the run ends.
    """
    size = len(run.samples)
    before = _distance(run, motion.samples[(np.arange(size) - size + 1) % (_PER_CYCLE * repeats)])
    if before <= _REPEATED:
        return True
    with np.errstate(divide="ignore"):
        turns = np.clip(np.ceil(np.log(_SHRUNK) / np.log(multiplier)), 1, _LONGEST // repeats)
    later = finals(run.system, run.final[None], int(turns) * repeats)[0]
    after = _distance(_window(run.system, later, run.cycles), motion.samples)
    return after <= max(before * multiplier ** (turns / 2), _REPEATED)


def _distance(run, samples):
    """Return the largest difference of the displacements of a run from others (n, 8) at its samples."""
    return np.abs(run.samples - samples)[:, :4].max()


def classify(run: Run) -> tuple[str, int | None]:
    """Return the name of a settled regime and the number of cycles after which it repeats, or None.

    run: samples every half period, both ends included.

    A ball is idle if it is at rest throughout: one that drifts, however slowly, will meet a wall. With all at rest
    there will be no impacts once the boxes repeat. 1:1 responses repeat every cycle with one impact at each wall of
    each module; their symmetry is that of state to minus state, half a period later. Only modules that take part count.
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
    """Return True for each ball that is at rest at all samples, of the n modules that take part, shape (n,)."""
    return ~run.samples[:, _of_modules(run.system, (5, 7))].any(axis=0)


def _of_modules(system, places):
    """Return those of the given indices of the state that belong to modules that take part."""
    moves = takes_part(system)
    return [place for place in places if moves[place]]


def starts(count: int, seed: int = 1, reach: float = 1.0) -> np.ndarray:
    """Return initial states evenly spread over positions and velocities, the first at rest.

    The others are scrambled Halton points with |X_i|, |X_i'|, |Y_i'| <= reach and |W_i| < 1.

    Parameters
    ----------
    count : int
        Number of initial states, at least 1.
    seed : int, default 1
        Seed of the scrambling.
    reach : float, default 1.0
        Largest displacement and velocity of the boxes, and velocity of the balls, dimensionless.

    Returns
    -------
    ndarray
        Initial states, shape (count, 8).

    Raises
    ------
    ValueError
        If an argument is malformed.

    Examples
    --------
    >>> vi.starts(6, seed=1).shape
    (6, 8)
    """
    from scipy.stats import qmc  # takes a second to load, and is rarely needed

    count, seed, reach = whole("count", count, 1, _MOST_STARTS), whole("seed", seed, 0, MOST_SEED), real("reach", reach)
    unit = 2 * qmc.Halton(8, rng=seed).random(count - 1) - 1
    states = reach * unit
    states[:, [1, 3]] = states[:, [0, 2]] - unit[:, [1, 3]]
    return np.vstack([np.zeros(8), states])


def _two_impacts(run):
    """Return True if each ball meets each wall once a cycle, ignoring an impact at the edge of the window."""
    impacts = run.events[run.events["kind"] == IMPACT]
    counts = [np.sum((impacts["module"] == i) & (impacts["wall"] == w)) for i in run.system.modules for w in (1, -1)]
    return len(impacts) == len(run.events) and bool(np.all(np.abs(np.array(counts) - run.cycles) <= 1))
