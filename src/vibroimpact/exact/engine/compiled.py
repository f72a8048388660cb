"""Decorators that compile the inner loops with Numba, cache them on disk and release the interpreter lock.

Rounding: in a step of a run, the compiler must not combine or reorder floating-point operations. A formula then gives
the same bits in a single run and in an ensemble (several runs that advance together in vector instructions). The
decorator `compiled` is an exception. In its functions, and in `inlined_source` functions that they call, the compiler
may fuse a product and a sum into one operation with a single rounding.

Inlining: functions that run at every event are inlined. Passing a motion and its Taylor polynomials (about 30 numbers)
as arguments would cost more than the computation. Most functions with a single caller are decorated by
`inlined_source`. Numba then compiles them only as a part of their caller.

Reference counting: only `compiled` functions, and `inlined_source` functions that they call, create or return arrays.
In all other functions, Numba does not count references to arrays, because counting would only cost time.

Each decorator sets the options for fastmath, inlining and reference counting. If an option were missing, Numba would
take the option of the caller that is compiled first.

The cache key depends on all source files that may be compiled into a function. Numba itself checks only the file of the
function. If NUMBA_CACHE_DIR is set, only Numba's check is done. In this case, clear the cache after every change of the
sources.
"""

import hashlib
import os
import sys
import tempfile
from functools import cache, partial
from pathlib import Path

from numba import config, njit
from numba.core import event


class _Notice(event.Listener):
    """Listener that prints a line before Numba first compiles code of the package."""

    def __init__(self):
        self.printed, self.hint = False, "; to do this in advance, run python -m vibroimpact.compile"

    def on_start(self, compilation):
        module = compilation.data["dispatcher"].py_func.__module__ or ""
        if not self.printed and module.startswith("vibroimpact.exact."):
            self.printed = True
            say(f"compiling the simulation (up to a minute), needed only once{self.hint}")

    def on_end(self, compilation):
        pass


def say(words: str) -> None:
    """Print one line on standard error."""
    print(f"vibroimpact: {words}", file=sys.stderr, flush=True)


NOTICE = _Notice()
event.register("numba:compile", NOTICE)


PACKAGE = Path(__file__).parents[2]
LIBRARY_CACHE = PACKAGE / "__pycache__"
SHARED_FOLDERS = ("system", "exact/engine")


def disk_cached(**options):
    """Return a decorator like Numba's `njit` that caches the compiled code in the folder from `code_folder`."""

    def decorate(function):
        folder, before = code_folder(Path(function.__code__.co_filename).parent), config.CACHE_DIR
        config.CACHE_DIR = str(folder or before)  # the old value is restored below for other packages
        try:
            return njit(cache=True, **options)(function)
        finally:
            config.CACHE_DIR = before

    return decorate


@cache
def code_folder(package: Path) -> Path | None:
    """Return the cache folder for a package, or None if NUMBA_CACHE_DIR is set.

    The name of the folder contains a hash of all source files that may be compiled into functions of the package.
    """
    if config.CACHE_DIR:
        return None
    files = {path for folder in (*(PACKAGE / name for name in SHARED_FOLDERS), package) for path in folder.glob("*.py")}
    digest = hashlib.sha256()
    for path in sorted(files):
        digest.update(path.name.encode() + path.read_bytes())
    return _writable() / f"compiled-{digest.hexdigest()[:16]}"


@cache
def _writable() -> Path:
    """Return the first writable folder: `LIBRARY_CACHE`, a folder in the user's cache, or a new temporary folder."""
    own = Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"))
    for folder in (LIBRARY_CACHE, own / "vibroimpact"):
        if folder.is_absolute() and _takes_files(folder):  # "~/.cache" is relative if the home is unknown
            return folder
    NOTICE.hint = ""
    say(f"neither the installation nor {own} is writable, so every process compiles; set XDG_CACHE_HOME to a folder")
    return Path(tempfile.mkdtemp(prefix="vibroimpact-"))


def _takes_files(folder):
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError:
        return False
    return True


_cached = partial(disk_cached, error_model="numpy", nogil=True, no_cfunc_wrapper=True)
_without_allocation = partial(_cached, _nrt=False, fastmath=False)
compiled = _cached(fastmath={"contract"}, forceinline=False, _nrt=True)
in_place = _without_allocation(forceinline=False, no_cpython_wrapper=True)
inlined = _without_allocation(forceinline=True)
inlined_source = _without_allocation(forceinline=True, inline="always")
