"""Two builds at once, and a build that is cut off, leave nothing behind that a later build takes for done."""

import os
import signal
import time

import pytest


@pytest.fixture
def held(tree):
    """The project with a figure 10.3 that is drawn as soon as there is a file `go`."""
    hold = f"import os, time; [time.sleep(0.02) for _ in iter(lambda: os.path.exists('{tree / 'go'}'), True)]"
    tree.edit("notebooks/closed_form.ipynb", '"import os\\n",', f'"{hold}\\n",')
    return tree


def test_a_second_build_waits_for_the_first_and_finds_its_work_done(held):
    first = held.start("fig10_03")
    wait_for(held / "results/logs/figures/fig10_03.ipynb", first)
    second = held.start("fig10_03")
    assert any("Waiting for another build" in line for line in second.stdout)
    (held / "go").touch()
    outputs = [build.communicate()[0] for build in (first, second)]
    assert [build.returncode for build in (first, second)] == [0, 0], outputs
    assert "Nothing to do" in outputs[1]


def test_a_killed_build_is_taken_up_by_the_next(held):
    """Snakemake marks outputs as incomplete while their job runs; a half-written file of such a job is not trusted."""
    build = held.start("fig10_03")
    wait_for(held / "results/logs/figures/fig10_03.ipynb", build)
    (held / "results/figures").mkdir(parents=True, exist_ok=True)
    (held / "results/figures/fig10_03.csv").write_text("panel,ser")
    os.killpg(build.pid, signal.SIGKILL)
    build.communicate()
    assert not (held / "results/notebooks/fig10_03.html").exists()
    (held / "go").touch()
    held.snakemake("fig10_03")
    assert (held / "results/notebooks/fig10_03.html").stat().st_size > 0
    assert (held / "results/figures/fig10_03.csv").read_text().startswith("panel,series,tau0,Z\n")
    assert held.planned("fig10_03") == set()


def wait_for(path, build):
    """Until a build has written a file, however long that takes it."""
    while not path.exists():
        assert build.poll() is None, f"{path} did not appear: {build.communicate()[0]}"
        time.sleep(0.02)
