"""Direct integration of the equations of motion, (10.1) in the form (10.2)."""

import math
from dataclasses import dataclass

import numpy as np

from vibroimpact.exact import events as kernel
from vibroimpact.exact.flow import flow_of
from vibroimpact.system import System

EVENT = np.dtype([("tau", "f8"), ("module", "i1"), ("wall", "i1"), ("kind", "i1"), ("state", "f8", (8,))])
"""One event: time, module 1 or 2, wall +1 or -1, kind (IMPACT, STICK, RELEASE), state just after it."""

IMPACT, STICK, RELEASE = kernel.IMPACT, kernel.STICK, kernel.RELEASE
KINDS = {IMPACT: "impact", STICK: "stick", RELEASE: "release"}


@dataclass(frozen=True)
class Run:
    """A simulated motion.

    events: (m,) structured array (EVENT) in the order of time; samples: (n, 8) states at the sample times, at an event
    the state after it; final: (8,) state at the end. States are [X1, Y1, X2, Y2, X1', Y1', X2', Y2'].
    """

    events: np.ndarray
    samples: np.ndarray
    final: np.ndarray


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
        ArithmeticError: an invariant of the motion broke (a ball went through a wall, or time stood still).
    """
    state = _checked_state(state)
    if isinstance(cycles, bool) or int(cycles) != cycles or cycles < 0:
        raise ValueError(f"cycles: {cycles!r} is not a whole number of at least 0")
    if not math.isfinite(tau0):
        raise ValueError(f"tau0: {tau0!r} is not finite")
    times = _checked_times(sample_times, tau0, tau0 + cycles * system.period)
    samples = np.empty((len(times), 8))
    phase = math.fmod(system.Omega * tau0, kernel.TWO_PI)
    boxes, balls, events, status, _ = kernel.integrate(
        flow_of(system),
        tuple(state[0::2]),
        tuple(state[1::2]),
        phase + kernel.TWO_PI if phase < 0.0 else phase,
        int(cycles),
        times - tau0,
        samples,
    )
    if status == kernel.PENETRATED:
        raise ArithmeticError(f"a ball went through a wall at tau = {tau0 + events[-1, 0] if len(events) else tau0}")
    if status == kernel.STALLED:
        raise ArithmeticError(f"time stands still at tau = {tau0 + events[-1, 0]}")
    final = np.empty(8)
    final[0::2], final[1::2] = boxes, balls
    return Run(_table(events, tau0), samples, final)


def _table(rows, tau0):
    """Rows [time, module, wall, kind, state] as a structured array."""
    table = np.empty(len(rows), EVENT)
    table["tau"] = tau0 + rows[:, 0]
    for column, name in enumerate(("module", "wall", "kind"), start=1):
        table[name] = rows[:, column]
    table["state"] = rows[:, 4:]
    return table


def _checked_state(state):
    state = np.array(state, dtype=float)
    if state.shape != (8,) or not np.isfinite(state).all():
        raise ValueError(f"state: needs 8 finite numbers [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], got {state.tolist()}")
    for module, relative in enumerate((state[0] - state[1], state[2] - state[3]), start=1):
        if abs(relative) > 1.0 + 1e-12:
            raise ValueError(f"state: |X{module} - Y{module}| = {abs(relative)} is above 1, the ball is beyond a wall")
    return state


def _checked_times(sample_times, start, end):
    times = np.array([] if sample_times is None else sample_times, dtype=float)
    if times.ndim != 1 or not np.isfinite(times).all() or (np.diff(times) < 0).any():
        raise ValueError("sample_times: needs a one-dimensional ascending array of finite times")
    slack = 1e-9 * (1.0 + abs(end))
    if len(times) and not (start - slack <= times[0] and times[-1] <= end + slack):
        raise ValueError(f"sample_times: [{times[0]}, {times[-1]}] is not within the run [{start}, {end}]")
    return times
