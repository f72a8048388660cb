"""Test that a build trusts only results of its own jobs: others are rebuilt, and orphaned jobs replace no result."""

import base64
import json
import os
import shutil
import signal
import time

import pandas as pd
import pytest

from pipeline_trees import run_module, whole_copy

FIXED_POINTS = "results/fixed_points/equal.csv"
SCRIPT = "workflow/scripts/fixed_points.py"
CONFIG, LINE, OTHER = "config/config.yaml", "f20_hat: 1.0", "f20_hat: 0.97"
THOROUGH = pytest.mark.thorough
FIGURE, DRAWING = "fig10_06", "fig10_04"
"""A figure that reads results of other jobs, and a figure that reads none."""


def remove_all_records_of_snakemake(tree):
    shutil.rmtree(tree / ".snakemake")


def remove_one_record_of_snakemake(tree):
    (tree / ".snakemake/metadata" / base64.urlsafe_b64encode(FIXED_POINTS.encode()).decode()).unlink()


@pytest.mark.parametrize(
    "remove", [pytest.param(remove_all_records_of_snakemake, marks=THOROUGH), remove_one_record_of_snakemake]
)
def test_another_config_is_noticed_without_records_of_snakemake(rebuilt, remove):
    before = pd.read_csv(rebuilt / FIXED_POINTS)["C2"].max()
    remove(rebuilt)
    rebuilt.edit(CONFIG, LINE, OTHER)
    assert "will be rebuilt: results/" in rebuilt.snakemake(FIGURE)
    assert abs(pd.read_csv(rebuilt / FIXED_POINTS)["C2"].max() - before) > 0.01
    record = json.loads((rebuilt / f"results/figures/{FIGURE}.provenance.json").read_text())
    assert record["config"]["cases.equal"]["f20_hat"] == 0.97
    assert "Nothing to be done" in rebuilt.dry_run(FIGURE)


def edited(tree):
    with open(tree / FIXED_POINTS, "a") as table:
        table.write("\n")


def cut_off(tree):
    os.truncate(tree / FIXED_POINTS, 40)


def of_another_figure(tree):
    shutil.copy(tree / f"results/figures/{DRAWING}.csv", tree / FIXED_POINTS)


def edited_under_an_old_date(tree):
    edited(tree)
    os.utime(tree / FIXED_POINTS, (1e9, 1e9))


def with_a_record_without_entries(tree):
    """Empty the record, which changes its date, too."""
    (tree / f".snakemake/sums/{FIXED_POINTS}.json").write_text("{}")


def without_record(tree):
    (tree / f".snakemake/sums/{FIXED_POINTS}.json").unlink()


@pytest.mark.parametrize(
    "damage",
    [
        edited_under_an_old_date,
        *(
            pytest.param(one, marks=THOROUGH)
            for one in (of_another_figure, edited, cut_off, without_record, with_a_record_without_entries)
        ),
    ],
)
def test_a_result_that_was_modified_since_it_was_built_is_rebuilt(rebuilt, damage):
    right = (rebuilt / FIXED_POINTS).read_bytes()
    damage(rebuilt)
    output = rebuilt.dry_run(FIGURE)
    assert FIXED_POINTS in output
    assert "Nothing to be done" not in output
    assert (rebuilt / FIXED_POINTS).exists(), "a dry run removes nothing"
    rebuilt.snakemake(FIXED_POINTS)
    assert (rebuilt / FIXED_POINTS).read_bytes() == right


@THOROUGH
@pytest.mark.parametrize("first", ["this", "the other"])
def test_results_of_another_config_that_are_copied_in_are_rebuilt(rebuilt, tmp_path, first):
    """They are copied with their dates, which are older or newer, and with everything below results/."""
    other = whole_copy(rebuilt, tmp_path / "other")
    other.edit(CONFIG, LINE, OTHER)
    other.snakemake(FIGURE)
    if first == "the other":
        rebuilt.snakemake("--forceall", FIGURE)
    picture = rebuilt / f"results/figures/{FIGURE}.png"
    right = picture.read_bytes()
    shutil.copytree(other / "results", rebuilt / "results", dirs_exist_ok=True)
    assert picture.read_bytes() != right
    rebuilt.snakemake(FIGURE)
    assert picture.read_bytes() == right
    assert "Nothing to be done" in rebuilt.dry_run(FIGURE)


CHECKOUT = {
    "notebooks/drawings.ipynb": "pages_drawings",
    "environment.lock": DRAWING,
    "src/vibroimpact/figures/plotting/vibroimpact.mplstyle": DRAWING,
}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name.endswith("mplstyle") else THOROUGH) for name in CHECKOUT]
)
def test_a_change_of_a_file_of_the_checkout_with_an_old_date_is_noticed(rebuilt, name):
    """rsync, tar and cp -p set such dates."""
    rule = CHECKOUT[name]
    assert "Nothing to be done" in rebuilt.dry_run(rule)
    with open(rebuilt / name, "a") as file:
        file.write("\n")
    os.utime(rebuilt / name, (1e9, 1e9))
    assert rule in rebuilt.planned(rule)


