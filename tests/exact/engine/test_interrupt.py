"""Ctrl-C ends long runs soon with KeyboardInterrupt; the programs run in other processes."""

import pytest

from programs import run_program

COMMON = """
import _thread, os, signal, sys, threading, time
import vibroimpact as vi
from chapter import system_of

signal.signal(signal.SIGINT, signal.default_int_handler)  # background jobs of a shell ignore the signal
system, start = system_of("equal"), [0, 0, 0, 0, 0, 0.5, 0, 0.5]
"""
LONG_CALL = """
call = {
    "short": lambda cycles: [vi.simulate(system, start, 100) for _ in range(max(cycles, 100) // 100)],
    "simulate_many": lambda cycles: vi.simulate_many(system, [start] * 4, cycles),
    "ensemble": lambda cycles: vi.ensemble(system, [start] * 4, cycles, settle=cycles),
}[sys.argv[1]]
call(1)  # loads compiled code
sent = []

def interrupt():
    sent.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)

threading.Timer(0.3, interrupt).start()
try:
    call(10_000_000)
except KeyboardInterrupt:
    print(time.perf_counter() - sent[0])
"""
IN_A_THREAD = """
runs = []
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


@pytest.mark.parametrize("call", ["short", "simulate_many", "ensemble"])
def test_an_interrupt_ends_a_long_run_soon(call):
    """Ten million cycles would take at least half a minute; the interrupt takes half a second on an idle machine."""
    assert float(run_program(COMMON + LONG_CALL, call).stdout) < 5


def test_an_interrupt_of_the_main_thread_does_not_stop_a_simulation_in_another_thread():
    assert run_program(COMMON + IN_A_THREAD).stdout.split() == ["True", "1"]
