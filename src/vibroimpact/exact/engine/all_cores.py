"""Parallel execution in threads on all cores; the engine runs without the interpreter's lock."""

import os
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError, ThreadPoolExecutor, wait
from contextlib import contextmanager
from contextvars import ContextVar

ALLOWED = ContextVar("allowed", default=sys.maxsize)
WORKER = threading.local()


def on_all_cores(work: Callable, pieces: Sequence[tuple], runs: Sequence[int], progress: bool) -> list:
    """Return `work(*piece)` for each piece, in order; raise the first error of any.

    Parameters
    ----------
    runs : sequence of int
        Number of runs of each piece.
    progress : bool
        Count finished runs on standard error, about once a second.
    """
    if min(cores(), len(pieces)) <= 1 and not progress:  # a pool would cost at least 0.1 ms and save nothing
        return [work(*piece) for piece in pieces]
    given_up = threading.Event()
    with ThreadPoolExecutor(cores(), initializer=setattr, initargs=(WORKER, "given_up", given_up)) as pool:
        todo = {pool.submit(work, *piece): count for piece, count in zip(pieces, runs, strict=True)}
        try:
            if progress:
                _report(todo)
            return [one.result() for one in todo]
        except BaseException:
            given_up.set()
            pool.shutdown(cancel_futures=True)
            raise


def stop_if_given_up():
    """Raise CancelledError in a thread whose siblings failed or were interrupted.

    Long work calls this function from time to time.
    """
    if (given_up := getattr(WORKER, "given_up", None)) and given_up.is_set():
        raise CancelledError


def cores() -> int:
    """Return the number of cores available, as limited by a cluster, the user or `at_most`."""
    there = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(there, ALLOWED.get())


@contextmanager
def at_most(threads: int) -> Iterator[None]:
    """Limit parallel work to this number of threads within a `with` block."""
    token = ALLOWED.set(threads)
    try:
        yield
    finally:
        ALLOWED.reset(token)


def _report(todo):
    total, pending = sum(todo.values()), set(todo)
    while pending:
        _, pending = wait(pending, timeout=1.0)
        done = total - sum(todo[one] for one in pending)
        print(f"\r{done}/{total} runs", end="" if pending else "\n", file=sys.stderr, flush=True)
