"""What the adapters share: a log file for each job."""

import contextlib
import os
import sys
from pathlib import Path


@contextlib.contextmanager
def logging_to(path):
    """Send everything that this process and its children print to a log file."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="utf-8") as log:
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
            os.dup2(log.fileno(), stream.fileno())
        yield
