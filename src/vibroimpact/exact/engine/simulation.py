"""Simulate single motions of (10.2), the dimensionless form of (10.1)."""

import math
import numbers
from dataclasses import dataclass, fields
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact import frames
from vibroimpact.exact.engine import contact, event_loop
from vibroimpact.exact.engine.all_cores import on_all_cores, stop_if_cancelled
from vibroimpact.exact.engine.certificate import HORIZON_ERROR, Certificate, errors_at
from vibroimpact.exact.engine.energy import Energy
from vibroimpact.exact.engine.flow import Instant, continues, exactly, flow_of, phase_at, tables_of
from vibroimpact.exact.engine.variation import INNER_ORDER, PUBLIC_ORDER, propagate, replayed, rests_at_start
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, real, reals, short_repr, whole
from vibroimpact.system.representation import Representation, brief
from vibroimpact.system.state import EVENT, KINDS, states_array

NO_TIMES = np.empty(0)
LARGEST_TIME = 2.0**43
"""Limit on |tau|: beyond it, floats are more than 1e-3 apart, too coarse for the times of events."""
MOST_CYCLES = 10_000_000
"""Largest number of cycles in one run. A run stores all its events, which take about a kilobyte per cycle."""
PLOTTED_PER_CYCLE, MOST_PLOTTED = 64, 20_000
"""Number of samples per cycle in the plot of a run, and largest number of samples."""
WALL_TOLERANCE = 1e-12
"""Accepted distance of a ball beyond a wall in an initial state (plus rounding); the run moves the ball to the wall."""


def checked_state(state) -> np.ndarray:
    """Return an initial state as an array of shape (8,).

    Raise ValueError if the state is malformed or a ball is beyond a wall.
    """
    state = states_array("state", state)
    values = state.tolist()
    if state.shape != (8,):
        raise ValueError(f"state: needs shape (8,), got {state.shape}")
    if not all(map(math.isfinite, values)):
        raise ValueError(
            f"state: needs 8 finite numbers [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], got {short_repr(values)}"
        )
    for module in (1, 2):
        box, ball = values[2 * module - 2 : 2 * module]
        relative = abs(box - ball)
        if relative > 1.0 + WALL_TOLERANCE + 2.0 * math.ulp(max(abs(box), abs(ball))):
            raise ValueError(f"state: |X{module} - Y{module}| = {relative} is above 1, the ball is beyond a wall")
    return state


def within_walls(states) -> np.ndarray:
    """Return a boolean array of shape (n,): True for each initial state that `checked_state` would accept.

    states: initial states, shape (n, 8).
    """
    boxes, balls = states[:, 0:4:2], states[:, 1:4:2]
    with np.errstate(invalid="ignore", over="ignore"):
        slack = WALL_TOLERANCE + 2.0 * np.spacing(np.maximum(abs(boxes), abs(balls)))
        inside = abs(boxes - balls) <= 1.0 + slack
    return inside.all(axis=1) & np.isfinite(states).all(axis=1)


def checked_window(system, cycles, tau0) -> tuple[float | Instant, int]:
    """Return the exact start time and the number of cycles of a run.

    Raise ValueError if an argument is malformed, or if |tau| reaches LARGEST_TIME during the run.
    """
    cycles = whole("cycles", cycles, 0, MOST_CYCLES)
    if isinstance(tau0, Instant):
        begin = tau0
    else:  # a float stays as it is; any other rational number becomes an Instant, without rounding
        number = real("tau0", tau0)
        begin = exactly(tau0) if isinstance(tau0, numbers.Rational) else number
    start = float(begin)
    end = start + cycles * system.period
    if not (abs(start) < LARGEST_TIME and abs(end) < LARGEST_TIME):
        name, tau = ("cycles", end) if abs(start) < LARGEST_TIME else ("tau0", start)
        raise ValueError(
            f"{name}: the run reaches tau = {tau}, but |tau| must stay below 2**43. Larger floats are more than 1e-3 "
            "apart. Subtract whole forcing periods from tau0; the motion stays the same"
        )
    return begin, cycles


