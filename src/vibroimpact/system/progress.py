"""Show the progress of long computations on a terminal, through standard error."""

import sys
from collections.abc import Iterator, Sequence


def track(things: Sequence, words: str, progress: bool = True) -> Iterator:
    """Yield `things` one by one, and show how many of them are done.

    If `progress` is True and standard error is a terminal, a line shows the text `words`, the number of things that are
    done and the number of all things.
    """
    for number, one in enumerate(things, start=1):
        yield one
        if progress and sys.stderr.isatty():
            end = "\n" if number == len(things) else ""
            print(f"\r\033[K{words} {number}/{len(things)}", end=end, file=sys.stderr, flush=True)
