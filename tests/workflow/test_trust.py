"""Nothing wrong is called right: results without a fitting record are made anew, orphans replace nothing."""

import base64
import json
import os
import shutil
import signal
import time

import pandas as pd
import pytest

from pipeline_trees import run_module

FIXED_POINTS = "results/fixed_points/equal.csv"
CONFIG, LINE, OTHER = "config/config.yaml", "f20_hat: 1.0", "f20_hat: 0.97"
FIGURE, DRAWING = "companion_10_08", "companion_10_05"
"""One that reads tables of jobs before it, and one that reads none."""


def remove_all_that_snakemake_knows(tree):
    shutil.rmtree(tree / ".snakemake")


def remove_one_record_of_snakemake(tree):
    (tree / ".snakemake/metadata" / base64.urlsafe_b64encode(FIXED_POINTS.encode()).decode()).unlink()


@pytest.mark.parametrize("remove", [remove_all_that_snakemake_knows, remove_one_record_of_snakemake])
def test_another_config_is_seen_without_what_snakemake_has_recorded(drawn, remove):
    before = pd.read_csv(drawn / FIXED_POINTS)["C2"].max()
    remove(drawn)
    drawn.edit(CONFIG, LINE, OTHER)
    assert "made with other parameters or other code" in drawn.snakemake(FIGURE)
    assert abs(pd.read_csv(drawn / FIXED_POINTS)["C2"].max() - before) > 0.01
    record = json.loads((drawn / f"results/figures/{FIGURE}.provenance.json").read_text())
    assert record["config"]["cases.equal"]["f20_hat"] == 0.97
    assert "Nothing to be done" in drawn.dry_run(FIGURE)


def edited(tree):
    with open(tree / FIXED_POINTS, "a") as table:
        table.write("\n")


def cut_off(tree):
    os.truncate(tree / FIXED_POINTS, 40)


def of_another_figure(tree):
    shutil.copy(tree / f"results/figures/{DRAWING}.csv", tree / FIXED_POINTS)


def without_record(tree):
    (tree / "results/fixed_points/.made/equal.csv.json").unlink()


@pytest.mark.parametrize("damage", [edited, cut_off, of_another_figure, without_record])
def test_a_result_that_is_not_what_its_job_wrote_is_made_anew(drawn, damage):
    right = (drawn / FIXED_POINTS).read_bytes()
    damage(drawn)
    assert FIXED_POINTS in drawn.dry_run(FIGURE), "a dry run tells, and removes nothing"
    assert (drawn / FIXED_POINTS).exists()
    drawn.snakemake(FIXED_POINTS)
    assert (drawn / FIXED_POINTS).read_bytes() == right


def test_a_file_of_somebody_else_stays(drawn):
    (drawn / "results/notes.csv").write_text("mine")
    drawn.snakemake(FIGURE)
    assert (drawn / "results/notes.csv").read_text() == "mine"


HOLD = """
import os, time
open("started", "w").close()
while not os.path.exists("go"):
    time.sleep(0.02)
"""


@pytest.fixture
def held(drawn):
    """The project with a figure whose job waits until there is a file `go`, and writes what the config said before."""
    drawn.edit(
        "workflow/scripts/figure.py", "    module = import_module", f"    exec({HOLD!r})\n    module = import_module"
    )
    drawn.edit("config/config.yaml", "companion_10_05: {C_range: [0.5, 2.2]}", "companion_10_05: {C_range: [0.5, 2.4]}")
    return drawn


def wait_for(path, build):
    while not path.exists():
        assert build.poll() is None, build.communicate()[0]
        time.sleep(0.02)


@pytest.fixture(autouse=True)
def hear_ctrl_c():
    """A shell that starts the tests in the background has them ignore Ctrl-C, and all that they start."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_the_job_of_a_killed_build_does_not_replace_the_next_result(held):
    build = held.start(DRAWING)
    wait_for(held / "started", build)
    build.kill()  # Snakemake alone: nobody tells its job
    build.wait()
    held.edit("workflow/scripts/figure.py", f"    exec({HOLD!r})\n", "")
    held.edit("config/config.yaml", "companion_10_05: {C_range: [0.5, 2.4]}", "companion_10_05: {C_range: [0.5, 2.0]}")
    held.snakemake(DRAWING)
    right = (held / f"results/figures/{DRAWING}.csv").read_bytes()
    (held / "go").touch()
    time.sleep(2.0)  # as long as the job would need to draw, if it were still there
    assert (held / f"results/figures/{DRAWING}.csv").read_bytes() == right
    assert "Nothing to be done" in held.dry_run(DRAWING)


@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGKILL], ids=lambda stop: stop.name)
def test_a_build_that_was_stopped_is_taken_up_by_the_next(held, stop):
    build = held.start(DRAWING)
    wait_for(held / "started", build)
    os.killpg(build.pid, stop)
    said = build.communicate()[0]
    assert build.returncode != 0
    assert "Traceback" not in said
    (held / "go").touch()
    held.snakemake(DRAWING)
    assert pd.read_csv(held / f"results/figures/{DRAWING}.csv")["C"].max() == 3.0
    assert not list((held / "results").rglob(".partial-*"))


def test_code_that_changes_while_a_build_goes_on_fails_the_job(held):
    build = held.start(DRAWING)
    wait_for(held / "started", build)
    held.edit("src/vibroimpact/theory/manifold.py", "def rho(", "def rho_of(kappa):\n    return 0.5\n\n\ndef rho(")
    (held / "go").touch()
    said = build.communicate()[0]
    assert build.returncode != 0
    assert "the code has changed while this job ran. Build again." in said


def test_a_second_build_waits_for_the_first(held):
    builds = [held.start(DRAWING)]
    wait_for(held / "started", builds[0])
    builds.append(held.start(DRAWING))
    assert any("Waiting for another build" in line for line in builds[1].stdout)
    (held / "go").touch()
    outputs = [build.communicate()[0] for build in builds]
    assert [build.returncode for build in builds] == [0, 0], outputs


def test_a_figure_tells_where_it_comes_from(drawn):
    figure = f"results/figures/{FIGURE}.png"
    status, said = run_module(drawn.path, "vibroimpact_pipeline.provenance", figure)
    assert (status, said.splitlines()[-1]) == (0, "It is what this checkout makes.")
    drawn.edit(CONFIG, LINE, OTHER)
    status, said = run_module(drawn.path, "vibroimpact_pipeline.provenance", figure)
    assert status == 1
    assert "0.97" in said
    shutil.copy(drawn / figure, drawn / "alone.png")
    status, said = run_module(drawn.path, "vibroimpact_pipeline.provenance", "alone.png")
    assert (status, "0.97" in said) == (1, True), "the picture bears its record itself"
    status, said = run_module(drawn.path, "vibroimpact_pipeline.provenance", "figures/CHANGES.md")
    assert (status, "Traceback" in said) == (2, False)
