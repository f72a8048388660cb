"""Test `accept`: it shows the changes, requires a reason, records both and modifies nothing else."""

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
        said = capsys.readouterr()
        return status, said.out + said.err

    return run


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def changed(before, folder):
    after = contents(folder)
    return {name for name in before | after if before.get(name) != after.get(name)}


def test_a_change_is_shown_recorded_and_then_agrees(tree, run):
    before = contents(tree.reference)
    status, said = run("--reason", "another\n scale")
    assert status == 0
    assert "fig10_04: failed: fig10_04.csv: B is off by " in said
    assert "fig10_02" not in said
    assert changed(before, tree.reference) == {"fig10_04.csv", "fig10_04.png", SUMS, "CHANGES.md"}
    text = (tree.reference / "CHANGES.md").read_text()
    assert text.startswith(HEADING)
    assert text.count(HEADING) == 1
    assert ": another scale (fig10_04). Built from 0123456789 (clean tree).\n- " in text
    assert text.index("another scale") < text.index("all are new")
    assert tree.verdict("fig10_04")["status"] == "passed"
    assert run("--reason", "for nothing")[1].startswith("Nothing to accept")


def test_without_a_reason_nothing_is_written(tree, run):
    before = contents(tree.reference)
    status, said = run("--reason", " \n")
    assert (status, "reason" in said, changed(before, tree.reference)) == (1, True, set())


def test_only_named_figures_are_accepted(tree, run):
    before = contents(tree.reference)
    assert run("fig10_02", "--reason", "why not")[0] == 0
    assert "fig10_04.csv" not in changed(before, tree.reference)
    status, said = run("fig99_99", "--reason", "no such figure")
    assert (status, "fig99_99" in said) == (1, True)


def test_pictures_alone_are_drawn_of_the_tables_that_are_published(tree, run, monkeypatch):
    monkeypatch.setitem(style.STABLE, "linewidth", 2.5)
    before = contents(tree.reference)
    assert run("fig10_04", "--pictures", "--reason", "bolder")[0] == 0
    assert changed(before, tree.reference) == {"fig10_04.png", SUMS, "CHANGES.md"}
    said = [reason for reason in tree.verdict("fig10_04")["reasons"] if "reference's table" in reason]
    assert said == []


def test_a_new_figure_brings_its_tables_and_is_recorded_as_new(tree, run):
    for path in tree.reference.glob("fig10_04.*"):
        path.unlink()
    before = contents(tree.reference)
    status, said = run("fig10_04", "--pictures", "--reason", "why not")
    assert (status, changed(before, tree.reference)) == (1, set())
    assert "fig10_04: no reference tables to draw from; accept without PICTURES=1" in said
    assert run("fig10_04", "--reason", "a new one")[0] == 0
    assert (tree.reference / "fig10_04.csv").exists()
    assert ": a new one (new fig10_04)." in (tree.reference / "CHANGES.md").read_text(encoding="utf-8")


def test_a_figure_that_is_no_longer_made_leaves_the_set(tree, run):
    run("fig10_02", "--reason", "first")
    verdict = check("fig10_11", None, tree.reference, tree.build)
    (tree.build / "results/figure_check/figure_check.json").write_text(json.dumps([verdict]))
    assert main(["--reason", "dropped", "--build", str(tree.build), "--reference", str(tree.reference)]) == 0
    assert not list(tree.reference.glob("fig10_11*"))
    assert "fig10_11" not in json.loads((tree.reference / SUMS).read_text())


@pytest.mark.parametrize(("mode", "channels"), [("L", 1), ("RGB", 3), ("RGBA", 4)])
def test_a_picture_is_kept_without_loss_in_no_more_channels_than_needed(tmp_path, mode, channels):
    rows = np.random.default_rng(1).integers(0, 255, (20, 30, channels), np.uint8)
    picture = Image.fromarray(rows[..., 0] if channels == 1 else rows)
    picture.save(tmp_path / "one.png")
    full = (tmp_path / "one.png").read_bytes()
    kept = pictures.small(full)
    assert pictures.load_png(kept).tobytes() == pictures.load_png(full).tobytes()
    (tmp_path / "two.png").write_bytes(kept)
    with Image.open(tmp_path / "two.png") as again:
        assert again.mode == mode
