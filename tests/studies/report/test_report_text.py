"""Texts of the report: numbers, captions, claims, and data of the live parts."""

import json
import math
import re
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import yaml

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from configs import GOOD as CONFIG
from pipeline_trees import ROOT
from vibroimpact.figures.plotting.markdown import digits
from vibroimpact_pipeline.html.figure_texts import figure_texts
from vibroimpact_pipeline.html.mathematics import mathml
from vibroimpact_pipeline.studies.report.live import live_data, verdict_data
from vibroimpact_pipeline.studies.report.pages import Pages, cell, table
from vibroimpact_pipeline.studies.report.results import Results


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1.0, "1"), (12345.678, "12300"), (0.00012344, "0.000123"), (2.345e-15, r"$2.35\cdot 10^{-15}$"),
        (1e-300, "$10^{-300}$"), (-2.5e7, r"$-2.5\cdot 10^{7}$"), (0, "0"), (math.nan, "–"), (None, "–"),
        (math.inf, "∞"), (np.True_, "yes"), ("a_b", r"a\_b"),
        ("2.220446049250313e-16", r"$2.22\cdot 10^{-16}$"),
    ],
)  # fmt: skip
def test_values_are_formatted_as_text(value, text):
    assert digits(value) == text


def test_a_table_has_a_line_for_each_row():
    frame = pd.DataFrame({"a": ["x | y"], "b": [0.12345], "c": [1]})
    assert table(frame, {"b": "$B$", "a": "name"}, 2) == "| $B$ | name |\n| --- | --- |\n| 0.12 | x \\| y |"
    assert cell("a\n b | c") == r"a b \| c"


def test_captions_contain_values_of_the_config():
    captions = {name: about["caption"] for name, about in figure_texts(CONFIG).items()}
    assert [name for name, text in captions.items() if len(text) < 20 or re.search(r"\{\w+_hat\}", text)] == []
    assert str(CONFIG["cases"]["unequal"]["f20_hat"]) in captions["fig10_09"]


def test_numbers_and_figures_of_documents_are_those_of_the_build():
    """Numbers keep the decimals of the document. A number without a value in the build stays as written."""
    values = {"x | a": 0.70984, "x | b": -3.17987, "percent | x | c": 69.16, "x | times": 1313.4}
    pages = Pages(ROOT, SimpleNamespace(value=lambda place: values[place]), CONFIG, {"chapter": ["one"]})
    pages.places = {"a": "x | a", "b-1.0": "x | b", "c": "percent | x | c", "d": "x | d", "e": "x | times"}
    pages.about["one"] = {"alt": "What it shows."}
    text = (
        "[0.69](numbers.yaml#a), [−3.2](numbers.yaml#b-1.0); [70](numbers.yaml#c) %, [5](numbers.yaml#d).\n"
        "![One](../results/figures/one.png) ![Two](../results/figures/two.png)\n"
        "([see](../results/figures/one.png), [two](../results/accuracy/two.png))"
    )
    shown = pages.with_numbers(text)
    links = [("0.71", "#number-a"), ("−3.2", "#number-b-1-0"), ("69", "#number-c")]
    assert re.findall(r"\[(\S+)\]\((#number-.*?)\)", shown) == links
    assert pages.number("c") == (69.16, "results/x | c")
    assert pages.number("d") is None
    assert pages.with_numbers("[900](numbers.yaml#e)", paper=True) == "1300"  # run times: two digits
    picture = "```{figure} figures/one.svg\n:alt: What it shows.\n:target: figures/one.svg\n\nOne\n```"
    assert shown.endswith(f"%, 5.\n{picture} \n([see](#one), two)")
    assert pages.with_numbers(text, paper=True).splitlines()[:2] == ["0.71, −3.2; 69 %, 5.", "![One](figures/one.svg) "]


def test_a_live_part_replaces_its_picture_if_its_data_exist(tmp_path):
    pages = Pages(ROOT, Results(tmp_path), CONFIG, {"nudge": ["nudge"]})
    text = "A\n\n<!-- live: nudge -->\n![Moved](../results/nudge/nudge.png)\n\nB"
    assert "{figure} figures/nudge.svg" in pages.with_numbers(text)
    (tmp_path / "nudge").mkdir()
    (tmp_path / "nudge/nudge.json").write_text('{"cycles": 1}')
    assert '{"cycles":1}' in pages.with_numbers(text)
    assert "nudge.svg" not in pages.with_numbers(text)
    assert "![Moved](figures/nudge.svg)" in pages.with_numbers(text, paper=True)


