"""Compile simulations, all that is computed from runs, and ensembles beforehand: `python -m vibroimpact.compile`.

Numba keeps the code beside the library, else in the user's cache, else in a temporary folder; or in NUMBA_CACHE_DIR.
"""

import sys

from vibroimpact.interrupt import without_traceback


def main() -> None:
    """Compile all that is not compiled yet."""
    from vibroimpact.exact.engine.compiled import NOTICE

    NOTICE.beforehand()
    for work in (event_loop, results_of_runs, ensembles):
        work()


def event_loop() -> None:
    """Compile the event loop, without a run."""
    import numpy as np
    from numba import typeof

    from vibroimpact.exact.engine.event_loop import integrate

    vector, matrix, tables = np.empty(0), np.empty((0, 0)), np.empty((0, 0, 0, 0))
    arguments = vector, tables, matrix, vector, 0.0, 0.0, 0, 0.0, vector, matrix, vector, matrix, vector, vector
    integrate.compile(tuple(map(typeof, arguments)))


def results_of_runs() -> None:
    """Compile what is computed from runs with one that is made up, so that it need not wait for the event loop."""
    import numpy as np

    from vibroimpact.exact.engine.motion import ENTRIES, ROW
    from vibroimpact.exact.engine.simulation import Run
    from vibroimpact.exact.engine.variation import growth

    state, final, samples = np.zeros(8), np.zeros(8), np.empty((0, 8))
    run = Run(_system(), state, 0.0, 1, samples, final, [np.empty((0, ROW))], np.zeros(ENTRIES))
    _ = run.certificate, run.jacobian, run.energy, run.errors([]), growth(run, np.eye(8))


def ensembles() -> None:
    """Compile ensembles, in lanes and, as undamped systems need them, run by run; after all else, which they use."""
    from vibroimpact.exact.engine.ensemble import ensemble

    system = _system()
    ensemble(system, [0.0] * 8, cycles=1)
    ensemble(system.with_(gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0), [0.0] * 8, cycles=1, energy=True)


def _system():
    from vibroimpact.system import System
    from vibroimpact.system.chapter import CASES, PARAMETERS

    return System(**PARAMETERS, **CASES["equal"])


if __name__ == "__main__":
    with without_traceback():
        sys.exit(main())
