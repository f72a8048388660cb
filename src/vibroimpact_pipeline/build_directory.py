"""The directory that a build works in: one build at a time, which can write there and clears away what others left."""

import errno
import fcntl
import hashlib
import os
import shutil
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path
from tempfile import TemporaryFile, gettempdir
from typing import TextIO

from vibroimpact_pipeline.environment import SCRATCH

OWN = (".cache", ".snakemake", "results")
"""Folders that a build writes to; those that are not there yet, it makes."""
WITHOUT_LOCKS = (errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP)
"""What a file system says that has no locks, as some over a network."""
WITHOUT = "Builds of this directory on other machines are not waited for: start none meanwhile."
MENDED_BY = "Results, records and locks come into the working directory: see that it can be written to and that its \
disk has room, or build in another one, with --directory."
LITTER = ("results/**/.*.partial", ".snakemake/scripts/tmp*", ".cache/labels.json.*")
"""What a process leaves behind that was killed while it wrote, in folders where a build is alone."""
SHARED_LITTER = (".cache/numba/*/**/*.tmp.*", ".cache/numba/*.partial", ".cache/matplotlib/*.matplotlib-lock")
"""The same in folders where others may be at work."""
LONG_AGO = 3600
"""Age in seconds from which on nobody needs such a file: each is written, or read, within a second."""


def check_access() -> None:
    """See that records and locks can be written, without which Snakemake reads no rule.

    Raises:
        OSError: they cannot; it names the folder.
    """
    for folder in (".cache", ".snakemake"):
        place = folder if Path(folder).exists() else "."
        if not os.access(place, os.W_OK):
            raise OSError(errno.EACCES, "cannot be written to", place)


def check_room() -> None:
    """Write to each folder of a build that is there, before a job computes for nothing.

    Raises:
        OSError: that is not possible; it names the folder.
    """
    for folder in filter(os.path.exists, OWN):
        try:
            with TemporaryFile(dir=folder) as file:
                file.write(bytes(4096))
        except OSError as error:
            raise OSError(error.errno, error.strerror, folder) from None


@cache
def lock() -> TextIO | None:
    """Wait for another build of this directory. The system frees the lock with the process, however it ends.

    Where the file system of the directory has no locks, the lock is a file on this machine. It is of the process, not
    of the file, since a workflow may use this one as a module several times.

    Returns:
        What holds the lock as long as it is open; None where there are no locks at all.

    Raises:
        OSError: a file for the lock cannot be made.
    """
    Path(".cache").mkdir(exist_ok=True)
    here = hashlib.sha256(os.fsencode(Path.cwd())).hexdigest()[:16]
    for path in (".cache/build.lock", f"{gettempdir()}/vibroimpact-{os.getuid()}-{here}.lock"):
        file = open(path, "a")  # noqa: SIM115
        try:
            _wait_for(file)
            return file
        except OSError as error:
            file.close()
            if error.errno not in WITHOUT_LOCKS:
                raise OSError(error.errno, error.strerror, path) from None
            print(f"{path}: {error.strerror}. {WITHOUT}", file=sys.stderr)
    return None


def _wait_for(file):
    try:
        fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        print("Waiting for another build in this directory to finish.", file=sys.stderr)
        fcntl.lockf(file, fcntl.LOCK_EX)


def sweep(now: float) -> None:
    """Delete what killed builds of this directory have left; to be called by who holds the lock.

    Args:
        now: seconds since 1970.
    """
    here = Path()
    left = [path for pattern in LITTER for path in here.glob(pattern)]
    shared = [path for pattern in SHARED_LITTER for path in here.glob(pattern)]
    shared += Path(gettempdir()).glob(f"{SCRATCH}*")
    for path in [*left, *(path for path in shared if _is_old(path, now))]:
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            with suppress(OSError):  # of somebody else, in a folder that is not ours to tidy
                path.unlink()


def _is_old(path, now):
    """Whether a file of ours has not been touched for long; others may delete it meanwhile."""
    try:
        state = path.lstat()
    except OSError:
        return False
    return state.st_uid == os.getuid() and now - state.st_mtime > LONG_AGO
