"""Share code that Numba has compiled for the checkout with copies of the library that have the same content."""

import os
import shutil
from pathlib import Path

from numba.core.caching import _CacheLocator

from programs import run_program

LIBRARY = Path(__file__).parents[2] / "src/vibroimpact"
KEPT = "__pycache__"


def share(library: Path, cache: Path | None = None) -> None:
    """Link existing compiled code of this checkout to the folder in which Numba looks for that of the copy `library`.

    cache: value of NUMBA_CACHE_DIR for the copy; None if Numba uses the folder in the copy.
    """
    for source in LIBRARY.rglob("__init__.py"):
        for folder in (LIBRARY / KEPT).glob("compiled-*"):
            copy = library / source.relative_to(LIBRARY)
            target = cache or library / KEPT / folder.name
            if (code := folder / _subfolder(source)).is_dir() and copy.exists():
                shutil.copytree(code, target / _subfolder(copy), copy_function=_link, dirs_exist_ok=True)


def _link(source, target):
    """Make a hard link, since Numba replaces files but never modifies them; copy to another file system."""
    Path(target).unlink(missing_ok=True)
    try:
        os.link(source, target)
    except OSError:
        shutil.copy2(source, target)


def _subfolder(source):
    """Return the subfolder in which Numba stores compiled code for the package of a source file."""
    return _CacheLocator.get_suitable_cache_subpath(str(source))


COMPILED = """
import pkgutil
from importlib import import_module

import numpy as np
from numba.core.dispatcher import Dispatcher

import vibroimpact as vi
import vibroimpact.compile
from chapter import system_of
from vibroimpact.exact import engine

modules = [import_module(found.name) for found in pkgutil.iter_modules(engine.__path__, f"{engine.__name__}.")]

def signatures():
    functions = {value for module in modules for value in vars(module).values() if isinstance(value, Dispatcher)}
    return {(str(one.py_func), str(types)) for one in functions for types in one.signatures}

def undamped(system):
    return system.with_(gamma1_hat=0, gamma2_hat=0, gamma12_hat=0)

vibroimpact.compile.main()
before = signatures()
system, start = system_of("equal", f10_hat=3.0, f20_hat=3.0, kappa=0.05), [0.0, 0, 0, 0, 0, 0.5, 0, -0.5]
CALLS
print(*sorted(name for name, _ in signatures() - before), sep="\\n")
"""


def compiled_late(calls: str) -> list[str]:
    """Return the engine functions that calls of the library still compile after `vibroimpact.compile` has run.

    calls: Python code that may use vi, np, `system`, `start` and `undamped(system)`.
    """
    run = run_program(COMPILED.replace("CALLS", calls))
    assert run.returncode == 0, run.stderr
    return run.stdout.split()
