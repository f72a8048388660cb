"""Compiled code that cannot be trusted: cut off by a power cut, or made of sources that were being changed."""

import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from vibroimpact_pipeline.integrity.stamps import Changed, Stamp, unchanged

KEPT = ".cache/numba"
"""Where compiled code is kept, in a folder for each state of its sources."""


@contextmanager
def from_unchanged(sources: Mapping[str, Stamp], *places: Path) -> Iterator[None]:
    """See that sources are what their stamps say, at the start and at the end; else nobody knows what was compiled.

    It is dropped then, if it is kept below one of some directories; elsewhere it is somebody else's.

    Raises:
        Changed: a source is not.
    """
    try:
        with unchanged(sources):
            yield
    except Changed:
        if (folder := _folder()).parent in [place / KEPT for place in places]:
            shutil.rmtree(folder, ignore_errors=True)
        raise


def drop_empty() -> None:
    """A power cut may leave files without their content, over which Numba would stumble, then and ever after."""
    for path in _folder().rglob("*.nb[ci]"):
        with suppress(FileNotFoundError):  # another build has been faster
            if not path.stat().st_size:
                path.unlink()


def _folder():
    return Path(os.environ["NUMBA_CACHE_DIR"])
