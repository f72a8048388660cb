"""One real run of the pipeline: every file of the contract is there, whole, and says what it should."""

import re
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import pandas as pd
import pytest
from PIL import Image

from vibroimpact_pipeline import results_page

FIGURES = [*(f"fig10_{number:02d}" for number in range(1, 12)), "machines"]
WITH_TABLE = FIGURES[2:]


@pytest.mark.parametrize("figure", FIGURES)
def test_a_figure_comes_as_png_pdf_and_svg(built, figure):
    files = built / "results/figures"
    with Image.open(files / f"{figure}.png") as picture:
        picture.load()
        assert picture.width >= 84 / 25.4 * 300  # a column at print resolution
        assert len(picture.convert("L").getcolors()) > 2
    pdf = (files / f"{figure}.pdf").read_bytes()
    assert pdf.startswith(b"%PDF")
    assert pdf.rstrip().endswith(b"%%EOF")
    assert ElementTree.parse(files / f"{figure}.svg").getroot().tag.endswith("svg")


@pytest.mark.parametrize("figure", WITH_TABLE)
def test_a_figure_comes_with_the_numbers_it_plots(built, figure):
    table = pd.read_csv(built / f"results/figures/{figure}.csv")
    assert {"panel", "series"} <= set(table.columns)
    numbers = table.select_dtypes("number")
    assert len(table) > 5
    assert numbers.notna().any(axis=1).all()


def test_drawings_have_no_table(built):
    tables = {path.name for path in (built / "results/figures").glob("fig*.csv")}
    assert tables == {f"{figure}.csv" for figure in WITH_TABLE[:-1]} | {"fig10_11.statistics.csv"}


def test_fixed_points_of_all_cases_are_gathered(built):
    table = pd.read_csv(built / "results/fixed_points.csv")
    assert list(table.columns)[:8] == ["case", "label", "C1", "C2", "B1", "B2", "psi1", "psi2"]
    assert {"printed_10_26", "masri_derived", "slow_flow", "floquet"} < set(table.columns)
    labels = table.groupby("case")["label"].agg("".join).to_dict()
    assert labels == {"equal": "abc", "unequal": "abc", "weak": "a"}  # three, three and one, section 10.4


def test_only_simulations_that_a_figure_shows_are_run(built):
    assert {path.name for path in (built / "results/simulations").iterdir()} == {"equal", "weak"}


class Resources(HTMLParser):
    """Everything that a page would fetch."""

    def __init__(self):
        super().__init__()
        self.fetched, self.tags = [], set()

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        wanted = {"src", "srcset", "data", "poster", "action", "background"} | ({"href"} if tag == "link" else set())
        self.fetched += [value for name, value in attrs if name in wanted and not value.startswith("data:")]


@pytest.mark.parametrize("figure", FIGURES)
def test_a_page_reads_offline_with_its_formulas_and_its_figure(built, figure):
    html = (built / f"results/notebooks/{figure}.html").read_text(encoding="utf-8")
    page = Resources()
    page.feed(html)
    assert page.fetched == []
    assert "script" not in page.tags
    assert "@import" not in html
    assert "url(http" not in html
    assert {"h1", "math", "img"} <= page.tags
    assert "$$" not in html


@pytest.mark.parametrize("figure", FIGURES)
def test_a_page_says_once_what_the_exact_system_says(built, figure):
    html = (built / f"results/notebooks/{figure}.html").read_text(encoding="utf-8")
    assert html.count("<strong>The exact system:</strong>") == 1


@pytest.mark.parametrize(("figure", "case"), [("fig10_06", "equal"), ("fig10_09", "unequal"), ("fig10_10", "weak")])
def test_a_page_of_fixed_points_says_the_verdict_of_the_multipliers(built, figure, case):
    html = (built / f"results/notebooks/{figure}.html").read_text(encoding="utf-8")
    line = re.search("<p><strong>The exact system:</strong>(.*?)</p>", html, re.DOTALL)[1]
    orbits = pd.read_csv(built / "results/orbits.csv").query("case == @case").set_index("label")["modulus_1"]
    shown = re.findall(r"orbit (\w+)", line)
    assert shown
    assert all(orbits[orbit] > 1 for orbit in shown)  # proved: no symmetric response of the three cases is stable
    assert "<strong>unstable</strong>" in line
    assert "<strong>stable</strong>" not in line


def test_the_page_of_results_leads_to_all_of_them(built, tmp_path, monkeypatch):
    """Written anew: a build with nothing to do leaves the page as it is."""
    monkeypatch.chdir(tmp_path)
    results = Path("results")
    results.mkdir()
    for path in (built / "results").iterdir():
        (results / path.name).symlink_to(path)
    (results / "index.html").unlink(missing_ok=True)
    results_page.write({path.stem: path.stem for path in sorted(results.glob("*/*.png"))})
    html = (results / "index.html").read_text(encoding="utf-8")
    links = re.findall('href="([^"]+)"', html)
    assert [link for link in links if not (results / link).is_file()] == []
    assert {f"notebooks/{figure}.html" for figure in FIGURES} | {"claims.md", "orbits.csv"} <= set(links)
    assert {f"figures/{path.name}" for path in (results / "figures").glob("*.png")} <= set(links)
    assert html.count("<strong>The exact system:</strong>") == len(FIGURES)


def test_every_job_leaves_a_log_and_a_benchmark(built):
    jobs = {f"figures/{figure}" for figure in FIGURES} | {
        f"fixed_points/{case}" for case in ("equal", "unequal", "weak")
    }
    jobs |= {f"{stage}/{case}" for stage in ("orbits", "verdicts") for case in ("equal", "unequal", "weak")}
    jobs |= {"simulations/equal", "simulations/weak", "gather_fixed_points", "gather_orbits", "proofs", "claims"}
    found = {}
    for folder, suffix in (("logs", ".log"), ("benchmarks", ".tsv")):
        files = (built / f"results/{folder}").rglob(f"*{suffix}")
        found[folder] = {str(path.relative_to(built / f"results/{folder}").with_suffix("")) for path in files}
    assert jobs <= found["logs"]
    assert found["logs"] == found["benchmarks"]


def test_nothing_half_written_is_left(built):
    assert not [path for path in (built / "results").rglob("*") if "partial" in path.name or path.name.startswith(".")]


def test_a_build_with_nothing_to_do_loads_nothing_that_computes_or_draws(built):
    """Loading it takes longer than all the rest."""
    output = built.snakemake(PYTHONPROFILEIMPORTTIME="1")
    assert "Nothing to do" in output
    imported = set(re.findall(r"^import time:.*\| +(\S+)$", output, re.MULTILINE))
    assert {"snakemake.cli", "vibroimpact_pipeline.sources"} <= imported
    assert not imported & {"matplotlib", "numba", "scipy"}
