"""Compile the code of simulations, results of runs and ensembles in advance: `python -m vibroimpact.compile`.

Numba caches the code in NUMBA_CACHE_DIR if this is set. Otherwise it uses the first of these folders that is writable:
the folder of the library, the user's cache, a temporary folder.
"""

import gc
import sys

import numpy as np
from numba import typeof

from vibroimpact.exact.engine.compiled import NOTICE
from vibroimpact.exact.engine.contact import ENTRIES, ROW
from vibroimpact.exact.engine.event_loop import integrate
from vibroimpact.exact.engine.simulation import Run
from vibroimpact.exact.engine.variation import growth
from vibroimpact.exact.lanes.ensemble import ensemble
from vibroimpact.interrupt import without_traceback
from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS

SYSTEM = System(**PARAMETERS, **CASES["equal"])


def main() -> None:
    """Compile all code that is not compiled yet."""
    beforehand()
    event_loop()
    run = certificates()
    _ = run.energy, run.errors([]), growth(run, np.eye(8))
    # Ensembles come last, because they use all other compiled code. Runs of undamped systems are not computed in lanes.
    undamped = SYSTEM.with_(gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0)
    ensemble(SYSTEM, [0.0] * 8, cycles=1)
    ensemble(undamped, [0.0] * 8, cycles=1, energy=True)


def beforehand() -> None:
    """Prepare a process that only compiles: omit the hint to compile in advance, and disable garbage collection."""
    NOTICE.hint = ""
    gc.disable()


def event_loop() -> None:
    """Compile the event loop without running it."""
    vector, matrix, tables = np.empty(0), np.empty((0, 0)), np.empty((0, 0, 0, 0))
    arguments = vector, tables, matrix, vector, vector, matrix, matrix, vector
    integrate.compile(tuple(map(typeof, arguments)))


def certificates() -> Run:
    """Compile certificates and Jacobians of runs; return an artificial run, for which no event loop is needed."""
    state, final, samples = np.zeros(8), np.zeros(8), np.empty((0, 8))
    run = Run(SYSTEM, state, 0.0, 1, samples, final, [np.empty((0, ROW))], np.zeros(ENTRIES))
    _ = run.certificate, run.jacobian
    return run


if __name__ == "__main__":
    with without_traceback():
        sys.exit(main())
