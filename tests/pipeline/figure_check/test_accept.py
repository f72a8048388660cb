"""Accepting a reference: shows what changes, wants a reason, records both, touches nothing else."""

import datetime
import json
import shutil

import numpy as np
import pytest
from PIL import Image, ImageChops

from checking import LIMITS, check_all
from vibroimpact.figures.kit import style, tables
from vibroimpact_pipeline.figure_check import compare as figure_check
from vibroimpact_pipeline.figure_check.accept import HEADING, accept, changed, main, summary
from vibroimpact_pipeline.figure_check.origins import FILE
from vibroimpact_pipeline.figure_check.verdicts import PASSED, has_failed

DAY = datetime.date(2020, 2, 29)


def build(folder, figures, name, **changes):
    table = figures[name].compute(**changes)
    tables.write(table, folder / f"{name}.csv")
    outputs = {kind: folder / f"{name}.{kind}" for kind in ("png", "pdf", "svg")}
    style.save(figures[name].draw(table), outputs | {"artists": folder / f"{name}.artists.json"})


@pytest.fixture(scope="module")
def both(figures, tmp_path_factory):
    """A new figure 10.4 that differs from its reference, a figure 10.5 that does not, and the verdicts."""
    folder = tmp_path_factory.mktemp("both")
    reference, new = folder / "figures", folder / "results/figures"
    build(reference, figures, "fig10_04")
    build(reference, figures, "fig10_05")
    shutil.copytree(reference, new)
    build(new, figures, "fig10_04", kappa=0.651)
    for path in [*reference.glob("*.pdf"), *reference.glob("*.svg")]:
        path.unlink()
    origin = {"commit": "0123456789abcdef", "tree": "clean", "rounded by": {"processor": "a"}}
    (new / "fig10_04.provenance.json").write_text(json.dumps(origin))
    verdicts = check_all([], reference, new, LIMITS)
    check = folder / "results/figure_check"
    check.mkdir()
    (check / "figure_check.json").write_text(json.dumps(verdicts))
    return folder


@pytest.fixture
def tree(both, tmp_path, monkeypatch):
    shutil.copytree(both, tmp_path / "tree")
    monkeypatch.chdir(tmp_path / "tree")
    return tmp_path / "tree"


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_a_change_is_shown_before_and_after_with_its_distance(tree, capsys):
    assert main(["--reason", "another kappa"]) == 0
    said = capsys.readouterr().out
    assert "fig10_04: failed\n  fig10_04.csv, C: before 0.9" in said
    assert "of its axis (SIM, SIM unstable, row " in said
    assert "results/figure_check/index.html" in said
    assert "fig10_05" not in said


def test_the_new_figure_becomes_the_reference_with_its_reason(tree):
    untouched = contents(tree / "figures")["fig10_05.png"]
    assert main(["--reason", "another kappa"]) == 0
    verdicts = check_all([], tree / "figures", tree / "results/figures", LIMITS)
    assert not has_failed(verdicts)
    kept = contents(tree / "figures")
    assert kept["fig10_05.png"] == untouched
    assert sorted(kept) == sorted(
        ["CHANGES.md", FILE, *(f"fig10_0{i}.{kind}" for i in (4, 5) for kind in ("artists.json", "csv", "png"))]
    )
    assert json.loads(kept[FILE]) == {"fig10_04": {"processor": "a"}}
    text = kept["CHANGES.md"].decode()
    assert text.startswith(HEADING)
    assert ": another kappa\n\n- **fig10_04**: fig10_04.csv: C is off by " in text
    assert "Built from 0123456789 (clean tree)." in text


def test_a_picture_that_cannot_be_read_costs_no_reference(tree, capsys):
    before = contents(tree / "figures")
    picture = tree / "results/figures/fig10_04.png"
    picture.write_bytes(picture.read_bytes()[:1000])
    assert main(["--reason", "cut short"]) == 1
    assert "Not accepted. " in capsys.readouterr().err
    assert contents(tree / "figures") == before


@pytest.mark.parametrize("reason", ["", "  ", "\n"])
def test_without_a_reason_nothing_is_written(tree, capsys, reason):
    before = contents(tree / "figures")
    assert main(["--reason", reason]) == 1
    assert "reason" in capsys.readouterr().err
    assert contents(tree / "figures") == before


def test_at_a_terminal_the_reason_is_asked_for(tree, monkeypatch):
    monkeypatch.setattr("sys.stdin.isatty", lambda: True, raising=False)
    monkeypatch.setattr("builtins.input", lambda prompt: "typed by hand")
    assert main([]) == 0
    assert "typed by hand" in (tree / "figures/CHANGES.md").read_text()


def test_newest_change_comes_first_and_none_is_lost(tree):
    verdicts = json.loads((tree / "results/figure_check/figure_check.json").read_text())
    for reason in ("first", "second"):
        accept(verdicts[:1], "results/figures", "figures", reason, DAY)
    text = (tree / "figures/CHANGES.md").read_text()
    assert text.count(HEADING) == 1
    assert 0 < text.index("## 2020-02-29: second") < text.index("## 2020-02-29: first")


def test_only_the_named_figures_are_accepted(tree, capsys):
    before = contents(tree / "figures")["fig10_04.png"]
    assert main(["fig10_05", "--reason", "why not"]) == 0
    assert contents(tree / "figures")["fig10_04.png"] == before
    assert main(["fig99_99", "--reason", "no such figure"]) == 1
    assert "fig99_99" in capsys.readouterr().err


