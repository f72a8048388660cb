"""Compile the simulation and what its certificates need beforehand: `python -m vibroimpact.compile`.

Numba keeps the code beside the library, else in the user's cache, else in a temporary folder; or in NUMBA_CACHE_DIR.
"""

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS


def main() -> None:
    """Compile all that is not compiled yet."""
    run = simulate(System(**PARAMETERS, **CASES["equal"]), [0.0] * 8, cycles=1)
    _ = run.certificate, run.jacobian


if __name__ == "__main__":
    main()
