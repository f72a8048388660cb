"""Show the progress of long computations on standard error, if it is a terminal."""

import sys
from collections.abc import Iterator, Sequence


def track(things: Sequence, words: str, progress: bool = True) -> Iterator:
    """Yield `things` one by one; if `progress`, show `words` and the number of things done on a terminal."""
    for number, one in enumerate(things, start=1):
        yield one
        if progress and sys.stderr.isatty():
            end = "\n" if number == len(things) else ""
            print(f"\r\033[K{words} {number}/{len(things)}", end=end, file=sys.stderr, flush=True)
