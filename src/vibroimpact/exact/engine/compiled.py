"""Compilation of the inner loops with Numba, cached on disk, without the interpreter's lock.

What a step of a run is computed by is rounded as it is written, so that the run has the same bits alone and in a lane
beside others (`lanes`). What is `compiled`, and what is `inlined_source` there, may round product and sum as one.

What runs at every event becomes part of the loop: handing over a motion and its Taylor polynomials (some 30 numbers)
would cost more than what is computed from them. What is called from one place is mostly put there before anything is
compiled (`inlined_source`), which spares compiling it twice; the rest is compiled once and then inlined. Each says how
it rounds, whether it is inlined, and whether it counts, since Numba takes what is left open from the caller that is
compiled first.

Only what is `compiled` makes arrays or gives them back, and what is `inlined_source` there alone. All else works in
memory that is given, and counts no references to it: a count is a locked operation and a call, for which all numbers at
hand are put away.

Compiled code is kept by the content of all sources that may be compiled into it: Numba looks at the file of a function,
not at those of the functions it calls. With NUMBA_CACHE_DIR set, the user handles invalidation.
"""

import hashlib
import os
import shutil
import sys
import tempfile
from contextlib import contextmanager
from functools import cache, partial
from pathlib import Path

from numba import config, njit
from numba.core import event

SIMULATION = "the simulation, some 15 s"
ON_DEMAND = "what certificates, energies and Jacobians of runs need, some 10 s"
ENSEMBLE = "the simulation of ensembles, some 25 s"
APART = {"flow_tables": SIMULATION, "event_loop": SIMULATION, "ensemble": ENSEMBLE}
"""Groups of code compiled separately, by the modules that start them, with their duration."""


class _Notice(event.Listener):
    """Listener to every compilation of Numba that prints a line before a long one."""

    def __init__(self):
        self.within, self.said, self.hint = 0, set(), " (python -m vibroimpact.compile does it beforehand)"

    def beforehand(self) -> None:
        """Drop the hint, for a user who compiles on purpose."""
        self.hint = ""

    def on_start(self, compilation):
        module = compilation.data["dispatcher"].py_func.__module__ or ""
        what = APART.get(module.removeprefix(f"{__package__}."), ON_DEMAND)
        if not self.within and module.startswith(__package__) and what not in self.said:
            self.said.add(what)
            say(f"compiling {what}, once{self.hint}")
        self.within += 1

    def on_end(self, compilation):
        self.within -= 1


def say(words: str) -> None:
    """Print one line on standard error."""
    print(f"vibroimpact: {words}", file=sys.stderr, flush=True)


NOTICE = _Notice()
event.register("numba:compile", NOTICE)


PACKAGE = Path(__file__).parents[2]
BESIDE = PACKAGE / "__pycache__"
SHARED = ("system", "exact/engine")


def disk_cached(**options):
    """Return Numba's `njit` for a function whose compiled code is cached on disk."""

    def decorate(function):
        with _numba_caching_in(code_folder(Path(function.__code__.co_filename).parent)):
            return njit(cache=True, **options)(function)

    return decorate


@cache
def code_folder(package: Path) -> Path | None:
    """Return the cache folder for a package; None if NUMBA_CACHE_DIR gives one.

    Numba uses no folder that it cannot write to: what was compiled beside a library that is read-only by now is copied.
    """
    if config.CACHE_DIR:
        return None
    name = f"compiled-{_fingerprint(package)}"
    folder, installed = _writable() / name, BESIDE / name
    if installed.is_dir() and not folder.exists():
        _copy(installed, folder)
    return folder


def _copy(code, folder):
    """Copy compiled code as a whole, since other processes may read it, or be about to copy the same."""
    try:
        with tempfile.TemporaryDirectory(dir=folder.parent, prefix=".copy-") as part:
            for file in code.glob("*/*"):
                copy = Path(part, folder.name, file.relative_to(code))
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, copy)
            Path(part, folder.name).rename(folder)
    except OSError:  # another process was first, or there is no room: it is compiled again
        pass


@contextmanager
def _numba_caching_in(folder):
    """Set Numba's cache folder while a function is decorated; functions of other packages keep theirs."""
    before = config.CACHE_DIR
    config.CACHE_DIR = str(folder or before)
    try:
        yield
    finally:
        config.CACHE_DIR = before


@cache
def _fingerprint(package):
    """Return a hash of all sources that a function of this package may be compiled from."""
    files = {path for folder in (*(PACKAGE / name for name in SHARED), package) for path in folder.glob("*.py")}
    digest = hashlib.sha256()
    for path in sorted(files):
        digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()[:16]


@cache
def _writable() -> Path:
    """Return the first writable folder: beside the library, in the user's cache, or a private temporary one, which is
    reported.
    """
    own = Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"))
    for folder in (BESIDE, own / "vibroimpact"):
        if folder.is_absolute() and _takes_files(folder):  # "~" stays where nobody knows the home
            return folder
    folder = _temporary()
    say(f"neither the installation nor {own} can be written to; compiled code is kept in {folder}")
    return folder


def _takes_files(folder):
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError:
        return False
    return True


def _temporary():
    """Return one folder for all processes of this user, or a new one if others could write to it: code in it is run."""
    folder = Path(tempfile.gettempdir(), f"vibroimpact-{os.getuid()}")
    folder.mkdir(mode=0o700, exist_ok=True)
    state = folder.lstat()
    private = folder.is_dir() and not folder.is_symlink() and state.st_uid == os.getuid() and not state.st_mode & 0o022
    return folder if private else Path(tempfile.mkdtemp(prefix="vibroimpact-"))


_alike = partial(disk_cached, error_model="numpy", nogil=True, no_cfunc_wrapper=True)
_given_memory = partial(_alike, _nrt=False, fastmath=False)
compiled = _alike(fastmath={"contract"}, forceinline=False, _nrt=True)
in_place = _given_memory(forceinline=False, no_cpython_wrapper=True)
inlined = _given_memory(forceinline=True)
inlined_source = _given_memory(forceinline=True, inline="always")