def test_with_nothing_to_accept_nothing_is_written(tree, capsys):
    shutil.copytree(tree / "results/figures", tree / "figures", dirs_exist_ok=True)
    passed = check_all([], tree / "figures", tree / "figures", LIMITS)
    (tree / "results/figure_check/figure_check.json").write_text(json.dumps(passed))
    before = contents(tree / "figures")
    assert main(["--reason", "for nothing"]) == 0
    assert "Nothing to accept" in capsys.readouterr().out
    assert contents(tree / "figures") == before


def test_a_figure_that_is_no_longer_built_leaves_the_reference(tree):
    for path in (tree / "results/figures").glob("fig10_04*"):
        path.unlink()
    verdicts = check_all([], tree / "figures", tree / "results/figures", LIMITS)
    accept(changed(verdicts), tree / "results/figures", tree / "figures", "dropped", DAY)
    assert figure_check.figures_in(tree / "figures") == {"fig10_05"}
    assert "**fig10_04**: not built" in (tree / "figures/CHANGES.md").read_text()


def test_a_long_list_of_reasons_is_cut_short():
    verdict = {"figure": "f", "status": "failed", "tables": [], "reasons": [str(i) for i in range(20)]}
    assert summary(verdict)[-1] == "  and 12 more"


def judged(tree):
    """The verdicts on the tree, where `main` reads them."""
    verdicts = check_all([], tree / "figures", tree / "results/figures", LIMITS)
    (tree / "results/figure_check/figure_check.json").write_text(json.dumps(verdicts))
    return {verdict["figure"]: verdict for verdict in verdicts}


@pytest.fixture
def upgraded(tree):
    """All as in the reference but the lettering, a little elsewhere, and the versions that drew it."""
    for kind in ("csv", "png", "artists.json"):
        shutil.copy(tree / f"results/figures/fig10_05.{kind}", tree / "figures")
    artists = tree / "results/figures/fig10_05.artists.json"
    content = json.loads(artists.read_text())
    artists.write_text(json.dumps(content | {"drawn with": {"matplotlib": "9.9", "freetype": "9.9"}}))
    with Image.open(tree / "results/figures/fig10_05.png") as picture:
        moved = ImageChops.offset(picture.convert("L"), 3, 0)
    moved.save(tree / "results/figures/fig10_05.png")
    return tree


def test_after_an_upgrade_pictures_alone_are_taken(upgraded):
    assert judged(upgraded)["fig10_05"]["status"] == "not comparable"
    before = contents(upgraded / "figures")
    assert main(["fig10_05", "--pictures", "--reason", "Matplotlib 9.9"]) == 0
    after = contents(upgraded / "figures")
    assert {name for name in before if before[name] != after[name]} == {"fig10_05.png", "fig10_05.artists.json"}
    described = [json.loads(kept["fig10_05.artists.json"]) for kept in (before, after)]
    assert described[1] == described[0] | {"drawn with": {"matplotlib": "9.9", "freetype": "9.9"}}
    assert "Matplotlib 9.9" in after["CHANGES.md"].decode()
    assert judged(upgraded)["fig10_05"]["status"] == PASSED


def test_pictures_alone_are_refused_where_a_number_has_moved_and_nothing_is_written(upgraded, capsys):
    judged(upgraded)
    before = contents(upgraded / "figures")
    assert main(["--pictures", "--reason", "Matplotlib 9.9"]) == 1
    said = capsys.readouterr().err
    assert said.startswith("Not accepted. pictures alone: more has moved in fig10_04 (fig10_04.csv: C is off by ")
    assert "fig10_05" not in said
    assert contents(upgraded / "figures") == before


def test_pictures_alone_are_refused_where_an_artist_has_moved(upgraded, capsys):
    artists = upgraded / "results/figures/fig10_05.artists.json"
    artists.write_text(artists.read_text().replace("#000000ff", "#ff0000ff"))
    judged(upgraded)
    assert main(["fig10_05", "--pictures", "--reason", "Matplotlib 9.9"]) == 1
    assert "#ff0000ff instead of #000000ff" in capsys.readouterr().err


def test_a_picture_is_kept_in_its_colours_without_loss_and_small(tree):
    path = tree / "results/figures/fig10_04.png"
    with Image.open(path) as picture:
        grey = np.asarray(picture.convert("L"))
    accept([judged(tree)["fig10_04"]], tree / "results/figures", tree / "figures", "grey", DAY)
    with Image.open(tree / "figures/fig10_04.png") as kept:
        assert kept.mode == "L"
        assert np.array_equal(np.asarray(kept), grey)
    painted = np.dstack([grey, np.where(grey < 128, 200, grey).astype(np.uint8), grey])
    Image.fromarray(painted).save(path)
    accept([judged(tree)["fig10_04"]], tree / "results/figures", tree / "figures", "colour", DAY)
    with Image.open(tree / "figures/fig10_04.png") as kept:
        assert kept.mode == "P"
        assert np.array_equal(np.asarray(kept.convert("RGB")), painted)
    assert (tree / "figures/fig10_04.png").stat().st_size < 0.7 * path.stat().st_size
