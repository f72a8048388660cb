"""Compile the engine and the other integrators into the cache of the checkout, so that the first build need not."""

import pkgutil
from concurrent.futures import ProcessPoolExecutor
from importlib import import_module

import vibroimpact_pipeline  # noqa: F401 (sets the environment, which Numba reads when it is imported)

NAMED = "snakemake.cli", "ipykernel.kernelapp", "matplotlib.backends.backend_pdf", "matplotlib.backends.backend_svg"
"""Modules that jobs import by name, without an import statement."""


def beforehand():
    from vibroimpact.exact.engine.compiled import NOTICE

    NOTICE.beforehand()


def engine():
    """Compile the event loop without a run, since others wait for it; the certificate compiles the tables meanwhile."""
    import numpy as np
    from numba import typeof

    from vibroimpact.exact.engine.event_loop import integrate

    vector, matrix, tables = np.empty(0), np.empty((0, 0)), np.empty((0, 0, 0, 0))
    arguments = vector, tables, matrix, vector, 0.0, 0.0, 0, 0.0, vector, matrix, vector, matrix, vector, vector
    integrate.compile(tuple(map(typeof, arguments)))


def ensembles(system, start):
    """Compile ensembles; after the engine, whose code they use."""
    from vibroimpact.exact.engine.ensemble import ensemble

    ensemble(system, start, cycles=1)


def certificate(system, start):
    """Compile the certificate with a made-up run without events, so that it need not wait for the engine."""
    import numpy as np

    from vibroimpact.exact.engine.motion import ENTRIES, ROW
    from vibroimpact.exact.engine.simulation import Run

    state, samples = np.array(start, dtype=float), np.empty((0, 8))
    run = Run(system, state, 0.0, 1, samples, state, [np.empty((0, ROW))], np.zeros(ENTRIES))
    _ = run.certificate, run.jacobian, run.errors([])


def other_methods(system, start):
    from vibroimpact.integrators import METHODS
    from vibroimpact.integrators.event_driven import Engine

    for method in METHODS:
        if not method.available() and not isinstance(method, Engine):
            method.run(system, start, 1, 0.0, method.settings[0])


def imports(*_):
    """Import all modules of jobs once: Python caches their bytecode, and Matplotlib its list of fonts."""
    import vibroimpact

    library = (module.name for module in pkgutil.walk_packages(vibroimpact.__path__, "vibroimpact."))
    for name in (*library, *NAMED):
        if not name.endswith("__main__"):
            import_module(name)


if __name__ == "__main__":
    from vibroimpact.system import System
    from vibroimpact.system.chapter import CASES, PARAMETERS

    given = System(**PARAMETERS, **CASES["equal"]), [0.0] * 8
    with ProcessPoolExecutor(initializer=beforehand) as pool:
        first, beside_it = pool.submit(engine), pool.submit(certificate, *given)
        first.result()
        for done in [beside_it, *(pool.submit(work, *given) for work in (ensembles, other_methods, imports))]:
            done.result()
