"""Accepting a reference: shows what changes, wants a reason, records both, touches nothing else."""

import datetime
import json
import shutil

import pytest

from checking import LIMITS
from vibroimpact.figures.kit import style, tables
from vibroimpact_pipeline.figure_check import compare as figure_check
from vibroimpact_pipeline.figure_check.accept import HEADING, accept, changed, main, summary

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
    (new / "fig10_04.provenance.json").write_text('{"commit": "0123456789abcdef", "tree": "clean"}')
    verdicts = figure_check.check_all([], reference, new, LIMITS)
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
    verdicts = figure_check.check_all([], tree / "figures", tree / "results/figures", LIMITS)
    assert not figure_check.has_failed(verdicts)
    kept = contents(tree / "figures")
    assert kept["fig10_05.png"] == untouched
    assert sorted(kept) == sorted(
        ["CHANGES.md", *(f"fig10_0{i}.{kind}" for i in (4, 5) for kind in ("artists.json", "csv", "png"))]
    )
    text = kept["CHANGES.md"].decode()
    assert text.startswith(HEADING)
    assert ": another kappa\n\n- **fig10_04**: fig10_04.csv: C is off by " in text
    assert "Built from 0123456789 (clean tree)." in text


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
    passed = figure_check.check_all([], tree / "figures", tree / "figures", LIMITS)
    (tree / "results/figure_check/figure_check.json").write_text(json.dumps(passed))
    before = contents(tree / "figures")
    assert main(["--reason", "for nothing"]) == 0
    assert "Nothing to accept" in capsys.readouterr().out
    assert contents(tree / "figures") == before


def test_a_figure_that_is_no_longer_built_leaves_the_reference(tree):
    for path in (tree / "results/figures").glob("fig10_04*"):
        path.unlink()
    verdicts = figure_check.check_all([], tree / "figures", tree / "results/figures", LIMITS)
    accept(changed(verdicts), tree / "results/figures", tree / "figures", "dropped", DAY)
    assert figure_check.figures_in(tree / "figures") == {"fig10_05"}
    assert "**fig10_04**: not built" in (tree / "figures/CHANGES.md").read_text()


def test_a_long_list_of_reasons_is_cut_short():
    verdict = {"figure": "f", "status": "failed", "tables": [], "reasons": [str(i) for i in range(20)]}
    assert summary(verdict)[-1] == "  and 12 more"
