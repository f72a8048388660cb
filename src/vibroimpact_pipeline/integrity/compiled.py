"""Compiled code that cannot be trusted: cut off by a power cut, or made of sources that were being changed."""

import os
import shutil
from contextlib import suppress
from pathlib import Path

KEPT = ".cache/numba"
"""Where compiled code is kept, in a folder for each state of its sources."""


def discard() -> None:
    """Drop what is kept for these sources, unless somebody else has said where to keep it."""
    if (folder := _folder()).match(f"{KEPT}/*"):
        shutil.rmtree(folder, ignore_errors=True)


def drop_empty() -> None:
    """A power cut may leave files without their content, over which Numba would stumble, then and ever after."""
    for path in _folder().rglob("*.nb[ci]"):
        with suppress(FileNotFoundError):  # another build has been faster
            if not path.stat().st_size:
                path.unlink()


def _folder():
    return Path(os.environ["NUMBA_CACHE_DIR"])
