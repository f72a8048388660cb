"""Direct integration of the equations of motion, (10.1) in the form (10.2)."""

import math
import numbers
import os
import sys
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from vibroimpact.exact import books
from vibroimpact.exact import events as kernel
from vibroimpact.exact.certificate import KNOWN, Certificate
from vibroimpact.exact.flow import flow_of
from vibroimpact.exact.variation import PUBLIC_ORDER, propagate
from vibroimpact.system import System

EVENT = np.dtype([("tau", "f8"), ("module", "i1"), ("wall", "i1"), ("kind", "i1"), ("state", "f8", (8,))])
"""One event: time, module 1 or 2, wall +1 or -1, kind (IMPACT, STICK, RELEASE), state just after it."""

IMPACT, STICK, RELEASE = books.IMPACT, books.STICK, books.RELEASE
MOST_EVENTS, MOST_EVENTS_PER_CYCLE = 1_000_000, 10_000
"""A run with more events is given up: only kappa next to 1 can chatter so long."""
FAILURES = {
    kernel.PENETRATED: "a ball went through a wall",
    kernel.STALLED: "time stands still",
    kernel.CROWDED: "there are too many events",
    kernel.EXHAUSTED: "there are too many exclusions",
}
NO_TIMES = np.empty(0)
KINDS = {IMPACT: "impact", STICK: "stick", RELEASE: "release"}


@dataclass(frozen=True, eq=False)
class Run:
    """A simulated motion.

    events: (m,) structured array (EVENT) in the order of time; samples: (n, 8) states at the sample times, at an event
    the state after it; final: (8,) state at the end. States are [X1, Y1, X2, Y2, X1', Y1', X2', Y2'].
    """

    system: System
    start: np.ndarray
    tau0: float
    cycles: int
    events: np.ndarray
    samples: np.ndarray
    final: np.ndarray
    _rows: np.ndarray = field(repr=False)

    @cached_property
    def _books(self):
        """Ledger and turns, kept in a second run that is the same step by step, so that the first need not pay."""
        return _integrate(self.system, self.start, self.cycles, self.tau0, NO_TIMES, np.empty((0, 8)), watch=True)[-2:]

    @cached_property
    def _variation(self):
        flow, limit = flow_of(self.system), KNOWN / np.finfo(float).eps
        duration = self.cycles * self.system.period
        _, turns = self._books
        phase = _phase(self.system, self.tau0)
        return propagate(flow, self.start, self._rows, self.final, phase, duration, limit, turns)

    @property
    def jacobian(self) -> np.ndarray:
        """Derivative of the final state by the first one, shape (8, 8), through impacts, chatters and releases."""
        return self._variation[0][np.ix_(PUBLIC_ORDER, PUBLIC_ORDER)]

    @cached_property
    def certificate(self) -> Certificate:
        """What the run can vouch for."""
        return Certificate.of(*self._books, self._variation, self.tau0)


def simulate(system: System, state, cycles: int, tau0: float = 0.0, sample_times=None) -> Run:
    """Integrate the exact system over a number of forcing cycles, impacts, chatter, sticking and release included.

    Args:
        system: parameters.
        state: (8,) start [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], dimensionless.
        cycles: forcing periods to run, a whole number >= 0.
        tau0: dimensionless time of the start (sets the forcing phase).
        sample_times: ascending tau in [tau0, tau0 + cycles * system.period]; none by default.

    Raises:
        ValueError: an argument is malformed, or the start has a ball beyond a wall (|X_i - Y_i| > 1).
        ArithmeticError: an invariant of the motion broke (a ball went through a wall, or time stood still), or there
            were too many events (more than a million and ten thousand for every cycle) or exclusions (docs/engine.md).
    """
    state = _checked_state(state)
    _check_window(cycles, tau0)
    times = _checked_times(sample_times, tau0, tau0 + cycles * system.period)
    return _run(system, state, int(cycles), tau0, times)


