"""The adapters, called as functions."""

import json

import nbformat
import numpy as np
import pandas as pd
import pytest
from fontTools.ttLib import TTFont
from papermill import PapermillExecutionError

import fixed_points
import gather
import orbits
import proofs
import simulate
import verdict_grid
import verdicts
from chapter import PARAMETERS
from notebook import main as notebook
from vibroimpact.exact.engine.simulation import simulate as integrate
from vibroimpact.figures.companions import companion_stability
from vibroimpact.system import System
from vibroimpact_pipeline.report.mathematics import FONT
from vibroimpact_pipeline.report.offline import linked, markdown_to_html

SYSTEM = {
    **PARAMETERS,
    "f10_hat": 1.0,
    "f20_hat": 1.0,
}
SETTINGS = {"initial_state": [0.0] * 8, "transient_cycles": 20, "window_cycles": 3, "samples_per_cycle": 16}


def test_fixed_points_of_cases_are_gathered_as_they_are(tmp_path):
    paths = [tmp_path / "one.csv", tmp_path / "two.csv"]
    fixed_points.main("one", SYSTEM, paths[0])
    fixed_points.main("two", SYSTEM | {"f20_hat": 0.89}, paths[1])
    gather.main(paths, tmp_path / "all.csv")
    first, rest = paths[0].read_text(), paths[1].read_text().split("\n", 1)[1]
    assert (tmp_path / "all.csv").read_text() == first + rest


@pytest.mark.parametrize(
    "changes",
    [
        {"f10_hat": 0.0, "f20_hat": 0.0},
        {"f10_hat": 0.1, "f20_hat": 0.1},
        {"f20_hat": 0.0, "alpha12_hat": 0.0, "gamma12_hat": 0.0},
    ],
)
def test_a_case_without_responses_goes_through_all_stages(tmp_path, changes):
    """No force, too weak a force, a module that nothing drives: empty tables, proved, and a figure without points."""
    system = SYSTEM | changes
    paths = {name: tmp_path / f"{name}.csv" for name in ("fixed_points", "orbits", "verdicts", "verdict_grid")}
    fixed_points.main("still", system, paths["fixed_points"])
    orbits.main("still", system, {"csv": paths["orbits"], "search": tmp_path / "search.json"})
    verdicts.main("still", system, paths, paths["verdicts"])
    tables = {name: pd.read_csv(paths[name]) for name in ("verdicts", "orbits")}
    assert [len(table) for table in tables.values()] == [0, 0]
    found = {"still": (paths["orbits"], tmp_path / "search.json")}
    proofs.main({"still": system}, found, tmp_path / "proofs.json")
    found = json.loads((tmp_path / "proofs.json").read_text())["still"]
    assert found["fixed_points"]["complete"]
    assert found["symmetric_orbits"]["complete"]
    assert found["fixed_points"]["proved"] == found["symmetric_orbits"]["proved"] == 0
    table = companion_stability.compute({"still": System(**system)}, tables["verdicts"], tables["orbits"])
    companion_stability.draw(table)
    verdict_grid.main(
        system, {"f10_range": (0, 0.1), "f20_range": (0, 0.1), "points": 2, "epsilon": [0.1]}, paths["verdict_grid"]
    )
    assert pd.read_csv(paths["verdict_grid"]).empty


def test_a_simulation_leaves_its_window_only(tmp_path):
    outputs = {name: tmp_path / name for name in ("samples", "events", "summary", "strobe")}
    simulate.main("equal", SYSTEM, SETTINGS, outputs)
    samples, events = pd.read_csv(outputs["samples"]), pd.read_csv(outputs["events"])
    summary = json.loads(outputs["summary"].read_text())
    period = System(**SYSTEM).period
    np.testing.assert_allclose(samples["tau"].iloc[[0, -1]], [20 * period, 23 * period], rtol=1e-15)
    assert len(samples) == 3 * 16 + 1
    assert events["tau"].between(20 * period, 23 * period).all()
    assert sum(sum(by_module.values()) for by_module in summary["events"].values()) == len(events)
    run = integrate(System(**SYSTEM), SETTINGS["initial_state"], 23)
    np.testing.assert_allclose(samples.iloc[-1, 1:].to_numpy(float), run.final, atol=1e-9)
    assert set(events["kind"]) <= {"impact", "stick", "release"}
    at_wall = events["X1"] - events["Y1"] - events["wall"]
    np.testing.assert_allclose(at_wall[events["module"] == 1], 0, atol=1e-12)


