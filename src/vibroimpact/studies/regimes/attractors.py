"""Find attractors and their basins on a line or a plane of initial states."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from vibroimpact.exact.engine.simulation import checked_state
from vibroimpact.exact.periodic import PeriodicOrbit, refined
from vibroimpact.studies.regimes.classification import PERIODIC, UNSETTLED
from vibroimpact.studies.regimes.settling import Observation, settle
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, reals, short_repr
from vibroimpact.system.state import NAMES, active_mask, states_array

OPEN = -1
"""Label of an initial state that has not settled, as in Attractors.jl."""
_SAME, _SAME_IDLE = 1e-6, 1e-4
"""Largest difference of displacements between two motions that count as one attractor. The second value applies if a
ball is at rest: Newton's method does not refine a motion with a ball at rest, so that part of its transient remains."""

_COORDINATES = {name: (k,) for k, name in enumerate(NAMES)} | {"W1": (0, 1), "W2": (2, 3)}
"""Name of a coordinate -> its index in the state. W_i has the indices of X_i and Y_i, and sets Y_i to X_i - W_i."""


@dataclass(frozen=True, eq=False)
class Attractor:
    """An attractor: its regime and its stroboscopic section.

    Attributes
    ----------
    regime : str
        One of `vibroimpact.studies.regimes.classification.REGIMES`.
    cycles : int or None
        Number of forcing periods after which the motion repeats, or None if the motion does not repeat.
    states : ndarray
        Stroboscopic section: one state per forcing period, shape (k, 8). If the motion repeats, k = `cycles`.
        Otherwise, the states are those of the last window of the run (`Observation.window`).
    orbit : PeriodicOrbit or None
        The motion with its multipliers if the regime is periodic, else None.
    """

    regime: str
    cycles: int | None
    states: np.ndarray
    orbit: PeriodicOrbit | None


@dataclass(frozen=True, eq=False)
class Basins:
    """Attractors of a system, and a label that assigns each initial state to an attractor.

    Attributes
    ----------
    labels : ndarray
        Label of each initial state. The labels of attractors are 1, 2, and so on. The label -1 means that the motion
        from an initial state has not settled. The Julia package Attractors.jl uses the same labels.
    attractors : dict of int to Attractor
        Attractor of each label.
    shares : dict of int to float
        Fraction of the initial states with each label.
    axes : dict of str to ndarray
        Values of the varied coordinates, by name. The dict is empty if the initial states were given as a list.
    """

    labels: np.ndarray
    attractors: dict[int, Attractor]
    shares: dict[int, float]
    axes: dict[str, np.ndarray]

    def rows(self, number: int = 0) -> list[dict]:
        """Return one row per initial state, with the varied coordinates, the label and the regime.

        If the initial states were given as a list, a row has the position in the list instead of coordinates.

        Parameters
        ----------
        number : int, default 0
            Ignored. The function `to_frame` passes this argument.

        Returns
        -------
        list of dict
            One row per initial state.
        """
        grid = np.meshgrid(*self.axes.values(), indexing="ij") if self.axes else [np.arange(len(self.labels))]
        columns = dict(zip(self.axes or ["start"], (values.ravel().tolist() for values in grid), strict=True))
        labels = self.labels.ravel().tolist()
        regimes = ["unsettled" if label == OPEN else self.attractors[label].regime for label in labels]
        every = columns | {"label": labels, "regime": regimes}
        return [dict(zip(every, values, strict=True)) for values in zip(*every.values(), strict=True)]


def attractors(system: System, states, observation: Observation | None = None, progress: bool = True) -> Basins:
    """Return the attractors that the motions from a list of initial states reach.

    Two periodic motions are one attractor if their displacements agree after a shift by whole periods. Mirror images
    are two attractors. Motions that do not repeat are distinguished only by their regime. The position of a ball at
    rest is ignored.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    states : array_like
        Initial states at tau = 0, shape (n, 8). A ball that starts at rest may never be hit by a wall. An inactive
        module (`System.modules`) is put at rest.
    observation : Observation, optional
        Lengths of the runs. Transients may be long. In a test with equal forces on both boxes, 210 of 225 motions still
        changed by more than 1e-6 per period after 400 periods. After 2000 periods, no motion did.
    progress : bool, default True
        If True and standard error is a terminal, show there how many initial states are done.

    Returns
    -------
    Basins
        The attractors, the label of each initial state, and the share of each label. The labels have the shape (n,).

    Raises
    ------
    ValueError
        If an argument is malformed.
    ArithmeticError
        If a run could not be finished.

    Examples
    --------
    >>> from vibroimpact import starts
    >>> found = attractors(system, starts(6, seed=1))
    >>> [found.attractors[label].regime for label in found.shares]
    ['asymmetric', 'asymmetric']
    """
    states = states_array("states", states)
    if states.ndim != 2 or states.shape[1] != 8 or not len(states):
        raise ValueError(f"states: got shape {states.shape}, expected (n, 8) with n above 0")
    return _basins(system, states, states.shape[:1], {}, observation, progress)


