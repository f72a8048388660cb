"""Compiled code that cannot be trusted: cut off by a power cut, or made of sources that were being changed."""

import os
import shutil
from contextlib import suppress
from pathlib import Path

KEPT = ".cache/numba"
"""Where compiled code is kept, in a folder for each state of its sources."""


def discard(*places: Path) -> None:
    """Drop what is kept for these sources below one of some directories; elsewhere it is somebody else's."""
    if (folder := _folder()).parent in [place / KEPT for place in places]:
        shutil.rmtree(folder, ignore_errors=True)


def drop_empty() -> None:
    """A power cut may leave files without their content, over which Numba would stumble, then and ever after."""
    for path in _folder().rglob("*.nb[ci]"):
        with suppress(FileNotFoundError):  # another build has been faster
            if not path.stat().st_size:
                path.unlink()


def _folder():
    return Path(os.environ["NUMBA_CACHE_DIR"])
