"""Timing by repetition: the minimum is the time without the disturbances of a shared machine."""

import platform
import time
from importlib.metadata import PackageNotFoundError, version

PACKAGES = "vibroimpact", "numpy", "scipy", "numba", "heyoka", "python-flint"


def timed(work, seconds: float, most: int = 5000) -> tuple:
    """What `work` gives, and the seconds of the fastest of several calls of it.

    There are as many as fit in `seconds`, at least one and at most `most`. Whatever is done only once (compilation,
    tables) must have been done by a call before.
    """
    best, spent, calls = float("inf"), 0.0, 0
    while calls == 0 or (spent < seconds and calls < most):
        start = time.perf_counter()
        given = work()
        elapsed = time.perf_counter() - start
        best, spent, calls = min(best, elapsed), spent + elapsed, calls + 1
    return given, best


def shortest_time(work, seconds: float, most: int = 5000) -> float:
    """The seconds of `timed`."""
    return timed(work, seconds, most)[1]


def versions() -> dict[str, str]:
    """What was measured: Python, the processor's architecture, and the packages that are installed."""
    found = {"python": platform.python_version(), "machine": platform.machine()}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "absent"
    return found
