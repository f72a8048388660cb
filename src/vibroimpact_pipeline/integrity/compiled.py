"""Compiled code that cannot be trusted: cut off by a power cut, or made of sources that were being changed."""

import json
import os
import platform
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from vibroimpact.figures.kit.files import replacing
from vibroimpact_pipeline.integrity.stamps import Changed, Stamp, same, unchanged

KEPT = ".cache/numba"
"""Where compiled code is kept, in a folder for each state of its sources."""
NOTE = "*.compiling.json"
"""What a process leaves in the folder while it runs: the stamps of its sources."""


@contextmanager
def from_unchanged(sources: Mapping[str, Stamp], *places: Path) -> Iterator[None]:
    """See that sources are what their stamps say, at the start and at the end; else nobody knows what was compiled.

    It is dropped then, if it is kept below one of some directories; elsewhere it is somebody else's.

    Raises:
        Changed: a source is not.
    """
    if not _kept_in(places):
        with unchanged(sources):
            yield
        return
    note = _folder() / NOTE.replace("*", f"{platform.node()}-{os.getpid()}")
    with replacing(note) as partial:
        partial.write_text(json.dumps(sources), encoding="utf-8")
    try:
        with unchanged(sources):
            yield
    except Changed:
        shutil.rmtree(_folder(), ignore_errors=True)
        raise
    finally:
        note.unlink(missing_ok=True)


def drop_untrusted(*places: Path) -> None:
    """Drop what a process was compiling that did not live to see its sources changed, and files without content.

    Over such files, which a power cut may leave, Numba would stumble, then and ever after. What is kept elsewhere than
    below one of some directories is left alone.
    """
    if not _kept_in(places):
        return
    if not all(_still_true(note) for note in _folder().glob(NOTE)):
        shutil.rmtree(_folder(), ignore_errors=True)
    for path in _folder().rglob("*.nb[ci]"):
        with suppress(FileNotFoundError):  # another build has been faster
            if not path.stat().st_size:
                path.unlink()


def _still_true(note):
    try:
        return same(json.loads(note.read_text(encoding="utf-8")))
    except FileNotFoundError:  # its process has just ended
        return True
    except ValueError:
        return False


def _kept_in(places):
    """Whether compiled code is kept where the pipeline keeps it, by whichever way one gets there."""
    return _folder().parent.resolve() in [(place / KEPT).resolve() for place in places]


def _folder():
    return Path(os.environ["NUMBA_CACHE_DIR"])
