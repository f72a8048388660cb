"""How the report's text is made: numbers, captions, formulas, links."""

import json
import math
import re
from types import SimpleNamespace

import pandas as pd
import pytest
import yaml
from math_core import LatexError

from pipeline_trees import ROOT
from vibroimpact_pipeline.report.figure_texts import figure_texts
from vibroimpact_pipeline.report.live import verdict_data
from vibroimpact_pipeline.report.notation import named
from vibroimpact_pipeline.report.pages import Pages, cell, digits, markdown_table, said, section_of, setting, verdicts
from vibroimpact_pipeline.report.results import Results
from vibroimpact_pipeline.report.site import convert

SOURCES = ROOT / "report"
CONFIG = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
SETTINGS = yaml.safe_load((SOURCES / "report.yaml").read_text(encoding="utf-8"))
KNOWN = {"page": "here", "pagetitle": "Here", "site": "Site", "footer": ""}


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1.0, "1"),
        (12345.678, "12300"),
        (0.00012344, "0.000123"),
        (2.345e-15, r"$2.35\cdot 10^{-15}$"),
        (1e-300, "$10^{-300}$"),
        (-2.5e7, r"$-2.5\cdot 10^{7}$"),
        (0, "0"),
        (math.nan, "–"),
        (None, "–"),
    ],
)
def test_a_number_in_the_text(value, text):
    assert digits(value) == text


def test_settings_of_methods_are_numbers_or_words():
    assert [setting(value) for value in ("1e-08", "float64", 100000)] == ["$10^{-8}$", "float64", "100000"]


def test_numbers_behind_a_claim_are_one_line():
    numbers = {"fixed_points": 3, "C": [0.957251, 1e-9], "holds": True, "left": None, "where": "a | b"}
    expected = r"fixed points: 3; $C$: 0.9573, $10^{-9}$; holds: yes; left: open; where: a \| b"
    assert said(numbers) == expected


def test_a_name_of_a_number_ends_no_cell():
    assert said({"smallest |eigenvalue|": 0.5}) == r"smallest \|eigenvalue\|: 0.5"


def test_a_table_survives_what_its_cells_say():
    html = convert("# Here\n\n" + markdown_table(["a", "b"], [["x | y", "two\nlines"]]), "html", SOURCES, KNOWN)
    assert "<td>x | y</td>" in html.replace(' style="text-align: left;"', "")
    assert "two lines" in html
    assert cell("a\n b") == "a b"


def test_on_paper_columns_share_the_width_by_what_they_hold():
    long = markdown_table(["a", "b"], [["x", 200 * "long text "]])
    columns = re.search(r"columns: \((.*?)%, (.*?)%\)", convert(f"# Here\n\n{long}", "typst", SOURCES, KNOWN))
    assert float(columns[2]) > 5 * float(columns[1])
    assert "%" not in convert("# Here\n\n" + markdown_table(["a", "b"], [["x", "y"]]), "typst", SOURCES, KNOWN)


def test_captions_fill_from_the_config():
    pages = Pages(ROOT, None, SETTINGS, CONFIG, {})
    captions = {name: pages.caption(name) for name in figure_texts(ROOT, CONFIG)}
    assert [name for name, text in captions.items() if len(text) < 20 or "hat}" in text or ":math:" in text] == []
    assert str(CONFIG["cases"]["unequal"]["f20_hat"]) in captions["fig10_09"]


@pytest.mark.parametrize(
    ("target", "parts"),
    [
        (
            "html",
            ["(10.25)", "<mfrac>", 'href="errata.html#misprints"', 'href="stability.html"', 'id="here"', '"#part"'],
        ),
        (
            "typst",
            [
                "(10.25)",
                "#link(<errata-misprints>)",
                "#link(<stability>)",
                "#link(<here-part>)",
                "<here>",
                "<here-part>",
            ],
        ),
    ],
)
def test_formulas_headings_and_links_for_both_readers(target, parts):
    links = "[e](errata.md#misprints), [s](stability.html), [p](#part)"
    source = f"# Title\n\n$$\\frac{{a}}{{b}} \\tag{{10.25}}$$\n\n{links}\n\n## Part\n"
    text = convert(source, target, SOURCES, KNOWN)
    assert [part for part in parts if part not in text] == []
    assert "tag" not in text.split("<annotation")[0]


