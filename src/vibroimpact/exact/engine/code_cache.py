"""Where compiled code is kept.

Code is kept apart by the content of all that may be compiled into it, since Numba itself looks at the file of a
function, not at those of the functions it calls, and would go on using the code of a version that is no longer
installed. With NUMBA_CACHE_DIR set, the user handles this.

Each file ends with a sum of its content, which is checked before Numba reads it: Numba would run a damaged one.
"""

import hashlib
import os
import tempfile
from contextlib import contextmanager
from functools import cache
from io import BytesIO
from pathlib import Path

from numba import config, njit
from numba.core import caching

from vibroimpact.exact.engine.compile_notice import say

PACKAGE = Path(__file__).parents[2]
SHARED = ("system", "exact/engine")


def kept(**options):
    """Numba's `njit` for a function whose code is kept on disk."""

    def decorate(function):
        with _numba_keeping_sound_code_in(code_folder(Path(function.__code__.co_filename).parent)):
            return njit(cache=True, **options)(function)

    return decorate


@cache
def code_folder(package: Path) -> Path | None:
    """The folder for the code of a package; None where NUMBA_CACHE_DIR says it."""
    return None if config.CACHE_DIR else _writable() / f"compiled-{_fingerprint(package)}"


@contextmanager
def _numba_keeping_sound_code_in(folder):
    """Numba reads both settings when a function is decorated; functions of others keep theirs."""
    before = config.CACHE_DIR, caching.IndexDataCacheFile
    config.CACHE_DIR, caching.IndexDataCacheFile = str(folder or config.CACHE_DIR), SummedFiles
    try:
        yield
    finally:
        config.CACHE_DIR, caching.IndexDataCacheFile = before


class SummedFiles(caching.IndexDataCacheFile):
    """Numba's files of a function: an index and one for each signature, each ending with the SHA-256 of its content.

    Numba ignores what comes after the content. A file that it does not find is compiled anew.
    """

    def _load_index(self):
        _remove_if_damaged(self._index_path)
        return super()._load_index()

    def _load_data(self, name):
        _remove_if_damaged(self._data_path(name))
        return super()._load_data(name)

    @contextmanager
    def _open_for_write(self, filepath):
        content = BytesIO()
        yield content
        with super()._open_for_write(filepath) as file:
            file.write(content.getvalue() + _sum(content.getvalue()))


def _remove_if_damaged(path):
    try:
        content = Path(path).read_bytes()
    except FileNotFoundError:
        return
    size = len(content) - len(_sum(b""))
    if content[size:] != _sum(content[:size]):
        Path(path).unlink(missing_ok=True)
        say(f"{path} is damaged: removed, what it held is compiled anew")


def _sum(content):
    return hashlib.sha256(content).digest()


@cache
def _fingerprint(package):
    """Hash of all sources that a function of this package may be compiled from."""
    files = {path for folder in (*(PACKAGE / name for name in SHARED), package) for path in folder.glob("*.py")}
    digest = hashlib.sha256()
    for path in sorted(files):
        digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()[:16]


@cache
def _writable() -> Path:
    """Beside the library, else in the user's own cache, else a private temporary folder, which is said."""
    own = Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"))
    for folder in (PACKAGE / "__pycache__", own / "vibroimpact"):
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
    """The same for all processes of this user, unless somebody else might write to it: code in it is run."""
    folder = Path(tempfile.gettempdir(), f"vibroimpact-{os.getuid()}")
    folder.mkdir(mode=0o700, exist_ok=True)
    state = folder.lstat()
    private = folder.is_dir() and not folder.is_symlink() and state.st_uid == os.getuid() and not state.st_mode & 0o022
    return folder if private else Path(tempfile.mkdtemp(prefix="vibroimpact-"))
