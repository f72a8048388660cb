"""Compile the code of `simulate`, `ensemble` and `Run` before its first use: `python -m vibroimpact.compile`.

The compiled code is cached in the folder NUMBA_CACHE_DIR, if this variable is set. Otherwise, the code is cached in the
folder of the library, in the user's cache folder or in a temporary folder. The first writable one of these is used.
"""

import gc
import sys

from vibroimpact.interrupt import without_traceback


def main() -> None:
    """Compile all code that is not compiled yet."""
    beforehand()
    simulations()
    ensembles()


def beforehand() -> None:
    """Prepare a process that only compiles.

    Print no hint about compiling in advance, and disable garbage collection.
    """
    from vibroimpact.exact.engine.compiled import NOTICE

    NOTICE.hint = ""
    gc.disable()


def simulations() -> None:
    """Compile the code of `simulate`, of `growth`, and of `certificate`, `jacobian`, `energy` and `errors` of a Run."""
    import numpy as np

    from vibroimpact.exact.engine.simulation import simulate
    from vibroimpact.exact.engine.variation import growth

    run = simulate(_system(), [0.0] * 8, cycles=1)
    _ = run.certificate, run.jacobian, run.energy, run.errors([]), growth(run, np.eye(8))


def ensembles() -> None:
    """Compile the code for ensembles; call this function last, since ensembles use all other compiled code."""
    from vibroimpact.exact.lanes.ensemble import ensemble

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
