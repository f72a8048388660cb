"""Recognise the regime of a motion that repeats, from displacements and impacts in some forcing cycles (a window)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vibroimpact.exact.engine.simulation import Run, simulate
from vibroimpact.exact.lanes.ensemble import finals
from vibroimpact.exact.measures.periodicity import mirror_distance, repeats_after
from vibroimpact.exact.periodic import refined
from vibroimpact.system.amplitude import sawtooth_amplitude
from vibroimpact.system.arguments import MOST_SEED, real, whole
from vibroimpact.system.state import IMPACT, active_mask, inactive_at_rest

SYMMETRIC, ASYMMETRIC, OTHER = "symmetric", "asymmetric", "other periodic"
STRONGLY_MODULATED, CHAOTIC, HOPPING = "strongly modulated", "chaotic", "hopping"
QUASI_PERIODIC, IDLE, NO_IMPACTS = "quasi-periodic", "one ball idle", "no impacts"
UNSETTLED = "unsettled"
PERIODIC = (SYMMETRIC, ASYMMETRIC, OTHER)
CHAOS = (STRONGLY_MODULATED, CHAOTIC, HOPPING)
APERIODIC = (*CHAOS, QUASI_PERIODIC)
REGIMES = (*PERIODIC, *APERIODIC, IDLE, NO_IMPACTS, UNSETTLED)
"""Names of all regimes; docs/studies/regimes.md states the test for each."""

_PER_CYCLE = 2
_MOST_STARTS = 1_000_000
_SHRUNK, _LONGEST = 1e-6, 10_000
"""A run near a periodic motion is continued until, as the largest multiplier predicts, its distance from this motion
has shrunk by the factor _SHRUNK, but for at most _LONGEST cycles."""
_REPEATED, _MIRRORED = 1e-8, 1e-6
"""Tolerances for the repetition and for the symmetry of a periodic motion that is known to rounding. The tolerance for
the symmetry is larger, since beyond symmetry breaking the asymmetry grows like the square root of the change of a
parameter."""


@dataclass(frozen=True, eq=False)
class Regime:
    """A motion that is observed over some whole forcing cycles (a window), and its regime.

    run: the simulated motion in the window, with samples every half period.
    name: name of the regime, one of REGIMES.
    repeats: number of cycles after which the motion repeats, or None if the motion does not repeat.
    """

    run: Run
    name: str
    repeats: int | None

    @cached_property
    def impacts(self) -> np.ndarray:
        """Impacts in the observed window, as an array of events."""
        return self.run.events[self.run.events["kind"] == IMPACT]

    @property
    def mean_amplitudes(self) -> np.ndarray:
        """Mean saw-tooth amplitude C_i of each ball, shape (2,).

        A saw-tooth motion of amplitude C_i covers as much distance per cycle as ball i covers on average.
        """
        run, paths = self.run, []
        for module, ball in ((1, 1), (2, 3)):
            turns = run.events[run.events["module"] == module]["state"][:, ball]
            paths.append(np.abs(np.diff([run.samples[0, ball], *turns, run.final[ball]])).sum())
        return sawtooth_amplitude(run.system.epsilon, np.array(paths) / (2 * run.cycles))

    @property
    def flight_asymmetry(self) -> float:
        """Flight asymmetry, summed over both balls.

        The flight asymmetry of a ball is the share of time in its flights from wall -1, minus the share of time in its
        flights from wall +1.
        """
        total = 0.0
        for module in (1, 2):
            mine = self.impacts[self.impacts["module"] == module]
            flights, walls = np.diff(mine["tau"]), mine["wall"][:-1]
            total -= np.sum(flights * walls) / (self.run.cycles * self.run.system.period)
        return float(total)


def classify_after(system, state, window: int, nearness: float) -> Regime:
    """Return the regime of the motion from `state`, shape (8,), over `window` forcing cycles.

    If the motion approaches a periodic motion, the periodic motion is classified instead. Therefore a motion that
    slowly spirals into a 1:1 response is not taken for a modulated motion. If the motion approaches no periodic motion,
    the regime is UNSETTLED. If a ball is idle (always at rest), the motion itself is classified.

    nearness: a motion repeats if its displacements after some cycles differ by at most this value.
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
    """Return an attracting periodic motion near `state`, or None if there is none.

    The motion repeats after `cycles` cycles. Its initial state differs from `state` by less than `reach`.
    """
    try:
        orbit = refined(system, state, cycles)
    except ValueError:
        return None
    near = np.abs(orbit.state - inactive_at_rest(system, state)).max() < reach
    return orbit if near and abs(orbit.multipliers[0]) < 1 else None


def _approaches(run, motion, repeats, multiplier):
    """Return True if a run has reached an attracting periodic motion, or approaches this motion.

    A chaotic run can stay close to a periodic motion for some cycles without being in the basin of this motion.
    Therefore the run is continued. Its distance from the periodic motion must shrink at half of the exponential rate
    that the largest multiplier predicts, or faster.

    motion: a run along the periodic motion, which starts near the final state of `run`.
    repeats: number of cycles after which the periodic motion repeats.
    multiplier: modulus of the largest multiplier of the periodic motion.
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
    """Return the largest difference between the displacements of a run and those in `samples`, shape (n, 8).

    Row k of `samples` is compared with sample k of the run.
    """
    return np.abs(run.samples - samples)[:, :4].max()


def classify(run: Run) -> tuple[str, int | None]:
    """Return the regime of a settled motion, and the number of cycles after which the motion repeats.

    If the motion does not repeat, the number is None.

    run: a run along the motion, with samples every half period.

    A ball is idle if it is at rest in all samples. A ball that drifts slowly is not idle, since it will hit a wall. A
    1:1 response repeats every cycle, with one impact at each wall of each module. A 1:1 response is symmetric if all
    displacements change sign after half a period.
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
    impacts = run.events[run.events["kind"] == IMPACT]
    counts = [np.sum((impacts["module"] == i) & (impacts["wall"] == w)) for i in run.system.modules for w in (1, -1)]
    # If an impact is at an end of the run, the number of impacts at a wall can differ from the number of cycles by one.
    once = len(impacts) == len(run.events) and np.all(np.abs(np.array(counts) - run.cycles) <= 1)
    if repeats > 1 or not once:
        return OTHER, repeats
    mirrored = mirror_distance(displacements, _PER_CYCLE) <= _MIRRORED
    return (SYMMETRIC if mirrored else ASYMMETRIC), repeats


def _window(system, state, cycles):
    times = np.arange(_PER_CYCLE * cycles + 1) * (system.period / _PER_CYCLE)
    return simulate(system, state, cycles, sample_times=times)


def _at_rest(run):
    """Return a mask of the balls that are at rest in all samples of a run, shape (n,) for n active modules."""
    speeds = np.array([5, 7])
    return ~run.samples[:, speeds[active_mask(run.system)[speeds]]].any(axis=0)


def starts(count: int, seed: int = 1, reach: float = 1.0) -> np.ndarray:
    """Return initial states that are evenly spread over positions and velocities; only the first one is at rest.

    Parameters
    ----------
    count : int
        Number of initial states, at least 1.
    seed : int, default 1
        Seed of the scrambled Halton points that give the initial states.
    reach : float, default 1.0
        Upper bound of |X_i|, |X_i'| and |Y_i'|, dimensionless.

    Returns
    -------
    ndarray
        Initial states, shape (count, 8). Every ball starts between its walls, |W_i| < 1.

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
    states[:, [1, 3]] = states[:, [0, 2]] - unit[:, [1, 3]]  # Y_i = X_i - W_i
    return np.vstack([np.zeros(8), states])