def checked_times(name, times, start, end) -> np.ndarray:
    """Return sample times as an array of shape (n,).

    Raise ValueError if the times are not ascending, not finite or not within the run.
    """
    times = reals(name, times)
    if times.ndim != 1 or not np.isfinite(times).all() or (np.diff(times) < 0).any():
        raise ValueError(f"{name}: needs ascending finite times in one dimension, got {short_repr(times.tolist())}")
    slack = 4.0 * math.ulp(max(abs(start), abs(end)))
    if len(times) and not (start - slack <= times[0] and times[-1] <= end + slack):
        raise ValueError(
            f"{name}: needs times within the run, from {start} to {end}; got times from {times[0]} to {times[-1]}"
        )
    return times


@dataclass(frozen=True, eq=False, repr=False)
class Run(Representation):
    """A simulated motion.

    States are [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], dimensionless. Arrays are read-only.

    Attributes
    ----------
    system : System
        Dimensionless parameters.
    start : ndarray
        Initial state, shape (8,).
    begin : float or Instant
        Exact start time.
    cycles : int
        Number of forcing periods.
    samples : ndarray
        States at the sample times, shape (n, 8). A sample at the time of an event is the state after the event.
    final : ndarray
        Final state, shape (8,).
    pieces : list of ndarray
        Rows of events, as arrays of shape (n, ROW). `vibroimpact.exact.engine.contact` defines the rows.
    counters : ndarray
        Counters of the run. `vibroimpact.exact.engine.contact` defines the counters.
    """

    system: System
    start: np.ndarray
    begin: float | Instant
    cycles: int
    samples: np.ndarray
    final: np.ndarray
    pieces: list[np.ndarray]
    counters: np.ndarray

    def __post_init__(self):
        for array in (self.start, self.samples, self.final, self.counters):
            array.flags.writeable = False

    def __reduce__(self):
        """Copy or unpickle a run through its constructor, because copies of NumPy arrays lose the read-only flag."""
        return type(self), tuple(getattr(self, field.name) for field in fields(self))

    def _shown(self):
        counts = np.bincount(self.events["kind"], minlength=len(KINDS))
        return {
            "cycles": str(self.cycles),
            "tau0": brief(self.tau0),
            "events": f"{len(self.events)}: " + ", ".join(f"{counts[kind]} {name}" for kind, name in KINDS.items()),
            "samples": str(len(self.samples)),
            "final": brief(self.final),
        }

    @cached_property
    def rows(self) -> np.ndarray:
        """Rows of the events as one array, shape (n, ROW); `vibroimpact.exact.engine.contact` defines a row."""
        rows = self.pieces[0] if len(self.pieces) == 1 else np.concatenate(self.pieces)
        self.pieces[:] = [rows]
        rows.flags.writeable = False
        return rows

    @cached_property
    def events(self) -> np.ndarray:
        """Events in order of time, a structured array of type EVENT, shape (m,).

        tau: time of the event. module: 1 or 2. wall: +1 or -1, the value of X_i - Y_i at the wall.
        kind: 0 impact, 1 stick (the ball comes to rest on the wall), 2 release (the ball leaves the wall); see KINDS.
        state: state just after the event, shape (8,).
        """
        rows = self.rows
        if continues(self.begin):  # a ball that stuck at the end of the previous run gets no new stick event
            again = [n for n in range(min(event_loop.MOST_AT_ONCE, len(rows))) if rests_at_start(rows, n)]
            rows = np.delete(rows, again, axis=0)
        table = np.empty(len(rows), EVENT)
        table["tau"] = self.tau0 + rows[:, contact.TIME]
        for name, column in (("module", contact.MODULE), ("wall", contact.WALL), ("kind", contact.KIND)):
            table[name] = rows[:, column]
        table["state"] = rows[:, 4 : contact.PHASE]
        table.flags.writeable = False
        return table

    @property
    def tau0(self) -> float:
        """Start time, rounded to a float."""
        return float(self.begin)

    @property
    def end(self) -> Instant:
        """Exact time of the final state.

        To continue this run with the exact forcing phase, start from `run.final` with tau0=run.end.
        """
        return exactly(self.begin).later(self.cycles, self.system.Omega)

    @cached_property
    def jacobian(self) -> np.ndarray:
        """Derivative of the final state with respect to the initial state, shape (8, 8).

        The derivative includes the effects of impacts, chatter, sticking and releases.
        """
        jacobian = propagate(*self.trajectory, np.eye(8)[INNER_ORDER])[PUBLIC_ORDER]
        jacobian.flags.writeable = False
        return jacobian

    @cached_property
    def certificate(self) -> Certificate:
        """Certificate of the run: proofs that no event was missed, and error estimates."""
        return Certificate.of(self)

    @cached_property
    def energy(self) -> Energy:
        """Energy balance over the run and in every cycle."""
        return Energy.of(self)

    def errors(self, times: ArrayLike) -> np.ndarray:
        """Return estimated errors of the states at given times.

        The estimates include the effect of rounding the times.

        Parameters
        ----------
        times : array_like
            Ascending times tau within the run, shape (n,).

        Returns
        -------
        ndarray
            Root mean square errors, shape (n,). Errors after the time `certificate.horizon` are inf.

        Raises
        ------
        ValueError
            If the times are not ascending or not within the run.
        """
        begin = self.tau0
        times = checked_times("times", times, begin, begin + self.cycles * self.system.period)
        return errors_at(*self.trajectory, times - begin, HORIZON_ERROR)

    def to_frame(self):
        """Return the events as a pandas DataFrame: tau, module, wall, kind as text and state after the event."""
        return frames.of_run(self)

    def section(self) -> np.ndarray:
        """Return the stroboscopic section: the states at the start and after each cycle, shape (cycles + 1, 8).

        To compute these states, the run is simulated again.
        """
        return self._sampled(self.system.period * np.arange(self.cycles + 1))

    def plot(self):
        """Return a Matplotlib Figure with X_i and W_i = X_i - Y_i over time.

        To compute the curves, the run is simulated again.
        """
        samples = min(PLOTTED_PER_CYCLE * self.cycles, MOST_PLOTTED)
        since = np.linspace(0.0, self.cycles * self.system.period, samples + 1)
        return frames.plot(self.system, self.tau0 + since, self._sampled(since))

    def _sampled(self, since):
        """Return the states of the run at given times, shape (n, 8).

        since: times since the start of the run, shape (n,). Their precision does not depend on tau0.
        """
        start = self.start.copy()  # a read-only array would trigger another compilation
        return _run(self.system, start, self.cycles, self.begin, since, clock=0.0).samples

    @cached_property
    def trajectory(self) -> tuple:
        """Tuple of the flow tables, the flights between events and the rows of events.

        `replayed` describes the flights, and `vibroimpact.exact.engine.contact` describes the rows.
        """
        flow, duration = flow_of(self.system), self.cycles * self.system.period
        phase = phase_at(self.begin, self.system.Omega)[0]
        return flow, replayed(flow, self.start, self.rows, phase, duration), self.rows


