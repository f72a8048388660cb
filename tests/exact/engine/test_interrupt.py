"""Ctrl-C, in a process of its own: a run gives up soon, with KeyboardInterrupt and nothing else."""

import subprocess
import sys

import pytest

PROGRAM = """
import os, signal, sys, threading, time
import vibroimpact as vi
from chapter import PARAMETERS

signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell in the background has its commands ignore it
system, start, call = vi.System(**PARAMETERS, f10_hat=1, f20_hat=1), [0, 0, 0, 0, 0, 0.5, 0, 0.5], sys.argv[1]
long = {
    "short": lambda cycles: [vi.simulate(system, start, 100) for _ in range(max(cycles, 100) // 100)],
    "simulate_many": lambda cycles: vi.simulate_many(system, [start] * 4, cycles),
    "ensemble": lambda cycles: vi.ensemble(system, [start] * 4, cycles, settle=cycles),
}[call]
long(1)  # compiled, or read
sent = []

def interrupt():
    sent.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)

threading.Timer(0.3, interrupt).start()
try:
    long(10_000_000)
except KeyboardInterrupt:
    print("after", time.perf_counter() - sent[0])
"""

IN_A_THREAD = """
import _thread, signal, threading, time
import vibroimpact as vi
from chapter import PARAMETERS

signal.signal(signal.SIGINT, signal.default_int_handler)
system, start, runs = vi.System(**PARAMETERS, f10_hat=1, f20_hat=1), [0, 0, 0, 0, 0, 0.5, 0, 0.5], []
vi.simulate(system, start, 1)
thread = threading.Thread(target=lambda: runs.append(vi.simulate(system, start, 500_000)))
thread.start()
threading.Timer(0.2, _thread.interrupt_main).start()
try:
    while thread.is_alive():
        time.sleep(0.01)
except KeyboardInterrupt:
    running = thread.is_alive()
thread.join()
print(running, len(runs))
"""


def words_of(program, *arguments):
    environment, command = {"PYTHONPATH": ":".join(sys.path)}, [sys.executable, "-c", program, *arguments]
    run = subprocess.run(command, env=environment, stdout=subprocess.PIPE, text=True, check=True, timeout=300)
    return run.stdout.split()


@pytest.mark.parametrize("call", ["short", "simulate_many", "ensemble"])
def test_an_interrupt_ends_a_long_run_soon(call):
    """Ten million cycles would take half a minute at least."""
    word, seconds = words_of(PROGRAM, call)
    assert word == "after"
    assert float(seconds) < 5  # half a second and less on an idle machine


def test_a_main_thread_is_interrupted_while_another_simulates():
    """It is the main thread's interrupt, as always in Python; the run of the other thread goes on and is sound."""
    assert words_of(IN_A_THREAD) == ["True", "1"]
