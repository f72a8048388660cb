"""Handle Ctrl-C in commands."""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def without_traceback() -> Iterator[None]:
    """End the process on Ctrl-C with a line of text instead of a traceback.

    The signal SIGINT ends the process. Therefore a script that called the command also stops.
    """
    try:
        yield
    except KeyboardInterrupt:
        print("vibroimpact: interrupted", file=sys.stderr, flush=True)
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)