def simulate(
    system: System,
    state: ArrayLike,
    cycles: int,
    tau0: float | Fraction | Instant = 0.0,
    sample_times: ArrayLike | None = None,
) -> Run:
    """Simulate the exact system over a number of forcing cycles.

    The run includes impacts, chatter, sticking and release. Between events, the motion is computed in closed form,
    without time steps.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    state : array_like
        Initial state [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], shape (8,), dimensionless.
    cycles : int
        Number of forcing periods, from 0 to ten million. A run stores all its events.
    tau0 : float, Fraction or Instant, default 0.0
        Dimensionless start time, used without rounding; |tau| must stay below 2**43. To continue a run, start from
        `run.final` with tau0=run.end. A ball that stuck at the end of the first run then gets no new stick event.
    sample_times : array_like, optional
        Ascending times in [tau0, tau0 + cycles * system.period] at which to record states.

    Returns
    -------
    Run
        Events, samples and final state. The attributes `certificate`, `energy` and `jacobian` (derivative of the final
        state with respect to the initial state) are computed on first access.

    Raises
    ------
    ValueError
        If an argument is malformed, or if a ball starts beyond a wall (|X_i - Y_i| > 1).
    ArithmeticError
        If a ball passes through a wall, or if time does not advance. The error is also raised if the run has too many
        events (more than a million plus ten thousand per cycle), or if the run needs too many proofs that no event
        happens (docs/engine.md).

    Notes
    -----
    The first run on a new machine compiles the engine. `python -m vibroimpact.compile` compiles in advance.

    Examples
    --------
    >>> run = vi.simulate(system, [0.0] * 8, cycles=100)
    >>> run.final.shape
    (8,)
    """
    instance("system", system, System)
    state = checked_state(state)
    begin, cycles = checked_window(system, cycles, tau0)
    times = NO_TIMES
    if sample_times is not None:
        start = float(begin)
        times = checked_times("sample_times", sample_times, start, start + cycles * system.period)
    return _run(system, state, cycles, begin, times, float(begin))


