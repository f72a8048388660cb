"""Test `accept`: it prints the changes, requires a reason, records both and modifies no other figure."""

import io
import json

import numpy as np
import pytest
from PIL import Image

from vibroimpact.figures.plotting import style
from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.accept import HEADING, main
from vibroimpact_pipeline.figure_check.check import SUMS, check


@pytest.fixture
def run(tree, capsys):
    """Change numbers of figure 10.4; return a function that runs `accept` and returns exit status and output."""
    tree.change("fig10_04.csv", B=lambda table: 1.001 * table["B"])
    (tree.results / "fig10_04.provenance.json").write_text(json.dumps({"commit": "0123456789abcdef", "tree": "clean"}))

    def run(*arguments, figures=("fig10_04", "fig10_02")):
        folder = tree.build / "results/figure_check"
        folder.mkdir(exist_ok=True)
        (folder / "figure_check.json").write_text(json.dumps([tree.verdict(figure) for figure in figures]))
        status = main([*arguments, "--build", str(tree.build), "--reference", str(tree.reference)])
        printed = capsys.readouterr()
        return status, printed.out + printed.err

    return run


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def changed(before, folder):
    """Return the names of files in a folder that were added, removed or modified."""
    after = contents(folder)
    return {name for name in before | after if before.get(name) != after.get(name)}


def test_an_accepted_change_is_printed_and_recorded_and_then_passes(tree, run):
    before = contents(tree.reference)
    status, output = run("--reason", "another\n scale")
    assert status == 0
    assert "fig10_04: failed: fig10_04.csv: B is off by " in output
    assert "fig10_02" not in output
    assert changed(before, tree.reference) == {"fig10_04.csv", "fig10_04.png", SUMS, "CHANGES.md"}
    text = (tree.reference / "CHANGES.md").read_text()
    assert text.startswith(HEADING)
    assert text.count(HEADING) == 1
    assert ": another scale (fig10_04). Built from 0123456789 (clean tree).\n- " in text
    assert text.index("another scale") < text.index("all are new")
    assert tree.verdict("fig10_04")["status"] == "passed"
    assert run("--reason", "for nothing")[1].startswith("Nothing to accept")


def test_without_a_reason_no_file_is_changed(tree, run):
    before = contents(tree.reference)
    status, output = run("--reason", " \n")
    assert (status, "reason" in output, changed(before, tree.reference)) == (1, True, set())


def test_only_named_figures_are_accepted(tree, run):
    before = contents(tree.reference)
    assert run("fig10_02", "--reason", "why not")[0] == 0
    assert "fig10_04.csv" not in changed(before, tree.reference)
    status, output = run("fig99_99", "--reason", "no such figure")
    assert (status, "fig99_99" in output) == (1, True)


def test_pictures_alone_are_redrawn_from_the_reference_tables(tree, run, monkeypatch):
    monkeypatch.setitem(style.STABLE, "linewidth", 2.5)
    before = contents(tree.reference)
    assert run("fig10_04", "--pictures", "--reason", "bolder")[0] == 0
    assert changed(before, tree.reference) == {"fig10_04.png", SUMS, "CHANGES.md"}
    assert all(reason.startswith("fig10_04.csv: B is off by") for reason in tree.verdict("fig10_04")["reasons"])


def test_a_new_figure_is_accepted_with_its_tables_and_recorded_as_new(tree, run):
    for path in tree.reference.glob("fig10_04.*"):
        path.unlink()
    before = contents(tree.reference)
    status, output = run("fig10_04", "--pictures", "--reason", "why not")
    assert (status, changed(before, tree.reference)) == (1, set())
    assert "fig10_04: no reference tables yet; accept without PICTURES=1" in output
    assert run("fig10_04", "--reason", "a new one")[0] == 0
    assert (tree.reference / "fig10_04.csv").exists()
    assert ": a new one (new fig10_04)." in (tree.reference / "CHANGES.md").read_text(encoding="utf-8")


def test_a_figure_that_the_config_no_longer_has_is_removed_from_the_reference_set(tree, run):
    run("fig10_02", "--reason", "first")
    verdict = check("fig10_11", None, tree.reference, tree.build)
    (tree.build / "results/figure_check/figure_check.json").write_text(json.dumps([verdict]))
    assert main(["--reason", "dropped", "--build", str(tree.build), "--reference", str(tree.reference)]) == 0
    assert not list(tree.reference.glob("fig10_11*"))
    assert "fig10_11" not in json.loads((tree.reference / SUMS).read_text())


@pytest.mark.parametrize(("mode", "channels"), [("L", 1), ("RGB", 3), ("RGBA", 4)])
def test_pictures_are_stored_without_loss_in_as_few_channels_as_possible(tmp_path, mode, channels):
    rows = np.random.default_rng(1).integers(0, 255, (20, 30, channels), np.uint8)
    Image.fromarray(rows[..., 0] if channels == 1 else rows).save(tmp_path / "one.png")
    full = (tmp_path / "one.png").read_bytes()
    stored = pictures.small(full)
    assert pictures.load_png(stored).tobytes() == pictures.load_png(full).tobytes()
    with Image.open(io.BytesIO(stored)) as picture:
        assert picture.mode == mode
