"""Progress of long work, on standard error and on a terminal only."""

import sys
from collections.abc import Iterator, Sequence


def shown(progress: bool) -> bool:
    """Return True if progress is asked for and standard error is a terminal."""
    return progress and sys.stderr.isatty()


def counted(things: Sequence, words: str, progress: bool = True) -> Iterator:
    """Yield the things; count those that are done, after some words."""
    for number, one in enumerate(things, start=1):
        yield one
        if shown(progress):
            tell(f"{words} {number}/{len(things)}", last=number == len(things))


def tell(line: str, last: bool = False) -> None:
    """Write a line over the one before."""
    print(f"\r\033[K{line}", end="\n" if last else "", file=sys.stderr, flush=True)
