"""The end of a process without a last look for cycles among all that it has loaded, some 0.2 s of each job."""

import atexit
import gc

OF_KERNEL = "__import__('atexit').register(__import__('gc').freeze)"
"""The same as code, for the kernel of a notebook, which gets no name by it."""


def end_quickly() -> None:
    """To be called at any time before the end."""
    atexit.register(gc.freeze)
