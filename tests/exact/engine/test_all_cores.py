"""Tasks run on all cores, or on the number of cores that is given to a job."""

import threading

import pytest

from vibroimpact.exact.engine import all_cores
from vibroimpact.exact.engine.all_cores import at_most, cores, on_all_cores


def test_the_number_of_threads_is_limited_to_the_cores_of_the_job(monkeypatch):
    monkeypatch.setattr(all_cores.os, "sched_getaffinity", lambda process: range(8), raising=False)
    both = threading.Barrier(2, timeout=60)
    workers = set()

    def work(number):
        workers.add(threading.get_ident())
        both.wait()
        return number

    with at_most(2):
        assert cores() == 2
        assert on_all_cores(work, [(number,) for number in range(8)], [1] * 8, progress=False) == list(range(8))
    assert len(workers) == 2
    with at_most(100):
        assert cores() == 8
    assert cores() == 8


def test_a_single_task_or_core_uses_the_calling_thread():
    done = []

    def work(number):
        done.append((number, threading.get_ident()))
        return 1 // (2 - number)

    with at_most(1):
        assert on_all_cores(work, [(0,), (1,)], [1] * 2, progress=False) == [0, 1]
        with pytest.raises(ZeroDivisionError):
            on_all_cores(work, [(1,), (2,), (3,)], [1] * 3, progress=False)
    with at_most(8):
        assert on_all_cores(work, [(0,)], [1], progress=False) == [0]
    here = threading.get_ident()
    assert done == [(0, here), (1, here), (1, here), (2, here), (0, here)]
