"""Files that are either complete or absent."""

import os
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def replacing(path):
    """Give a temporary path beside `path` to write to; put it in place of `path` only if nothing was raised."""
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    partial = target.with_name(f".{target.name}.{os.getpid()}.partial")
    try:
        yield partial
        os.replace(partial, target)
    except OSError as error:
        error.filename = error.filename or str(target)  # which a disk without room does not say
        raise
    finally:
        partial.unlink(missing_ok=True)
