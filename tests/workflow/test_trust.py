"""Nothing wrong is called right: what no job of this directory wrote is made anew, orphans replace nothing."""

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
    assert "made anew where it is needed: results/" in drawn.snakemake(FIGURE)
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


def edited_under_an_old_date(tree):
    edited(tree)
    os.utime(tree / FIXED_POINTS, (1e9, 1e9))


def with_a_record_without_entries(tree):
    """And with a date that nothing else has."""
    (tree / f".snakemake/sums/{FIXED_POINTS}.json").write_text("{}")


def without_record(tree):
    (tree / f".snakemake/sums/{FIXED_POINTS}.json").unlink()


@pytest.mark.parametrize(
    "damage",
    [edited, edited_under_an_old_date, cut_off, of_another_figure, without_record, with_a_record_without_entries],
)
def test_a_result_that_is_not_what_its_job_wrote_is_made_anew(drawn, damage):
    right = (drawn / FIXED_POINTS).read_bytes()
    damage(drawn)
    said = drawn.dry_run(FIGURE)
    assert FIXED_POINTS in said
    assert "Nothing to be done" not in said
    assert (drawn / FIXED_POINTS).exists(), "a dry run removes nothing"
    drawn.snakemake(FIXED_POINTS)
    assert (drawn / FIXED_POINTS).read_bytes() == right


@pytest.mark.parametrize("first", ["this", "the other"])
def test_results_of_another_config_that_are_copied_in_are_made_anew(drawn, tmp_path, first):
    """With their dates, older or newer ones, and with all that lies below results/."""
    other = whole_copy(drawn, tmp_path / "other")
    other.edit(CONFIG, LINE, OTHER)
    other.snakemake(FIGURE)
    if first == "the other":
        drawn.snakemake("--forceall", FIGURE)
    picture = drawn / f"results/figures/{FIGURE}.png"
    right = picture.read_bytes()
    shutil.copytree(other / "results", drawn / "results", dirs_exist_ok=True)
    assert picture.read_bytes() != right
    drawn.snakemake(FIGURE)
    assert picture.read_bytes() == right
    assert "Nothing to be done" in drawn.dry_run(FIGURE)


CHECKOUT = {
    "docs/studies/claims.yaml": "claims",
    "notebooks/drawings.ipynb": "fig10_01",
    "environment.lock": DRAWING,
    "src/vibroimpact/figures/plotting/vibroimpact.mplstyle": DRAWING,
}


@pytest.mark.parametrize("name", CHECKOUT)
def test_a_file_of_the_checkout_that_is_changed_under_an_old_date_is_seen(rebuilt, name):
    """As rsync, tar and cp -p leave it."""
    rule = CHECKOUT[name]
    assert "Nothing to be done" in rebuilt.dry_run(rule)
    with open(rebuilt / name, "a") as file:
        file.write("\n")
    os.utime(rebuilt / name, (1e9, 1e9))
    assert rule in rebuilt.planned(rule)


def test_a_page_is_the_same_in_each_build(drawn):
    page = drawn / "results/notebooks/fig10_01.html"
    pages = [(drawn.snakemake("--forcerun", "fig10_01", "--", "fig10_01"), page.read_text())[1] for _ in range(2)]
    assert pages[0] == pages[1]
    assert "results/figures/fig10_01.png" in pages[0]
    assert ".partial-" not in pages[0]


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
    assert "--unlock" in held.snakemake(DRAWING, check=False)
    held.snakemake("--unlock")
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
    if stop == signal.SIGKILL:
        held.snakemake("--unlock")
    held.snakemake(DRAWING)
    assert 2.2 < pd.read_csv(held / f"results/figures/{DRAWING}.csv")["C"].max() <= 2.4
    record = json.loads((held / f"results/figures/{DRAWING}.provenance.json").read_text())
    assert record["config"]["stability.companion_10_05.C_range"] == [0.5, 2.4]
    assert not list((held / "results").rglob(".partial-*"))


def test_code_that_changes_while_a_build_goes_on_fails_the_job(held):
    build = held.start(DRAWING)
    wait_for(held / "started", build)
    held.edit("src/vibroimpact/theory/manifold.py", "def rho(", "def rho_of(kappa):\n    return 0.5\n\n\ndef rho(")
    (held / "go").touch()
    said = build.communicate()[0]
    assert build.returncode != 0
    assert "the code has changed while this job ran. Build again." in said


def test_a_second_build_is_refused_while_the_first_goes_on(held):
    first = held.start(DRAWING)
    wait_for(held / "started", first)
    assert "Directory cannot be locked" in held.snakemake(DRAWING, check=False)
    assert held.returncode != 0
    (held / "go").touch()
    assert "(100%) done" in first.communicate()[0]
    assert first.returncode == 0


def origin(tree, figure):
    return run_module(tree, "vibroimpact_pipeline.provenance", str(figure))


def test_a_figure_tells_where_it_comes_from(drawn):
    figure = f"results/figures/{FIGURE}.png"
    status, said = origin(drawn.path, figure)
    assert (status, said.splitlines()[-1]) == (0, "It is what this checkout makes.")
    drawn.edit(CONFIG, LINE, OTHER)
    edited(drawn)
    status, said = origin(drawn.path, figure)
    assert status == 1
    assert "0.97" in said
    assert f"{FIXED_POINTS}: is not the one of then" in said
    shutil.copy(drawn / figure, drawn / "alone.png")
    for file in ("alone.png", "figures/CHANGES.md"):
        assert origin(drawn.path, file) == (2, f"{file} has no record of where it comes from\n")


@pytest.mark.parametrize("name", [f"{FIGURE}.png", f"{FIGURE}.csv"])
def test_a_figure_that_was_built_elsewhere_tells_where_it_comes_from(drawn, tmp_path, name):
    """Its inputs lie beside it, whatever the working directory is; files of the checkout lie there."""
    shutil.copytree(drawn / "results", elsewhere := tmp_path / "elsewhere/results")
    figure = elsewhere / f"figures/{name}"
    assert origin(drawn.path, figure)[0] == 0
    with open(figure, "a") as file:
        file.write("\n")
    status, said = origin(drawn.path, figure)
    assert (status, said.splitlines()[1:]) == (1, [f"{figure}: is not the one of then", "1 difference(s)."])
