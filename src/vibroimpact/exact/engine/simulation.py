"""Direct integration of the equations of motion, (10.1) in the form (10.2)."""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact import frames
from vibroimpact.exact.engine import event_log
from vibroimpact.exact.engine import event_loop as kernel
from vibroimpact.exact.engine.all_cores import on_all_cores, stop_if_given_up
from vibroimpact.exact.engine.certificate import KNOWN, Certificate
from vibroimpact.exact.engine.energy import Energy
from vibroimpact.exact.engine.errors import errors_at
from vibroimpact.exact.engine.flow import flow_of, tables_of
from vibroimpact.exact.engine.phase import Instant, exactly, phase_at
from vibroimpact.exact.engine.replay import replayed
from vibroimpact.exact.engine.request import NO_TIMES, checked_state, checked_times, checked_window
from vibroimpact.exact.engine.variation import INNER_ORDER, PUBLIC_ORDER, carried
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, real, reals
from vibroimpact.system.glance import Glance, brief
from vibroimpact.system.state import EVENT, KINDS


@dataclass(frozen=True, eq=False, repr=False, init=False)
class Run(Glance):
    """A simulated motion.

    system, start, cycles: what was asked for; begin: time of the start, exactly.
    events: (m,) structured array (EVENT) in the order of time, with the fields tau; module, 1 or 2; wall, +1 where
        X_i - Y_i = 1 or -1; kind, a key of KINDS: 0 an impact, 1 the ball comes to rest on the wall (stick), 2 it
        leaves it (release); state, (8,), just after the event.
    samples: (n, 8) states at the sample times, at an event the state after it; final: (8,) state at the end.
    pieces, ledger: the kernel's events, rows one after another (`event_log`), and its counts.

    States are [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], dimensionless. No array of a run can be written to.
    """

    system: System
    start: np.ndarray
    begin: float | Instant
    cycles: int
    samples: np.ndarray
    final: np.ndarray
    pieces: list[np.ndarray]
    ledger: np.ndarray

    def __init__(self, system, start, begin, cycles, samples, final, pieces, ledger):
        fields = self.__dict__  # at once, in half of the time that a frozen class takes for one after another
        fields.update(system=system, start=start, begin=begin, cycles=cycles)
        fields.update(samples=samples, final=final, pieces=pieces, ledger=ledger)
        for array in (start, samples, final, ledger):
            array.flags.writeable = False

    def _glance(self):
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
        """The kernel's events (n, ROW), in one array from now on."""
        rows = self.pieces[0] if len(self.pieces) == 1 else np.concatenate(self.pieces)
        self.pieces[:] = [rows]
        rows.flags.writeable = False
        return rows

    @cached_property
    def events(self) -> np.ndarray:
        table = np.empty(len(self.rows), EVENT)
        table["tau"] = self.tau0 + self.rows[:, event_log.TIME]
        for name, column in (("module", event_log.MODULE), ("wall", event_log.WALL), ("kind", event_log.KIND)):
            table[name] = self.rows[:, column]
        table["state"] = self.rows[:, 4 : event_log.PHASE]
        table.flags.writeable = False
        return table

    @property
    def tau0(self) -> float:
        """Time of the start, rounded."""
        return float(self.begin)

    @property
    def end(self) -> Instant:
        """Time of the final state, exactly; a run from there, tau0=run.end, goes on in the same forcing phase."""
        return exactly(self.begin).later(self.cycles, self.system.Omega)

    @cached_property
    def jacobian(self) -> np.ndarray:
        """Derivative of the final state by the first one, shape (8, 8), through impacts, chatters and releases."""
        jacobian = self.carry(np.eye(8))
        jacobian.flags.writeable = False
        return jacobian

    def carry(self, perturbations: np.ndarray) -> np.ndarray:
        """Perturbations (8, k) of the start as they are in the final state, to first order."""
        return carried(*self.course, perturbations[INNER_ORDER])[PUBLIC_ORDER]

    @cached_property
    def certificate(self) -> Certificate:
        """What the run can vouch for."""
        return Certificate.of(self)

    @cached_property
    def energy(self) -> Energy:
        """Where the energy goes, over the run and in every cycle."""
        return Energy.of(self)

    def errors(self, times: ArrayLike) -> np.ndarray:
        """Estimated errors of the states at some times, shape (n,): what `certificate.error` is of the final one.

        Args:
            times: ascending tau within the run.

        Raises:
            ValueError: they are not.
        """
        begin = self.tau0
        times = checked_times("times", times, begin, begin + self.cycles * self.system.period)
        return errors_at(*self.course, times - begin, KNOWN)

    def to_frame(self):
        """The events as a pandas DataFrame: tau, module, wall, kind in words, and the state after each."""
        return frames.of_run(self)

    def section(self, phase: float = 0.0) -> np.ndarray:
        """States (n, 8) where the phase Omega tau of the forcing is `phase` [rad], one in each cycle.

        A stroboscopic Poincare section; the motion is computed once more.
        """
        return self._sampled(frames.section_times(self, real("phase", phase)))

    def plot(self):
        """A Matplotlib Figure of X_i of both boxes and W_i = X_i - Y_i between its walls; computed once more."""
        times = frames.plot_times(self)
        return frames.plot(self.system, times, self._sampled(times))

    def _sampled(self, times):
        return simulate(self.system, self.start, self.cycles, self.begin, times).samples

    @cached_property
    def course(self) -> tuple:
        """The flow, the flights between the events and the events as `replayed` and `event_log` tell them."""
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
    """Integrate the exact system over a number of forcing cycles, impacts, chatter, sticking and release included.

    Args:
        system: parameters.
        state: (8,) start [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], dimensionless.
        cycles: forcing periods to run, a whole number from 0 to ten million, since a run holds all its events; a longer
            motion is a run from `run.final` with tau0=run.end.
        tau0: dimensionless time of the start, taken exactly (it sets the forcing phase): a real number, a fraction, or
            the end of a run, `run.end`. |tau0| and the end stay below 2**43, where floats still tell times apart.
        sample_times: ascending tau in [tau0, tau0 + cycles * system.period]; none by default.

    Returns:
        The Run: its events, the samples, the final state; what it can vouch for, `run.certificate`, and the derivative
        of the final state, `run.jacobian`, are computed when asked for. The first run on a machine waits until Numba
        has compiled the engine, and says so; `python -m vibroimpact.compile` does that beforehand.

    Raises:
        ValueError: an argument is malformed, or the start has a ball beyond a wall (|X_i - Y_i| > 1).
        ArithmeticError: an invariant of the motion broke (a ball went through a wall, or time stood still), or there
            were too many events (more than a million and ten thousand for every cycle) or exclusions (docs/engine.md).
    """
    instance("system", system, System)
    state = checked_state(state)
    begin, cycles = checked_window(system, cycles, tau0)
    times = NO_TIMES
    if sample_times is not None:
        start = float(begin)
        times = checked_times("sample_times", sample_times, start, start + cycles * system.period)
    return _run(system, state, cycles, begin, times)