def test_a_document_is_called_by_its_title_where_a_link_says_its_file_alone():
    known = KNOWN | {"titles": {"errata": "What is wrong in it"}}
    text = convert("# Title\n\n[errata.md](errata.md), [see](errata.md)\n", "html", SOURCES, known)
    assert re.findall(r'href="errata.html">(.*?)</a>', text) == ["What is wrong in it", "see"]


def test_no_line_ends_between_a_formula_and_the_marks_around_it():
    text = convert("# Title\n\nOf ($C$), $B$ and $L$.\n\n$$P$$\n", "html", SOURCES, KNOWN)
    kept = [re.sub("<annotation.*?</annotation>|<[^>]*>", "", part) for part in re.findall('kept">(.*?)</span>', text)]
    assert kept == ["(C),", "L."]


@pytest.mark.parametrize(("head", "heads"), [("must be", ["where", "must be", "why"]), ("$C_1$", [])])
def test_a_wide_table_is_read_as_cards_where_its_heads_can_be_said(head, heads):
    source = f"# Here\n\n| where | {head} | why |\n| --- | --- | --- |\n| (10.1) | x | {20 * 'because '} |\n"
    text = convert(source, "html", SOURCES, KNOWN)
    assert re.findall('data-of="(.*?)"', text) == heads
    assert ("cards" in text) == bool(heads)


def test_a_picture_beside_a_document_is_found_and_a_document_that_the_report_lacks_is_no_link():
    source = "# Title\n\n![What it is](motion.png)\n\n[see](errata.md), [sweeps](howto_sweep.md)\n"
    text = convert(source, "html", SOURCES, KNOWN | {"titles": {"errata": "Errata"}})
    assert 'src="figures/motion.png"' in text
    assert re.findall(r'href="(.*?)"', text) == ["errata.html"]
    assert "sweeps" in text


@pytest.mark.parametrize("target", ["html", "typst"])
def test_figures_of_the_results_are_those_of_the_report(target):
    source = "# Title\n\n![What it is](../results/figures/one.png)\n\n[two](../results/accuracy/two.png)\n"
    text = convert(source, target, SOURCES, KNOWN)
    assert "figures/one.svg" in text
    assert ("figures/two.svg" in text) == (target == "html")
    assert "results" not in text


def test_bars_are_delimiters():
    text = convert("# Title\n\n$\\|f\\|_2 \\le |a_1| + |b|$, $\\lvert x\\rvert$\n", "typst", SOURCES, KNOWN)
    assert text.count("lr(bar.v.double f bar.v.double)") == 1
    assert "parallel" not in text
    assert "\\|" not in text


def test_an_equation_number_at_the_start_of_a_line_begins_no_list():
    assert "<ol" not in convert("# Title\n\n(3) holds.\n", "html", SOURCES, KNOWN)


@pytest.mark.parametrize(("target", "error"), [("html", LatexError), ("typst", RuntimeError)])
def test_a_formula_that_cannot_be_set_is_an_error(target, error):
    with pytest.raises(error, match="nosuchcommand"):
        convert("# Title\n\n$\\nosuchcommand{x}$\n", target, SOURCES, KNOWN)


def claims(tmp_path, *places):
    entries = [{"id": str(n), "place": place, "statement": "", "verdict": "holds"} for n, place in enumerate(places)]
    (tmp_path / "claims.json").write_text(json.dumps(entries))
    return Results(tmp_path)


@pytest.mark.parametrize(
    ("figure", "found"),
    [("fig10_01", []), ("fig10_06", ["0", "1"]), ("fig10_10", ["2"]), ("fig10_11", ["2", "3"])],
)
def test_claims_are_found_by_the_figure_they_name(tmp_path, figure, found):
    results = claims(tmp_path, "Fig. 10.6", "figures 10.6 and 10.9", "Figs. 10.10 and 10.11", "figure 10.11", "(10.6)")
    assert [claim["id"] for claim in results.claims_about(figure)] == found


