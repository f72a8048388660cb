"""Compile simulations, all that is asked of runs, and ensembles beforehand: `python -m vibroimpact.compile`.

Numba keeps the code beside the library, else in the user's cache, else in a temporary folder; or in NUMBA_CACHE_DIR.
"""

import numpy as np

from vibroimpact.exact.engine.compiled import NOTICE
from vibroimpact.exact.engine.ensemble import ensemble
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.engine.variation import growth
from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS


def main() -> None:
    """Compile all that is not compiled yet."""
    NOTICE.beforehand()
    system, rest = System(**PARAMETERS, **CASES["equal"]), [0.0] * 8
    run = simulate(system, rest, cycles=1)
    _ = (
        run.certificate,
        run.jacobian,
        run.errors([]),
        run.energy,
        growth(run, np.eye(8)),
        ensemble(system, rest, cycles=1),
    )


if __name__ == "__main__":
    main()
