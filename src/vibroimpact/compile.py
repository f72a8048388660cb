"""Compile the code of simulations, results of runs and ensembles in advance: `python -m vibroimpact.compile`.

Numba caches the code in NUMBA_CACHE_DIR if this is set. Otherwise it uses the first of these folders that is writable:
the folder of the library, the user's cache, a temporary folder.
"""

import gc
import sys

from vibroimpact.interrupt import without_traceback


def main() -> None:
    """Compile all code that is not compiled yet."""
    beforehand()
    for work in (event_loop, certificates, results_of_runs, ensembles):
        work()


def beforehand() -> None:
    """Prepare a process that only compiles: omit the hint to compile in advance, and disable garbage collection."""
    from vibroimpact.exact.engine.compiled import NOTICE

    NOTICE.hint = ""
    gc.disable()


def event_loop() -> None:
    """Compile the event loop without running it."""
    import numpy as np
    from numba import typeof

    from vibroimpact.exact.engine.event_loop import integrate

    vector, matrix, tables = np.empty(0), np.empty((0, 0)), np.empty((0, 0, 0, 0))
    arguments = vector, tables, matrix, vector, vector, matrix, matrix, vector
    integrate.compile(tuple(map(typeof, arguments)))


def certificates() -> None:
    """Compile certificates and Jacobians of runs.

    An artificial run is used, so that the event loop need not be compiled first.
    """
    run = _artificial_run()
    _ = run.certificate, run.jacobian


def results_of_runs() -> None:
    """Compile energies, errors and the growth of perturbations, which are computed from finished runs."""
    import numpy as np

    from vibroimpact.exact.engine.variation import growth

    run = _artificial_run()
    _ = run.energy, run.errors([]), growth(run, np.eye(8))


def ensembles() -> None:
    """Compile ensembles: the code for runs in lanes, and the code for the runs of undamped systems, one by one.

    Call this function last, because ensembles use all other compiled code.
    """
    from vibroimpact.exact.lanes.ensemble import ensemble

    system = _system()
    ensemble(system, [0.0] * 8, cycles=1)
    ensemble(system.with_(gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0), [0.0] * 8, cycles=1, energy=True)


def _artificial_run():
    import numpy as np

    from vibroimpact.exact.engine.contact import ENTRIES, ROW
    from vibroimpact.exact.engine.simulation import Run

    state, final, samples = np.zeros(8), np.zeros(8), np.empty((0, 8))
    return Run(_system(), state, 0.0, 1, samples, final, [np.empty((0, ROW))], np.zeros(ENTRIES))


def _system():
    from vibroimpact.system import System
    from vibroimpact.system.chapter import CASES, PARAMETERS

    return System(**PARAMETERS, **CASES["equal"])


if __name__ == "__main__":
    with without_traceback():
        sys.exit(main())