def simulate_many(system: System, states, cycles: int, tau0: float = 0.0, progress: bool = False) -> list[Run]:
    """Simulate from many starts on all cores; every run equals its `simulate` bit by bit.

    Args:
        system: parameters.
        states: (n, 8) starts.
        cycles, tau0: as for `simulate`.
        progress: report on standard error, about once a second.

    Raises:
        ValueError: an argument is malformed or a start inadmissible (its row is named).
        ArithmeticError: an invariant broke in one of the runs.
    """
    states = np.array(states, dtype=float)
    if states.ndim != 2 or states.shape[1] != 8:
        raise ValueError(f"states: needs shape (n, 8), got {states.shape}")
    for row, state in enumerate(states):
        try:
            _checked_state(state)
        except ValueError as error:
            raise ValueError(f"states[{row}]: {error}") from None
    _check_window(cycles, tau0)
    flow_of(system)  # built once, before the threads share it
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:  # the kernel releases the interpreter's lock
        runs = [pool.submit(_run, system, state, int(cycles), tau0, NO_TIMES) for state in states]
        if progress:
            _report(runs)
        return [run.result() for run in runs]


def _report(runs):
    """Count finished runs on standard error until all are done."""
    pending = set(runs)
    while pending:
        _, pending = wait(pending, timeout=1.0)
        print(
            f"\r{len(runs) - len(pending)}/{len(runs)} runs", end="" if pending else "\n", file=sys.stderr, flush=True
        )


def _run(system, state, cycles, tau0, times):
    """One run from checked arguments."""
    samples = np.empty((len(times), 8))
    boxes, balls, rows, status, *_ = _integrate(system, state, cycles, tau0, times, samples, watch=False)
    if status != kernel.FINISHED:
        what = FAILURES[status]
        raise ArithmeticError(f"{what} after {len(rows)} events, tau = {tau0 + (rows[-1, 0] if len(rows) else 0.0)}")
    final = np.empty(8)
    final[0::2], final[1::2] = boxes, balls
    return Run(system, state, tau0, cycles, _table(rows, tau0), samples, final, rows)


def _integrate(system, state, cycles, tau0, times, samples, watch):
    """The kernel's run: boxes, balls, events as rows, status, ledger, turns."""
    most_events = MOST_EVENTS + MOST_EVENTS_PER_CYCLE * cycles
    values = state.tolist()
    boxes, balls = tuple(values[0::2]), tuple(values[1::2])
    phase = _phase(system, tau0)
    return kernel.integrate(flow_of(system), boxes, balls, phase, cycles, tau0, times, samples, most_events, watch)


def _phase(system, tau):
    """Forcing phase Omega tau in [0, 2 pi)."""
    phase = math.fmod(system.Omega * tau, kernel.TWO_PI)
    return phase + kernel.TWO_PI if phase < 0.0 else phase


def _table(rows, tau0):
    """Rows [time, module, wall, kind, state, ...] as a structured array."""
    table = np.empty(len(rows), EVENT)
    table["tau"] = tau0 + rows[:, 0]
    for column, name in enumerate(("module", "wall", "kind"), start=1):
        table[name] = rows[:, column]
    table["state"] = rows[:, 4:12]
    return table


def _checked_state(state):
    state = np.array(state, dtype=float)
    if state.shape != (8,) or not np.isfinite(state).all():
        raise ValueError(f"state: needs 8 finite numbers [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], got {state.tolist()}")
    x1, y1, x2, y2 = state[:4].tolist()
    for module, box, relative in ((1, x1, x1 - y1), (2, x2, x2 - y2)):
        if abs(relative) > 1.0 + 1e-12 * (1.0 + abs(box)):
            raise ValueError(f"state: |X{module} - Y{module}| = {abs(relative)} is above 1, the ball is beyond a wall")
    return state


def _check_window(cycles, tau0):
    whole = isinstance(cycles, numbers.Real) and not isinstance(cycles, bool) and math.isfinite(cycles)
    if not whole or int(cycles) != cycles or cycles < 0:
        raise ValueError(f"cycles: {cycles!r} is not a whole number of at least 0")
    if not math.isfinite(tau0):
        raise ValueError(f"tau0: {tau0!r} is not finite")


def _checked_times(sample_times, start, end):
    if sample_times is None:
        return NO_TIMES
    times = np.array(sample_times, dtype=float)
    if times.ndim != 1 or not np.isfinite(times).all() or (np.diff(times) < 0).any():
        raise ValueError("sample_times: needs a one-dimensional ascending array of finite times")
    slack = 1e-9 * (1.0 + abs(end))
    if len(times) and not (start - slack <= times[0] and times[-1] <= end + slack):
        raise ValueError(f"sample_times: [{times[0]}, {times[-1]}] is not within the run [{start}, {end}]")
    return times
