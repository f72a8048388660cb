"""Compile the functions of the default build into the cache; other functions are compiled on first use."""

import pkgutil
from concurrent.futures import ProcessPoolExecutor
from importlib import import_module

import vibroimpact_pipeline  # noqa: F401 (sets the environment, which Numba reads when it is imported)

from vibroimpact.compile import beforehand, simulations

NAMED = "snakemake.cli", "ipykernel.kernelapp", "matplotlib.backends.backend_pdf", "matplotlib.backends.backend_svg"
"""Modules that jobs need although no module of the library imports them."""


def other_methods():
    """Run each available method except the event-driven engine once, so that the code of the method is compiled."""
    from vibroimpact.integrators import METHODS
    from vibroimpact.integrators.event_driven import Engine
    from vibroimpact.system import System
    from vibroimpact.system.chapter import CASES, PARAMETERS

    system, start = System(**PARAMETERS, **CASES["equal"]), [0.0] * 8
    for method in METHODS:
        if not method.available() and not isinstance(method, Engine):
            method.run(system, start, 1, 0.0, method.settings[0])


def imports():
    """Import all modules that jobs need, so that Python caches bytecode and Matplotlib caches its list of fonts."""
    import vibroimpact

    library = (module.name for module in pkgutil.walk_packages(vibroimpact.__path__, "vibroimpact."))
    for name in (*library, *NAMED):
        if not name.endswith("__main__"):
            import_module(name)


if __name__ == "__main__":
    with ProcessPoolExecutor(2, initializer=beforehand) as pool:
        for done in [pool.submit(work) for work in (simulations, other_methods, imports)]:
            done.result()
