"""Files that are either complete or absent, even after a power cut."""

import errno
import os
from contextlib import contextmanager
from pathlib import Path

CANNOT = errno.EINVAL, errno.ENOTSUP
"""What a file system says that cannot do this for a directory."""


@contextmanager
def replacing(path):
    """Give a temporary path beside `path` to write to; put it in place of `path` only if nothing was raised.

    The content is on the disk before it bears the name, and the name before this ends.
    """
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    partial = target.with_name(f".{target.name}.{os.getpid()}.partial")
    try:
        yield partial
        keep(partial)
        os.replace(partial, target)
        keep(target.parent)
    except OSError as error:
        if error.errno and not error.filename:
            error.filename = str(target)  # which a disk without room does not say
        raise
    finally:
        partial.unlink(missing_ok=True)


def keep(path) -> None:
    """Wait until the disk holds the content of a file, or the names in a directory: the system itself takes its time.

    Raises:
        OSError: the disk does not take it.
    """
    if os.name == "nt" and Path(path).is_dir():  # Windows opens none
        return
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno not in CANNOT:
            raise
    finally:
        os.close(descriptor)
