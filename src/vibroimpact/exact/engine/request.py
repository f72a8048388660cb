"""What a run is asked for, checked."""

import math
import numbers

import numpy as np

from vibroimpact.exact.engine.phase import Instant, exactly
from vibroimpact.system.arguments import real, reals, shown, whole

NO_TIMES = np.empty(0)
LATEST = 2.0**43
"""From here on floats are further apart than 1e-3, and times of a run cannot be told."""
MOST_CYCLES = 10_000_000
"""Of one run, which holds all its events: a kilobyte or so for a cycle."""
ROUNDED = 1e-12
"""So far beyond a wall (and by the rounding of the positions) a ball may start: it is put on the wall."""


def checked_state(state) -> np.ndarray:
    """A start (8,), the balls between their walls.

    Raises:
        ValueError: it is none.
    """
    state = reals("state", state)
    values = state.tolist()
    if state.shape != (8,):
        raise ValueError(f"state: needs shape (8,), got {state.shape}")
    if not all(map(math.isfinite, values)):
        raise ValueError(f"state: needs 8 finite numbers [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], got {shown(values)}")
    x1, y1, x2, y2 = values[:4]
    if abs(x1 - y1) > 1.0 or abs(x2 - y2) > 1.0:
        _check_walls((1, x1, y1), (2, x2, y2))
    return state


def _check_walls(*modules):
    for module, box, ball in modules:
        relative = abs(box - ball)
        if relative > 1.0 + ROUNDED + 2.0 * math.ulp(max(abs(box), abs(ball))):
            raise ValueError(f"state: |X{module} - Y{module}| = {relative} is above 1, the ball is beyond a wall")


def within_walls(states) -> np.ndarray:
    """For starts (n, 8) whether each is one that `checked_state` accepts, (n,)."""
    boxes, balls = states[:, [0, 2]], states[:, [1, 3]]
    with np.errstate(invalid="ignore", over="ignore"):
        slack = ROUNDED + 2.0 * np.spacing(np.maximum(abs(boxes), abs(balls)))
        inside = abs(boxes - balls) <= 1.0 + slack
    return inside.all(axis=1) & np.isfinite(states).all(axis=1)


def checked_window(system, cycles, tau0) -> tuple[float | Instant, int]:
    """The start of a run, exactly, and its number of cycles.

    Raises:
        ValueError: one of them is malformed, or the run leaves the range of times.
    """
    cycles = whole("cycles", cycles, 0, MOST_CYCLES)
    begin = _instant(tau0)
    start = float(begin)
    end = start + cycles * system.period
    if not (abs(start) < LATEST and abs(end) < LATEST):
        name, tau = ("cycles", end) if abs(start) < LATEST else ("tau0", start)
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
    return exactly(tau0) if not isinstance(tau0, float) and isinstance(tau0, numbers.Rational) else number


def checked_times(name, times, start, end) -> np.ndarray:
    """Sample times (n,) of a run from start to end.

    Raises:
        ValueError: they are not ascending, not finite or not within the run.
    """
    times = reals(name, times)
    if times.ndim != 1 or not np.isfinite(times).all() or (np.diff(times) < 0).any():
        raise ValueError(f"{name}: needs a one-dimensional ascending array of finite times")
    slack = 4.0 * math.ulp(max(abs(start), abs(end)))
    if len(times) and not (start - slack <= times[0] and times[-1] <= end + slack):
        raise ValueError(f"{name}: [{times[0]}, {times[-1]}] is not within the run [{start}, {end}]")
    return times
