"""Find periodic motions of any period and any sequence of events, by Newton's method on the stroboscopic map.

The map assigns to the state at a time tau the state after a given number of forcing periods. The map is discontinuous
if an event happens exactly at tau. Therefore tau is chosen in the middle of the longest interval without events.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact.exact.engine.simulation import MOST_CYCLES, Run, checked_state, simulate, within_walls
from vibroimpact.exact.lanes.ensemble import ensemble
from vibroimpact.exact.orbits.floquet import active_part, by_multipliers, multipliers
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, whole
from vibroimpact.system.representation import Representation, brief
from vibroimpact.system.state import BALLS, IMPACT, MODULES, active_mask, inactive_at_rest
from vibroimpact.system.verdict import STABLE, UNDECIDED

SAME = 1e-6
"""Largest difference between states that count as equal; near a bifurcation, errors are about sqrt(rounding)."""
_STEPS, _HALVINGS, _REACH = 40, 12, 0.5
# A ball is neutral if the change of its velocity over a run does not depend on the initial state. In the matrix
# D = run.jacobian - identity, the row of its velocity is then zero. A row counts as zero if no entry exceeds
# _NEUTRAL * max(1, m) in modulus. Here m is the largest modulus of all entries of D.
_NEUTRAL = 1e-10
_BALL_VELOCITIES = np.isin(np.arange(8), BALLS[2:])
_SETTLED = 1e-13
_CONVERGED = ((1e-5, 1e-8), (1e-12, 1e-6))
"""Largest steps and `_gap` that are accepted if Newton's method stalls: the first pair at a fold, the second pair if
the motion amplifies rounding errors."""
_TOUCH = 1e-9


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicOrbit(Representation):
    """A periodic motion with any number of impacts, in dimensionless quantities.

    Attributes
    ----------
    system : System
        Dimensionless parameters.
    periods : int
        Number of forcing periods after which the motion repeats.
    state : ndarray
        State at tau = 0, shape (8,). If an event happens at this time, it is the state just after the event.
    run : Run
        Run over one period of the motion. The run starts between two events.

    Examples
    --------
    >>> vi.periodic_orbit(system, vi.simulate(system, state, 500).final).stability
    'stable'
    """

    system: System
    periods: int
    state: np.ndarray
    run: Run

    @property
    def period(self) -> float:
        """Period of the motion in units of tau."""
        return self.periods * self.system.period

    @cached_property
    def multipliers(self) -> np.ndarray:
        """Complex Floquet multipliers over one period of the motion, in descending modulus.

        The shape is (8,), or (4,) if only one module is active.
        """
        return multipliers(active_part(self.system, self.run.jacobian))

    @property
    def stability(self) -> str:
        """Stability: "stable", "unstable" or "undecided".

        The motion is unstable if a multiplier is outside the unit circle by more than its error. Otherwise it is
        undecided if a multiplier is on the unit circle within its error, or if a ball hits no wall.
        """
        part = _determined(self.run)
        states, rows = self._impacts["state"], np.arange(len(self._impacts))
        boxes = 2 * self._impacts["module"] + 2
        slowest = np.abs(states[rows, boxes] - states[rows, boxes + 1]).min(initial=1.0)  # relative speed after impacts
        verdict = by_multipliers(self.run.jacobian[part][:, part], self.residual, slowest)
        return UNDECIDED if verdict == STABLE and len(self.multipliers) > part.sum() else verdict

    @property
    def impacts(self) -> np.ndarray:
        """Number of impacts per period of the motion, shape (2, 2), with the indices [module, wall +1 / wall -1].

        In a chatter (impacts at one wall in ever shorter flights), only the first impacts are simulated and counted.
        """
        events = self._impacts
        return np.array([[np.sum((events["module"] == i) & (events["wall"] == w)) for w in (1, -1)] for i in (1, 2)])

    @cached_property
    def symmetric(self) -> bool:
        """True if the state is multiplied by -1 after half of `period`; always False if `periods` is even."""
        half = _state_at(self.run, self.run.tau0 + self.period / 2)
        return self.periods % 2 == 1 and bool(np.abs(half + self.run.start).max() <= SAME)

    @property
    def residual(self) -> float:
        """Largest change of a component of the state over one period of the motion."""
        return _gap(self.run)

    @cached_property
    def amplitudes(self) -> np.ndarray:
        """Largest displacement |X_i| of each box, shape (2,); NaN for an inactive module (`System.modules`)."""
        largest = ensemble(self.system, self.state, self.periods)["largest"]
        return np.where(active_mask(self.system)[[0, 2]], largest, np.nan)

    @property
    def _impacts(self):
        return self.run.events[self.run.events["kind"] == IMPACT]

    def _shown(self):
        return {
            "periods": str(self.periods),
            "impacts": str(self.impacts.tolist()),
            "symmetric": str(self.symmetric),
            "stability": self.stability + (" (grazing)" if _grazes(self.run) else ""),
            "multipliers": f"moduli up to {brief(abs(self.multipliers[0]))}",
            "amplitudes": brief(self.amplitudes),
        }


def periodic_orbit(system: System, state: ArrayLike, periods: int = 1) -> PeriodicOrbit:
    """Find a periodic motion near a given state.

    The motion may have any period and any impacts, also with chatter or sticking. Newton's method also finds unstable
    motions. If the state is far from a motion, the method may miss the nearest motion.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    state : array_like
        State at tau = 0, shape (8,), such as the end of a settled run. An inactive module (`System.modules`) is put at
        rest.
    periods : int, default 1
        Smallest number of forcing periods after which the motion repeats.

    Returns
    -------
    PeriodicOrbit
        The motion, with .state, .period, .multipliers, .stability, .impacts, .symmetric, .amplitudes and .residual.

    Raises
    ------
    ValueError
        If an argument is malformed, if Newton's method does not converge, or if the motion repeats after fewer periods.
    ArithmeticError
        If a run could not be finished.

    Examples
    --------
    >>> settled = vi.simulate(system, state, 500).final
    >>> vi.periodic_orbit(system, settled).impacts.tolist()
    [[1, 1], [1, 1]]
    """
    instance("system", system, System)
    state, periods = checked_state(state), whole("periods", periods, 1, MOST_CYCLES)
    orbit = refined(system, state, periods)
    start, begin = orbit.run.start.copy(), orbit.run.tau0
    for fewer in (n for n in range(1, periods // 2 + 1) if periods % n == 0):
        if np.abs(simulate(system, start, fewer, begin).final - start).max() <= SAME:
            raise ValueError(f"periods: got {periods}, but the motion already repeats after {fewer}")
    return orbit


def refined(system, state, periods) -> PeriodicOrbit:
    """Return the motion near `state` that repeats after `periods` forcing periods.

    The motion may also repeat after fewer forcing periods. state: state at tau = 0, shape (8,). Raise ValueError if
    Newton's method does not converge. Raise ArithmeticError if a run cannot be finished.
    """
    run = given = simulate(system, inactive_at_rest(system, state), periods)
    edges = np.array([run.tau0, *run.events["tau"], float(run.end)])
    longest = np.diff(edges).argmax()
    begin = float(edges[longest : longest + 2].mean())  # the middle of the longest interval without events
    run = _with_free_balls_at_rest(system, _state_at(run, begin), periods, begin)
    for _ in range(_STEPS):
        part, step = _determined(run), np.zeros(8)
        restoring = (np.eye(8) - run.jacobian)[part][:, part]
        step[part] = np.linalg.lstsq(restoring, (run.final - run.start)[part])[0]
        size = np.abs(step).max() / (1 + np.abs(run.start).max())
        nearer = _nearer(run, step * min(1.0, _REACH / size)) if size > _SETTLED else None
        if nearer is None:
            break
        run = nearer
    if any(size <= least and _gap(run) <= closed for least, closed in _CONVERGED):
        # The run starts after tau = 0. Therefore the state at tau = 0 is read one period of the motion later.
        tau = run.cycles * system.period
        at_zero = run.events["state"][np.abs(run.events["tau"] - tau) < _TOUCH]
        return PeriodicOrbit(system, periods, at_zero[-1].copy() if len(at_zero) else _state_at(run, tau), run)
    grazes = "; a ball grazes a wall" if _grazes(given) or _grazes(run) else ""
    raise ValueError(
        f"state: Newton's method found no motion with periods={periods} near this state; in the last "
        f"approximation, the states at both ends of the motion differ by {_gap(run):.2g}{grazes}"
    )


def _determined(run):
    """Return a mask, shape (8,), that is True for the coordinates that periodicity determines.

    The mask is False for inactive modules and for neutral balls. A ball is neutral if it hits no wall or has an immense
    mass. Periodicity does not determine the position of a neutral ball.
    """
    changes = np.abs(run.jacobian - np.eye(8))
    turned = changes[[5, 7]].max(axis=1) > _NEUTRAL * max(1.0, changes.max())
    balls = np.isin(np.arange(8), BALLS)
    return active_mask(run.system) & (~balls | turned[MODULES - 1])


def _nearer(run, step):
    """Return the run whose initial state is `run.start` + `step`.

    The step is halved until `_gap` of the new run is smaller than `_gap` of `run`. If this never happens, return None.
    """
    for _ in range(_HALVINGS):
        x = run.start + step
        if within_walls(x[None])[0]:
            moved = _with_free_balls_at_rest(run.system, x, run.cycles, run.tau0)
            if _gap(moved) < _gap(run):
                return moved
        step = step / 2
    return None


def _with_free_balls_at_rest(system, x, periods, begin):
    """Return the run from the state `x`, but with velocity 0 of all neutral balls (see `_determined`) at its start.

    With another velocity, a neutral ball would drift.
    """
    run = simulate(system, x, periods, begin)
    free = _BALL_VELOCITIES & ~_determined(run)
    return simulate(system, np.where(free, 0.0, x), periods, begin) if x[free].any() else run


def _gap(run):
    """Return the largest difference between the states at the start and at the end of a run."""
    return float(np.abs(run.final - run.start).max())


def _state_at(run, tau):
    return simulate(run.system, run.start.copy(), run.cycles, run.tau0, [tau]).samples[0]


def _grazes(run):
    return min(run.certificate.nearest_miss, run.certificate.shallowest_hit) <= _TOUCH
