"""The end of a process: with what is loaded left alone, and nothing that was to be done left out."""

import subprocess
import sys

import pytest

from vibroimpact_pipeline.quick_end import OF_KERNEL

OF_JOB = "__import__('vibroimpact_pipeline.quick_end').quick_end.end_quickly()"
RING = """
import atexit
class Ring:
    def __del__(self):
        print("looked for cycles")
ring = Ring()
ring.itself = ring
atexit.register(print, "done")
"""


@pytest.mark.parametrize(
    ("before", "said"), [("", ["done", "looked for cycles"]), (OF_JOB, ["done"]), (OF_KERNEL, ["done"])]
)
def test_a_process_ends_without_a_look_for_cycles(before, said):
    ended = subprocess.run([sys.executable, "-c", before + RING], capture_output=True, text=True, check=True)
    assert ended.stdout.splitlines() == said
    assert ended.stderr == ""
