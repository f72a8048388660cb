"""Two builds at once, and a build that is cut off, leave nothing behind that a later build takes for done."""

import os
import signal
import time


def test_a_second_build_waits_for_the_first_and_finds_its_work_done(tree):
    first = tree.start("fig10_03")
    wait_for(tree / ".cache/build.lock")
    second = tree.start("fig10_03")
    outputs = [build.communicate()[0] for build in (first, second)]
    assert [build.returncode for build in (first, second)] == [0, 0], outputs
    assert sum("Waiting for another build" in output for output in outputs) == 1
    assert sum("Nothing to be done" in output for output in outputs) == 1


def test_a_killed_build_is_taken_up_by_the_next(tree):
    build = tree.start("fig10_03")
    wait_for(tree / "results/logs/figures/fig10_03.log")
    os.killpg(build.pid, signal.SIGKILL)
    build.communicate()
    assert not (tree / "results/notebooks/fig10_03.html").exists()
    tree.snakemake("fig10_03")
    assert (tree / "results/notebooks/fig10_03.html").stat().st_size > 0
    assert tree.planned("fig10_03") == set()


def test_a_half_written_output_of_a_killed_job_is_made_again(tree):
    """Snakemake marks outputs as incomplete while their job runs; a file that such a job left is not trusted."""
    tree.edit("notebooks/closed_form.ipynb", '"import os\\n",', '"import os, time; time.sleep(600)\\n",')
    build = tree.start("fig10_03")
    wait_for(tree / "results/logs/figures/fig10_03.ipynb")
    (tree / "results/figures").mkdir(parents=True, exist_ok=True)
    (tree / "results/figures/fig10_03.csv").write_text("panel,ser")
    os.killpg(build.pid, signal.SIGKILL)
    build.communicate()
    tree.edit("notebooks/closed_form.ipynb", '"import os, time; time.sleep(600)\\n",', '"import os\\n",')
    tree.snakemake("fig10_03")
    assert (tree / "results/figures/fig10_03.csv").read_text().startswith("panel,series,tau0,Z\n")


def wait_for(path, seconds=60):
    deadline = time.monotonic() + seconds
    while not path.exists():
        assert time.monotonic() < deadline, f"{path} did not appear"
        time.sleep(0.02)