def write(path, names, *code):
    """A small notebook with the given names in its parameters cell."""
    cell = nbformat.v4.new_code_cell("\n".join(f"{name} = {{}}" for name in names), metadata={"tags": ["parameters"]})
    cells = [nbformat.v4.new_markdown_cell("# Title\n\n$x$"), cell, *map(nbformat.v4.new_code_cell, code)]
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata=kernel), path)
    return path


AGREED = ["figure", "alt", "settings", "inputs", "outputs", "provenance"]


def parameters(**settings):
    return {name: {} for name in AGREED} | {"figure": "fig10_03", "settings": settings}


@pytest.mark.parametrize("names", [AGREED[:3], [*AGREED, "colour"]])
def test_a_notebook_with_other_parameters_is_refused(tmp_path, names):
    source = write(tmp_path / "source.ipynb", names)
    with pytest.raises(ValueError, match="parameters"):
        notebook(source, tmp_path / "executed.ipynb", tmp_path / "page.html", parameters(), "Title")
    assert not (tmp_path / "page.html").exists()


def test_a_parameter_that_no_notebook_has_is_refused(tmp_path):
    """Papermill would go on with the default of what was meant."""
    source = write(tmp_path / "source.ipynb", AGREED, "print(figure)")
    with pytest.raises(ValueError, match=r"given are the parameters .*'kappa'"):
        notebook(source, tmp_path / "executed.ipynb", tmp_path / "page.html", parameters() | {"kappa": 0.3}, "Title")
    assert not (tmp_path / "page.html").exists()


def test_a_notebook_gets_its_parameters_and_becomes_a_page(tmp_path):
    source = write(tmp_path / "source.ipynb", AGREED, "print(figure, settings['kappa'] + 1)")
    notebook(source, tmp_path / "executed.ipynb", tmp_path / "page.html", parameters(kappa=0.5), "Figure 1")
    html = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "fig10_03 1.5" in html
    assert "<title>Figure 1</title>" in html
    assert [html.count(f"<summary>{name}</summary>") for name in ("Parameters", "Code")] == [1, 1]
    assert '<a href="../figures.html#one">Notebook of Figure 1</a>' in linked(html, "../figures.html#one")
    assert "<math>" in html


def test_a_failed_notebook_can_be_read(tmp_path):
    source = write(tmp_path / "source.ipynb", AGREED, "print('before')", "1 / 0", "print('after')")
    with pytest.raises(PapermillExecutionError, match="ZeroDivisionError"):
        notebook(source, tmp_path / "executed.ipynb", tmp_path / "page.html", parameters(), "Title")
    assert not (tmp_path / "page.html").exists()
    outputs = str([cell.get("outputs") for cell in nbformat.read(tmp_path / "executed.ipynb", 4).cells])
    assert "before" in outputs
    assert "ZeroDivisionError" in outputs
    assert "after" not in outputs


@pytest.mark.parametrize(
    ("markdown", "parts"),
    [
        (r"$\hat f_{10} = 1$", ["<math>", "<mn>10</mn>"]),
        (r"$$B_{\min} \tag{10.25}$$", ['<math display="block">', "(10.25)"]),
        ("$$\n\\begin{aligned} a &= b \\\\ c &< d \\end{aligned}\n$$", ["<mtable", "<mo>&lt;</mo>"]),
        (r"$\overline{z_1 z_2 K^2}$", ['</msup></mrow><mo stretchy="true">\u203e</mo></mover>']),
        (r"\begin{equation} \dot X \end{equation}", ['<math display="block">', "˙"]),
        ("a `$x$` b", ["<code>$x$</code>"]),
    ],
)
def test_formulas_become_mathml(markdown, parts):
    html = markdown_to_html(markdown)
    assert not [part for part in parts if part not in html], html


def test_the_font_has_the_signs_that_a_browser_adds_to_formulas():
    assert {"√", "‾"} <= set(map(chr, TTFont(FONT).getBestCmap()))


def test_an_unknown_command_in_a_formula_is_an_error():
    with pytest.raises(Exception, match="nosuchcommand"):
        markdown_to_html(r"$\nosuchcommand$")
