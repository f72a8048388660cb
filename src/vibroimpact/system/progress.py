"""Show the progress of long computations on standard error, if it is a terminal."""

import sys
from collections.abc import Iterator, Sequence


def wants_progress(progress: bool) -> bool:
    """Return True if progress is requested and standard error is a terminal."""
    return progress and sys.stderr.isatty()


def track(things: Sequence, words: str, progress: bool = True) -> Iterator:
    """Yield `things` one by one; if `progress`, a terminal shows `words` and the number of things done."""
    for number, one in enumerate(things, start=1):
        yield one
        if wants_progress(progress):
            write_line(f"{words} {number}/{len(things)}", last=number == len(things))


def write_line(line: str, last: bool = False) -> None:
    """Write `line` over the line that the terminal shows; if `last`, add a newline."""
    print(f"\r\033[K{line}", end="\n" if last else "", file=sys.stderr, flush=True)