def test_every_number_of_a_document_has_a_place_in_the_results_and_every_place_is_used():
    documents = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "docs").rglob("*.md"))
    places = yaml.safe_load((ROOT / "docs/studies/numbers.yaml").read_text(encoding="utf-8"))
    assert set(re.findall(r"\((?:studies/)?numbers\.yaml#(.*?)\)", documents)) == set(places)


def test_values_are_found_by_their_places(tmp_path):
    pd.DataFrame({"of": ["a", "b", "b"], "share": [0.5, 0.1, 0.2]}).to_csv(tmp_path / "x.csv", index=False)
    (tmp_path / "y.json").write_text('[{"id": "k", "numbers": {"of (1)": [3, 4]}}]')
    results = Results(tmp_path)
    assert results.value('percent | x.csv | of == "a" | share') == 50
    assert results.value("y.json | k | numbers | of (1) | 1") == 4
    with pytest.raises(ValueError, match="too many"):
        results.value('x.csv | of == "b" | share')
    with pytest.raises(ValueError, match="fig10_99"):
        results.files("fig10_99")


@pytest.mark.parametrize(
    ("figure", "found"), [("fig10_01", []), ("fig10_06", ["0", "1"]), ("fig10_10", ["2"]), ("fig10_11", ["2", "3"])]
)
def test_claims_are_found_by_the_figure_they_name(tmp_path, figure, found):
    places = ("Fig. 10.6", "figures 10.6 and 10.9", "Figs. 10.10 and 10.11", "figure 10.11", "(10.6)")
    (tmp_path / "claims.json").write_text(
        json.dumps([{"id": str(n), "place": place} for n, place in enumerate(places)])
    )
    assert [claim["id"] for claim in Results(tmp_path).claims_about(figure)] == found
    assert Results(tmp_path, judged=False).claims_about(figure) == []


def test_a_formula_has_its_number_and_one_that_cannot_be_set_is_an_error():
    assert ">(10.25)<" in mathml(r"\frac{a}{b} \tag{10.25}", display=True)
    with pytest.raises(Exception, match="nosuchcommand"):
        mathml(r"\nosuchcommand{x}", display=False)


def test_the_slider_of_epsilon_has_the_exact_verdicts_of_points_called_stable():
    exact = ["stable", "unstable", "no orbit", "no orbit"]
    grid = pd.DataFrame({"epsilon": 0.1, "f10_hat": [1.0, 2.0, 3.0, 4.0], "f20_hat": 0.5, "exact": exact})
    grid = grid.assign(printed_10_26=["stable"] * 3 + ["unstable"], theory="unstable")
    ranges = {"f10_range": [0, 4], "f20_range": [0, 4], "points": 4}
    results = SimpleNamespace(table=lambda name: grid.copy())
    data = json.loads(verdict_data(results, {"stability": {"verdict_grid": ranges}}))
    assert data["printed_10_26"] == [[[1.0, 0.5, "stable"], [2.0, 0.5, "unstable"], [3.0, 0.5, "no orbit"]]]
    assert data["theory"] == [[]]


def test_the_page_play_has_the_points_of_all_cases_of_one_system():
    """Multipliers are those of `vi.orbits`. The only point of the case weak is unstable by (10.26)."""
    cases = {name: {"f10_hat": f10, "f20_hat": f20} for name, (f10, f20) in FORCES.items()}
    other = {"soft": {"f10_hat": 1.0, "f20_hat": 0.9, "kappa": 0.5}}
    data = json.loads(live_data({"system": PARAMETERS, "cases": cases | other}))
    assert (data["system"], data["cases"].keys()) == (PARAMETERS, cases.keys())
    for name, shown in data["cases"].items():
        system = vi.System(**PARAMETERS, **cases[name])
        assert shown["forces"] == list(FORCES[name])
        moduli = [abs(orbit.multipliers[0]) for orbit in vi.orbits(system) if orbit.symmetric]
        found = {point.label: point for point in vi.fixed_points(system)}
        assert [point["label"] for point in shown["points"]] == sorted(found)
        for point in shown["points"]:
            here = found[point["label"]]
            expected = here.C[1], here.B[1], here.psi[1]
            assert [point[key] for key in ("C", "B", "psi")] == pytest.approx(expected, abs=1e-4)
            assert any(modulus == pytest.approx(float(point["multiplier"]), rel=0.005) for modulus in moduli)
    assert [point["printed"] for point in data["cases"]["weak"]["points"]] == ["unstable"]