def simulate_many(
    system: System, states: ArrayLike, cycles: int, tau0: float | Fraction | Instant = 0.0, progress: bool = False
) -> list[Run]:
    """Simulate runs from many initial states on all cores.

    Each run is identical, bit by bit, to a run of `simulate` from the same state.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    states : array_like
        Initial states, shape (n, 8).
    cycles, tau0
        As for `simulate`.
    progress : bool, default False
        Report progress on standard error.

    Returns
    -------
    list of Run
        One run per initial state, in order.

    Raises
    ------
    ValueError
        If an argument is malformed or an initial state is invalid. The message gives the row of the state.
    ArithmeticError
        If one of the runs fails for one of the reasons listed in `simulate`.

    Examples
    --------
    >>> runs = vi.simulate_many(system, np.zeros((4, 8)), cycles=10)
    >>> len(runs)
    4
    """
    instance("system", system, System)
    # Another memory order would trigger another compilation.
    states = np.ascontiguousarray(states_array("states", states))
    if states.ndim != 2 or states.shape[1] != 8:
        raise ValueError(f"states: needs shape (n, 8), got {states.shape}")
    for row, state in enumerate(states):
        try:
            checked_state(state)
        except ValueError as error:
            raise ValueError(str(error).replace("state", f"states[{row}]", 1)) from None
    begin, cycles = checked_window(system, cycles, tau0)
    tables_of(system)  # build the tables once, before the threads share them
    pieces = [(system, state, cycles, begin, NO_TIMES, 0.0) for state in states]
    return on_all_cores(_run, pieces, [1] * len(pieces), progress)


def _run(system, state, cycles, begin, times, clock):
    """Return a run, given checked arguments, or raise ArithmeticError if the run fails.

    begin: exact start time.
    times: sample times.
    clock: tau0 if `times` are values of tau, or 0 if `times` are counted from the start of the run.
    """
    status, run = attempt(system, state, cycles, begin, times, clock)
    if status != event_loop.FINISHED:
        number, time = len(run.rows), run.rows[-1, 0] if len(run.rows) else 0.0
        raise ArithmeticError(
            f"{event_loop.FAILURES[status]}: stopped after {number} events, at tau = {run.tau0 + time}"
        )
    return run


def attempt(system, state, cycles, begin, times, clock):
    """Simulate with the arguments of `_run`, and return (status, run).

    If the simulation fails, the run ends at the failure, and `status` is a key of `event_loop.FAILURES`.
    """
    run, rows, counters = event_loop.memory(state, *phase_at(begin, system.Omega), cycles, clock)
    tables, samples, pieces = tables_of(system), np.empty((len(times), 8)), []
    while (status := event_loop.integrate(*tables, run, times, samples, rows, counters)) == event_loop.PAUSED:
        if counters[contact.EVENTS] + event_loop.MOST_AT_ONCE > len(rows):
            pieces.append(rows[: int(counters[contact.EVENTS])])
            run[event_loop.EARLIER_EVENTS] += counters[contact.EVENTS]
            rows, counters[contact.EVENTS] = np.empty((event_loop.ROWS_PER_PIECE, contact.ROW)), 0.0
        stop_if_cancelled()
    pieces.append(rows[: int(counters[contact.EVENTS])])
    return status, Run(system, state, begin, cycles, samples, run[:8].copy(), pieces, counters)