def basins(
    system: System,
    axes: Mapping[str, Iterable[float]],
    state=(0.0,) * 8,
    observation: Observation | None = None,
    progress: bool = True,
) -> Basins:
    """Return the basins of attraction on a line or plane of initial states.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    axes : mapping
        Values of one or two coordinates by name. The names of displacements are X1, Y1, X2, Y2, W1 and W2. The names of
        velocities are dX1, dY1, dX2 and dY2. Ball i is between its walls if -1 < W_i = X_i - Y_i < 1.
    state : array_like, optional
        State at tau = 0, shape (8,). Coordinates that are not in `axes` have their values in this state, 0 by default.
    observation, progress
        As for `attractors`.

    Returns
    -------
    Basins
        The attractors, the label of each initial state, and the share of each label. The array of labels has one
        dimension per axis. `to_frame([found])` returns a table.

    Raises
    ------
    ValueError
        If an argument is malformed, or if a ball would start beyond a wall.
    ArithmeticError
        If a run could not be finished.

    Examples
    --------
    >>> W = np.linspace(-0.8, 0.8, 3)
    >>> found = basins(system, {"W1": W, "W2": W})
    >>> found.labels.shape, sum(found.shares.values())
    ((3, 3), 1.0)
    """
    if not isinstance(axes, Mapping) or not 1 <= len(axes) <= 2:
        raise ValueError(
            f"axes: got {short_repr(axes)}, expected values of one or two coordinates, such as {{'W1': [-0.5, 0.5], "
            "'X1': [0.0, 0.1]}"
        )
    for name in axes:
        if name not in _COORDINATES:
            raise ValueError(f"axes: got {name!r}, expected one of {', '.join(_COORDINATES)}")
    if len({_COORDINATES[name][-1] for name in axes}) < len(axes):
        raise ValueError(
            f"axes: {' and '.join(axes)} both set the position of ball {_COORDINATES[name][-1] // 2 + 1}; "
            "give only one of them"
        )
    axes = {name: reals(f"axes[{name!r}]", list(values)).ravel() for name, values in axes.items()}
    for name, values in axes.items():
        if not len(values):
            raise ValueError(f"axes[{name!r}]: got no value")
    grid = np.meshgrid(*axes.values(), indexing="ij")
    states = np.tile(checked_state(state), (grid[0].size, 1))
    for name, values in sorted(zip(axes, grid, strict=True), key=lambda pair: len(_COORDINATES[pair[0]])):
        first, *ball = _COORDINATES[name]
        states[:, ball or first] = (states[:, [first]] - values.reshape(-1, 1)) if ball else values.ravel()
    return _basins(system, states, grid[0].shape, axes, observation, progress)


def _basins(system, states, shape, axes, observation, progress):
    instance("system", system, System)
    observation = instance("observation", Observation() if observation is None else observation, Observation)
    for row, state in enumerate(states):
        try:
            checked_state(state)
        except ValueError as error:
            raise ValueError(f"initial state {row}: {error}") from None
    regimes = settle(system, states, observation, progress)
    labels, known, found = np.full(len(regimes), OPEN), [], {}
    for k, regime in enumerate(regimes):
        if regime.name == UNSETTLED:
            continue
        place = next((n for n, one in enumerate(known) if _same(one, regime)), len(known))
        if place == len(known):
            run, repeats = regime.run, regime.repeats
            orbit = refined(run.system, run.start, repeats) if regime.name in PERIODIC else None
            known.append(regime)
            found[len(known)] = Attractor(regime.name, repeats, run.samples[::2][:repeats], orbit)
        labels[k] = place + 1
    shares = {int(label): float(np.mean(labels == label)) for label in np.unique(labels)}
    shares = dict(sorted(shares.items(), key=lambda item: -item[1]))
    return Basins(labels.reshape(shape), found, shares, axes)


def _same(one, other):
    """Return True if the motions of two Regime objects are on the same attractor."""
    moving = _moving(one)
    if (one.name, one.repeats) != (other.name, other.repeats) or not np.array_equal(moving, _moving(other)):
        return False
    if one.repeats is None:
        return True
    ours, theirs = (regime.run.samples[: 2 * one.repeats, moving] for regime in (one, other))
    gaps = [np.abs(np.roll(ours, 2 * shift, axis=0) - theirs).max() for shift in range(one.repeats)]
    idle = len(moving) < np.count_nonzero(active_mask(one.run.system)[:4])
    return min(gaps) < (_SAME_IDLE if idle else _SAME)


def _moving(regime):
    """Return the indices in a state at which the displacements of boxes and moving balls are stored.

    Only active modules are included. A ball moves if its velocity is nonzero in at least one sample.
    """
    samples, moves = regime.run.samples, active_mask(regime.run.system)
    return np.array([k for k in range(4) if moves[k] and (k in (0, 2) or samples[:, 4 + k].any())])