def test_the_section_of_a_statement_is_the_one_it_is_listed_under():
    text = (ROOT / "docs/claims.yaml").read_text(encoding="utf-8")
    listed = re.findall(r"^# Section (\S+)|^  place: (.+)$", text, flags=re.MULTILINE)
    section, places = None, 0
    for heading, place in listed:
        section = heading or section
        if place:
            assert section_of(place) == section, place
            places += 1
    assert places > 40


def test_verdicts_are_counted_in_their_order_with_misprints_last():
    given = ["misprint"] * 3 + ["refuted", "holds", "refuted"]
    assert verdicts([{"verdict": verdict} for verdict in given]) == [("holds", 1), ("refuted", 2), ("misprint", 3)]


def test_the_slider_of_epsilon_knows_points_without_an_orbit():
    """Called stable, and told apart: the exact orbit is stable, unstable, or there is none."""
    exact = ["stable", "unstable", "no orbit", "no orbit"]
    table = pd.DataFrame({"epsilon": 0.1, "f10_hat": [1.0, 2.0, 3.0, 4.0], "f20_hat": 0.5, "exact": exact})
    table = table.assign(printed_10_26=["stable"] * 3 + ["unstable"], fast="stable", slow="unstable", theory="unstable")
    grid = {"f10_range": [0, 4], "f20_range": [0, 4], "points": 4}
    results = SimpleNamespace(table=lambda name: table.copy())
    data = json.loads(verdict_data(results, {"stability": {"verdict_grid": grid}}))
    assert data["printed_10_26"] == [[[1.0, 0.5, "stable"], [2.0, 0.5, "unstable"], [3.0, 0.5, "no orbit"]]]
    assert data["theory"] == [[]]


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("f20 of P1 = S1", r"$\hat f_{20}$ of $P_{1}$ \= $S_{1}$"),
        ("residual of B_min at C_min", r"residual of $B_{\min}$ at $C_{\min}$"),
        ("all C >= 0", r"all $C$ $\ge$ 0"),
        ("sigma_e_hat, f20_hat", r"$\hat \sigma_{e}$\, $\hat f_{20}$"),
        ("at tau = 1", r"at $\tau$ \= 1"),
        ("no formula: $x$", r"no formula\: \$x\$"),
    ],
)
def test_letters_of_the_chapter_are_set_in_names_of_numbers(name, said):
    assert named(name) == said


def test_a_figure_without_files_is_refused(tmp_path):
    with pytest.raises(ValueError, match="fig10_99"):
        Results(tmp_path).files("fig10_99")


def test_numbers_of_documents_are_those_of_the_build(tmp_path):
    """To as many decimals as a document gives, with its sign; where a build has no such value, as it is written."""
    values = {"a": 0.70984, "b": -3.17987, "c": 0.6916}
    results = SimpleNamespace(judged=True, value=lambda file, name: values[name])
    pages = Pages(ROOT, results, SETTINGS, CONFIG, {})
    pages.root = tmp_path
    (tmp_path / "docs").mkdir()
    text = "0.69<!-- x.csv | a -->, −3.2<!-- x.csv | b -->; 70<!-- percent | x.csv | c --> %, 5<!-- x.csv | d -->."
    (tmp_path / "docs/some.md").write_text(text, encoding="utf-8")
    shown = pages.markdown({"source": "docs/some.md"}, "html")
    assert re.findall(r'popovertarget="[^"]+">([^<]+)</button>', shown) == ["0.71", "−3.2", "69"]
    assert shown.endswith("5.")


def test_titles_of_cases_go_into_the_words_of_figures():
    own = {"notebook": "simulation", "model": "simulation", "case": "weak"}
    cases = CONFIG["cases"] | {"weak": CONFIG["cases"]["weak"] | {"title": "A b (c)"}}
    said = figure_texts(ROOT, CONFIG | {"cases": cases, "figures": CONFIG["figures"] | {"mine": own}})["mine"]
    assert all("A b" in said[name] and "weak" not in said[name] for name in ("title", "caption", "alt"))
