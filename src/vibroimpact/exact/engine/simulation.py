"""Direct integration of the equations of motion, (10.1) in the form (10.2)."""

import math
import numbers
import os
import sys
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact.exact.engine import event_log
from vibroimpact.exact.engine import event_loop as kernel
from vibroimpact.exact.engine.certificate import Certificate
from vibroimpact.exact.engine.flow import flow_of
from vibroimpact.exact.engine.phase import Instant, exactly, phase_at
from vibroimpact.exact.engine.replay import replayed
from vibroimpact.exact.engine.variation import PUBLIC_ORDER, jacobian
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, real, reals, shown, whole
from vibroimpact.system.glance import Glance, brief
from vibroimpact.system.state import EVENT, KINDS

FAILURES = {
    kernel.PENETRATED: "a ball went through a wall",
    kernel.STALLED: "time stands still",
    kernel.CROWDED: "there are too many events",
    kernel.EXHAUSTED: "there are too many exclusions",
}
NO_TIMES = np.empty(0)
LATEST = 2.0**43
"""From here on floats are further apart than 1e-3, and times of a run cannot be told."""
MOST_CYCLES = 10_000_000
"""Of one run, which holds all its events: a kilobyte or so for a cycle."""
ROUNDED = 1e-12
"""So far beyond a wall (and by the rounding of the positions) a ball may start: it is put on the wall."""


@dataclass(frozen=True, eq=False, repr=False)
class Run(Glance):
    """A simulated motion.

    system, start, cycles: what was asked for; begin: time of the start, exactly.
    events: (m,) structured array (EVENT) in the order of time, with the fields tau; module, 1 or 2; wall, +1 where
        X_i - Y_i = 1 or -1; kind, a key of KINDS: 0 an impact, 1 the ball comes to rest on the wall (stick), 2 it
        leaves it (release); state, (8,), just after the event.
    samples: (n, 8) states at the sample times, at an event the state after it; final: (8,) state at the end.
    ledger: the kernel's (`event_log`).

    States are [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], dimensionless.
    """

    system: System
    start: np.ndarray
    begin: float | Instant
    cycles: int
    events: np.ndarray
    samples: np.ndarray
    final: np.ndarray
    _rows: np.ndarray = field(repr=False)
    ledger: np.ndarray = field(repr=False)

    def _glance(self):
        counts = np.bincount(self.events["kind"], minlength=len(KINDS))
        return {
            "cycles": str(self.cycles),
            "tau0": brief(self.tau0),
            "events": f"{len(self.events)}: " + ", ".join(f"{counts[kind]} {name}" for kind, name in KINDS.items()),
            "samples": str(len(self.samples)),
            "final": brief(self.final),
        }

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
        return jacobian(*self.course)[np.ix_(PUBLIC_ORDER, PUBLIC_ORDER)]

    @cached_property
    def certificate(self) -> Certificate:
        """What the run can vouch for."""
        return Certificate.of(self)

    @cached_property
    def course(self) -> tuple:
        """The flow, the flights between the events and the events as `replayed` and `event_log` tell them."""
        flow, duration = flow_of(self.system), self.cycles * self.system.period
        phase = phase_at(self.begin, self.system.Omega)[0]
        return flow, replayed(flow, self.start, self._rows, phase, duration), self._rows


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
    state = _checked_state(state)
    begin, cycles = _checked_window(system, cycles, tau0)
    times = _checked_times(sample_times, float(begin), float(begin) + cycles * system.period)
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
    states = reals("states", states)
    if states.ndim != 2 or states.shape[1] != 8:
        raise ValueError(f"states: needs shape (n, 8), got {states.shape}")
    for row, state in enumerate(states):
        try:
            _checked_state(state)
        except ValueError as error:
            raise ValueError(f"states[{row}]: {error}") from None
    begin, cycles = _checked_window(system, cycles, tau0)
    flow_of(system)  # built once, before the threads share it
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:  # the kernel releases the interpreter's lock
        runs = [pool.submit(_run, system, state, cycles, begin, NO_TIMES) for state in states]
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


def _run(system, state, cycles, begin, times):
    """One run from checked arguments."""
    samples, tau0 = np.empty((len(times), 8)), float(begin)
    values = state.tolist()
    boxes, balls, phase = tuple(values[0::2]), tuple(values[1::2]), phase_at(begin, system.Omega)
    boxes, balls, rows, status, ledger = kernel.integrate(
        flow_of(system), boxes, balls, phase, cycles, tau0, times, samples
    )
    if status != kernel.FINISHED:
        what = FAILURES[status]
        raise ArithmeticError(f"{what} after {len(rows)} events, tau = {tau0 + (rows[-1, 0] if len(rows) else 0.0)}")
    final = np.empty(8)
    final[0::2], final[1::2] = boxes, balls
    return Run(system, state, begin, cycles, _table(rows, tau0), samples, final, rows, ledger)


def _table(rows, tau0):
    """Rows of the kernel (`event_log`) as a structured array."""
    table = np.empty(len(rows), EVENT)
    table["tau"] = tau0 + rows[:, 0]
    for column, name in enumerate(("module", "wall", "kind"), start=1):
        table[name] = rows[:, column]
    table["state"] = rows[:, 4 : event_log.PHASE]
    return table


def _checked_state(state):
    state = reals("state", state)
    values = state.tolist()
    if state.shape != (8,) or not all(map(math.isfinite, values)):
        raise ValueError(f"state: needs 8 finite numbers [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], got {shown(values)}")
    x1, y1, x2, y2 = values[:4]
    for module, box, ball in ((1, x1, y1), (2, x2, y2)):
        relative = abs(box - ball)
        if relative > 1.0 and relative > 1.0 + ROUNDED + 2.0 * math.ulp(max(abs(box), abs(ball))):
            raise ValueError(f"state: |X{module} - Y{module}| = {relative} is above 1, the ball is beyond a wall")
    return state


def _checked_window(system, cycles, tau0):
    """The start of a run, exactly, and its number of cycles."""
    cycles = whole("cycles", cycles, 0, MOST_CYCLES)
    begin = _instant(tau0)
    start = float(begin)
    for name, tau in (("tau0", start), ("cycles", start + cycles * system.period)):
        if not abs(tau) < LATEST:
            raise ValueError(
                f"{name}: takes the run to tau = {tau}; from 2**43 on floats are more than 1e-3 apart and cannot tell "
                "its times (the forcing is the same whole periods earlier)"
            )
    return begin, cycles


def _instant(tau0):
    """The time that tau0 stands for, exactly."""
    if isinstance(tau0, Instant):
        return tau0
    number = real("tau0", tau0)
    return exactly(tau0) if isinstance(tau0, numbers.Rational) else number


def _checked_times(sample_times, start, end):
    if sample_times is None:
        return NO_TIMES
    times = reals("sample_times", sample_times)
    if times.ndim != 1 or not np.isfinite(times).all() or (np.diff(times) < 0).any():
        raise ValueError("sample_times: needs a one-dimensional ascending array of finite times")
    slack = 4.0 * math.ulp(max(abs(start), abs(end)))
    if len(times) and not (start - slack <= times[0] and times[-1] <= end + slack):
        raise ValueError(f"sample_times: [{times[0]}, {times[-1]}] is not within the run [{start}, {end}]")
    return times
