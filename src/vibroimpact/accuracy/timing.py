"""Measure the run time of a function as the shortest time of several calls.

Other work on the machine disturbs the shortest call least.
"""

import platform
import time
from importlib.metadata import distributions

PACKAGES = "vibroimpact", "numpy", "scipy", "numba", "heyoka", "python-flint"
MOST_CALLS = 5000


def interleaved(functions, seconds: float) -> list[tuple]:
    """Return the result and the shortest time [s] of each function.

    The functions are called in turn, so that a disturbance of the machine affects all of them. All code must already
    be compiled.

    seconds: total time [s] of the repeated calls of each function.
    """
    given, best = [None] * len(functions), [float("inf")] * len(functions)
    total, calls, left = [0.0] * len(functions), [0] * len(functions), list(range(len(functions)))
    while left:
        for n in left:
            start = time.perf_counter()
            given[n] = functions[n]()
            elapsed = time.perf_counter() - start
            best[n], total[n], calls[n] = min(best[n], elapsed), total[n] + elapsed, calls[n] + 1
        left = [n for n in left if total[n] < seconds and calls[n] < MOST_CALLS]
    return list(zip(given, best, strict=True))


def versions() -> dict[str, str]:
    """Return what a measurement depends on: the versions of Python and packages, and the processor architecture."""
    installed = {one.name: one.version for one in distributions()}
    found = {name: installed[name] for name in PACKAGES if name in installed}
    return {"python": platform.python_version(), "machine": platform.machine()} | found