@THOROUGH
def test_a_page_is_the_same_in_each_build(rebuilt):
    page = rebuilt / "results/notebooks/fig10_01.html"
    before = page.read_text()
    rebuilt.snakemake("--forcerun", "pages_drawings", "--", "pages_drawings")
    assert page.read_text() == before
    assert "results/figures/fig10_01.png" in before
    assert ".partial-" not in before


def test_a_file_of_the_user_is_kept(rebuilt):
    (rebuilt / "results/notes.csv").write_text("mine")
    rebuilt.snakemake(FIGURE)
    assert (rebuilt / "results/notes.csv").read_text() == "mine"


HOLD = """
import os, time
open("started", "w").close()
while not os.path.exists("go"):
    time.sleep(0.02)
"""


@pytest.fixture
def held(rebuilt):
    """Return the project with another config, and with a job that waits for a file `go` before it writes its table."""
    rebuilt.edit(SCRIPT, "    tables.write(", f"    exec({HOLD!r})\n    tables.write(")
    rebuilt.edit(CONFIG, LINE, OTHER)
    return rebuilt


def wait_for(path, build):
    while not path.exists():
        assert build.poll() is None, build.communicate()[0]
        time.sleep(0.02)


@pytest.fixture(autouse=True)
def hear_ctrl_c():
    """Restore the handling of Ctrl-C, which tests and their children ignore if a shell runs them in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_a_second_build_is_refused_and_the_job_of_a_killed_build_replaces_no_result(held):
    build = held.start(FIXED_POINTS)
    wait_for(held / "started", build)
    assert "Directory cannot be locked" in held.snakemake(FIXED_POINTS, check=False)
    build.kill()  # kill only Snakemake, without a signal to its job
    build.wait()
    assert "--unlock" in held.snakemake(FIXED_POINTS, check=False)
    held.snakemake("--unlock")
    held.edit(SCRIPT, f"    exec({HOLD!r})\n", "")
    held.edit(CONFIG, OTHER, "f20_hat: 0.98")
    held.snakemake(FIXED_POINTS)
    right = (held / FIXED_POINTS).read_bytes()
    (held / "go").touch()
    time.sleep(2.0)  # enough time for the job to write, if it were still alive
    assert (held / FIXED_POINTS).read_bytes() == right
    assert "Nothing to be done" in held.dry_run(FIXED_POINTS)


@pytest.mark.parametrize(
    "stop", [signal.SIGINT, pytest.param(signal.SIGKILL, marks=THOROUGH)], ids=lambda stop: stop.name
)
def test_the_next_build_continues_a_stopped_build(held, built, stop):
    build = held.start(FIXED_POINTS)
    wait_for(held / "started", build)
    os.killpg(build.pid, stop)
    output = build.communicate()[0]
    assert build.returncode != 0
    assert "Traceback" not in output
    (held / "go").touch()
    if stop == signal.SIGKILL:
        held.snakemake("--unlock")
    before = pd.read_csv(built / FIXED_POINTS)["C2"].max()
    held.snakemake(FIXED_POINTS)
    assert abs(pd.read_csv(held / FIXED_POINTS)["C2"].max() - before) > 0.01
    assert not list((held / "results").rglob(".partial-*"))


def test_a_job_fails_if_code_changes_during_the_job(held):
    build = held.start(FIXED_POINTS)
    wait_for(held / "started", build)
    held.edit("src/vibroimpact/theory/manifold.py", "def rho(", "def rho_of(kappa):\n    return 0.5\n\n\ndef rho(")
    (held / "go").touch()
    output = build.communicate()[0]
    assert build.returncode != 0
    assert "the code has changed while this job ran; rerun the build" in output


def origin(tree, figure):
    return run_module(tree, "vibroimpact_pipeline.provenance", str(figure))


def test_the_origin_of_a_figure_is_reported(rebuilt):
    figure = f"results/figures/{FIGURE}.png"
    status, output = origin(rebuilt.path, figure)
    assert (status, output.splitlines()[-1]) == (0, "No differences: this checkout makes the same figure.")
    rebuilt.edit(CONFIG, LINE, OTHER)
    edited(rebuilt)
    status, output = origin(rebuilt.path, figure)
    assert status == 1
    assert "0.97" in output
    assert f"{FIXED_POINTS}: missing or changed since" in output
    shutil.copy(rebuilt / figure, rebuilt / "alone.png")
    for file in ("alone.png", "figures/CHANGES.md"):
        assert origin(rebuilt.path, file) == (2, f"{file}: no readable provenance record next to this file\n")


@pytest.mark.parametrize("name", [f"{FIGURE}.png", f"{FIGURE}.csv"])
def test_the_origin_of_a_figure_that_was_built_elsewhere_is_reported(rebuilt, tmp_path, name):
    """Inputs are found relative to the figure, in any working directory, and other files in the checkout."""
    shutil.copytree(rebuilt / "results", elsewhere := tmp_path / "elsewhere/results")
    figure = elsewhere / f"figures/{name}"
    assert origin(rebuilt.path, figure)[0] == 0
    with open(figure, "a") as file:
        file.write("\n")
    status, output = origin(rebuilt.path, figure)
    assert (status, output.splitlines()[1:]) == (
        1,
        [f"{figure}: missing or changed since the figure was made", "1 difference(s)."],
    )