def simulate_many(
    system: System, states: ArrayLike, cycles: int, tau0: float | Fraction | Instant = 0.0, progress: bool = False
) -> list[Run]:
    """Simulate from many starts on all cores; every run equals its `simulate` bit by bit.

    Args:
        system: parameters.
        states: (n, 8) starts.
        cycles, tau0: as for `simulate`.
        progress: report on standard error, about once a second.

    Returns:
        One Run for each start, in their order.

    Raises:
        ValueError: an argument is malformed or a start inadmissible (its row is named).
        ArithmeticError: an invariant broke in one of the runs.
    """
    instance("system", system, System)
    states = np.ascontiguousarray(reals("states", states))  # rows of another order would be compiled for anew
    if states.ndim != 2 or states.shape[1] != 8:
        raise ValueError(f"states: needs shape (n, 8), got {states.shape}")
    for row, state in enumerate(states):
        try:
            checked_state(state)
        except ValueError as error:
            raise ValueError(f"states[{row}]: {error}") from None
    begin, cycles = checked_window(system, cycles, tau0)
    tables_of(system)  # built once, before the threads share it
    pieces = [(system, state, cycles, begin, NO_TIMES) for state in states]
    return on_all_cores(_run, pieces, [1] * len(pieces), progress)


def _run(system, state, cycles, begin, times):
    """One run from checked arguments."""
    samples, final, tau0 = np.empty((len(times), 8)), np.empty(8), float(begin)
    (rows, ledger, where), pieces = kernel.memory(cycles), []
    given = *tables_of(system), state, *phase_at(begin, system.Omega), cycles, tau0, times, samples, final
    while (status := kernel.integrate(*given, rows, ledger, where)) == kernel.PAUSED:
        if kernel.is_full(rows, ledger):
            pieces.append(rows[: int(ledger[event_log.EVENTS])])
            kernel.empty_rows(ledger, where)
            rows = np.empty((kernel.PIECE, event_log.ROW))
        stop_if_given_up()
    rows = rows[: int(ledger[event_log.EVENTS])]
    if status != kernel.FINISHED:
        what = kernel.FAILURES[status]
        last = rows if len(rows) or not pieces else pieces[-1]
        number, time = sum(map(len, pieces)) + len(rows), last[-1, 0] if len(last) else 0.0
        raise ArithmeticError(f"{what} after {number} events, tau = {tau0 + time}")
    return Run(system, state, begin, cycles, samples, final, [*pieces, rows], ledger)
