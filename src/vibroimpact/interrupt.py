"""Handle Ctrl-C in commands."""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def without_traceback() -> Iterator[None]:
    """End the process on an interrupt with one line instead of a traceback.

    The process ends by the signal itself, so that a shell stops its loop or script.
    """
    try:
        yield
    except KeyboardInterrupt:
        print("vibroimpact: interrupted", file=sys.stderr, flush=True)
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)
