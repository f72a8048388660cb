"""Has a file been changed meanwhile? Who goes on for minutes with what a file says asks before and after."""

import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager

Stamp = list[int]
"""Size of a file in bytes, and the times in ns at which its content and the file itself were last changed.

Putting an older version back gives it a new time of the last kind, whatever becomes of the other.
"""


class Changed(RuntimeError):
    """Something was changed that must stay as it is until all that depends on it is made."""


def stamp(path) -> Stamp:
    """The stamp of a file.

    Raises:
        OSError: there is no such file.
    """
    state = os.stat(path)
    return [state.st_size, state.st_mtime_ns, state.st_ctime_ns]


def stamps(paths: Iterable) -> dict[str, Stamp]:
    """The stamps of files, by their paths."""
    return {str(path): stamp(path) for path in paths}


@contextmanager
def unchanged(known: Mapping[str, Stamp]) -> Iterator[None]:
    """See that files are what their stamps say, at the start and at the end.

    Raises:
        Changed: one of them is not.
    """
    _compare(known)
    try:
        yield
    finally:
        _compare(known)


def same(known: Mapping[str, Stamp]) -> bool:
    """Whether files are what their stamps say."""
    return not _changed(known)


def _compare(known):
    if changed := _changed(known):
        raise Changed(f"{', '.join(changed)}: changed while this was built. Build again.")


def _changed(known):
    return sorted(os.path.relpath(path) for path, before in known.items() if _now(path) != before)


def _now(path):
    try:
        return stamp(path)
    except OSError:
        return None
