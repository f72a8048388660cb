"""Builds at once and builds that were stopped: nothing that is half done is taken for done."""

import os
import signal
import time

import pytest

FIGURE = "companion_10_04"
HOLD = """
import os, time
open("started", "w").close()
while not os.path.exists("go"):
    time.sleep(0.02)
"""


def wait_for(path, process):
    """Until a process has written a file, however long that takes it."""
    while not path.exists():
        assert process.poll() is None, process.communicate()[0]
        time.sleep(0.02)


@pytest.fixture(autouse=True)
def hear_ctrl_c():
    """A shell that starts the tests in the background has them ignore Ctrl-C, and all that they start."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def held(tree):
    """The project with a figure that is drawn as soon as there is a file `go`."""
    tree.edit("workflow/scripts/figure.py", "from importlib import import_module\n", f"from importlib import *\n{HOLD}")
    return tree


@pytest.mark.thorough
def test_of_three_builds_at_once_one_works(held):
    builds = [held.start(FIGURE)]
    wait_for(held / "started", builds[0])
    builds += [held.start(FIGURE) for _ in range(2)]
    for waiting in builds[1:]:
        assert any("Waiting for another build" in line for line in waiting.stdout)
    (held / "go").touch()
    outputs = [build.communicate()[0] for build in builds]
    assert [build.returncode for build in builds] == [0, 0, 0], outputs
    assert sum("Done in" in output for output in outputs) == 1
    assert sum("Nothing to do" in output for output in outputs) == 2


THOROUGH = pytest.mark.thorough


@pytest.mark.parametrize(
    "stop",
    [signal.SIGINT, pytest.param(signal.SIGTERM, marks=THOROUGH), pytest.param(signal.SIGKILL, marks=THOROUGH)],
    ids=lambda stop: stop.name,
)
def test_a_build_that_was_stopped_is_taken_up_by_the_next(held, stop):
    build = held.start(FIGURE)
    wait_for(held / "started", build)
    (held / "results/figures").mkdir(parents=True, exist_ok=True)
    (held / f"results/figures/{FIGURE}.csv").write_text("panel,ser")
    os.killpg(build.pid, stop)
    build.communicate()
    assert build.returncode != 0
    assert not (held / f"results/figures/{FIGURE}.png").exists()
    (held / "go").touch()
    held.snakemake(FIGURE)
    assert len((held / f"results/figures/{FIGURE}.csv").read_text()) > 100
    assert (held / f"results/figures/{FIGURE}.png").exists()
