"""Compile the engine and the other integrators into the cache of the checkout, so that the first build need not."""

import pkgutil
from concurrent.futures import ProcessPoolExecutor
from importlib import import_module

import vibroimpact_pipeline  # noqa: F401 (sets the environment, which Numba reads when it is imported)
from vibroimpact.compile import ensembles, event_loop, results_of_runs

NAMED = "snakemake.cli", "ipykernel.kernelapp", "matplotlib.backends.backend_pdf", "matplotlib.backends.backend_svg"
"""Modules that jobs import by name, without an import statement."""


def beforehand():
    from vibroimpact.exact.engine.compiled import NOTICE

    NOTICE.beforehand()


def other_methods():
    from vibroimpact.integrators import METHODS
    from vibroimpact.integrators.event_driven import Engine
    from vibroimpact.system import System
    from vibroimpact.system.chapter import CASES, PARAMETERS

    system, start = System(**PARAMETERS, **CASES["equal"]), [0.0] * 8
    for method in METHODS:
        if not method.available() and not isinstance(method, Engine):
            method.run(system, start, 1, 0.0, method.settings[0])


def imports():
    """Import all modules of jobs once: Python caches their bytecode, and Matplotlib its list of fonts."""
    import vibroimpact

    library = (module.name for module in pkgutil.walk_packages(vibroimpact.__path__, "vibroimpact."))
    for name in (*library, *NAMED):
        if not name.endswith("__main__"):
            import_module(name)


if __name__ == "__main__":
    with ProcessPoolExecutor(initializer=beforehand) as pool:
        first, beside_it = pool.submit(event_loop), pool.submit(results_of_runs)  # others wait for them
        first.result()
        for done in [beside_it, *(pool.submit(work) for work in (ensembles, other_methods, imports))]:
            done.result()
