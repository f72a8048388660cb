"""Run work on all cores, in threads, since the compiled engine releases the global interpreter lock."""

import os
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError, ThreadPoolExecutor, wait
from contextlib import contextmanager
from contextvars import ContextVar

THREAD_LIMIT = ContextVar("thread_limit", default=sys.maxsize)
WORKER = threading.local()


def on_all_cores(work: Callable, pieces: Sequence[tuple], runs: Sequence[int], progress: bool) -> list:
    """Return the list of `work(*piece)` for all pieces, computed on all cores.

    runs: number of runs in each piece. progress: True to print the number of finished runs.
    """
    if min(cores(), len(pieces)) <= 1 and not progress:  # a thread pool would cost at least 0.1 ms and save nothing
        return [work(*piece) for piece in pieces]
    cancelled = threading.Event()
    with ThreadPoolExecutor(cores(), initializer=setattr, initargs=(WORKER, "cancelled", cancelled)) as pool:
        todo = {pool.submit(work, *piece): count for piece, count in zip(pieces, runs, strict=True)}
        try:
            if progress:
                _report(todo)
            return [one.result() for one in todo]
        except BaseException:
            cancelled.set()
            pool.shutdown(cancel_futures=True)
            raise


def stop_if_cancelled():
    """Raise CancelledError in this thread if another piece of the work failed or was interrupted."""
    if (cancelled := getattr(WORKER, "cancelled", None)) and cancelled.is_set():
        raise CancelledError


def cores() -> int:
    """Return the number of cores that this process may use, at most the limit set by `at_most`."""
    there = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(there, THREAD_LIMIT.get())


@contextmanager
def at_most(threads: int) -> Iterator[None]:
    """Limit parallel work to `threads` threads within a `with` block."""
    token = THREAD_LIMIT.set(threads)
    try:
        yield
    finally:
        THREAD_LIMIT.reset(token)


def _report(todo):
    total, pending = sum(todo.values()), set(todo)
    while pending:
        _, pending = wait(pending, timeout=1.0)
        done = total - sum(todo[one] for one in pending)
        print(f"\r{done}/{total} runs", end="" if pending else "\n", file=sys.stderr, flush=True)
