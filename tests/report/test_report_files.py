"""The report as files: links lead somewhere, data are those of the build, the PDF holds the same pages."""

import json
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit
from zipfile import ZipFile

import pandas as pd
import pytest
import yaml

from pipeline_trees import ROOT

SETTINGS = yaml.safe_load((ROOT / "report/report.yaml").read_text(encoding="utf-8"))
PAGES = [page["name"] for page in SETTINGS["pages"]]
MEGABYTE = 1e6


class Page(HTMLParser):
    """The links of a page, what it loads, and its names."""

    def __init__(self, path):
        super().__init__()
        self.links, self.names = [], []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.links += [attrs[name] for name in ("href", "src", "srcset", "data", "poster") if attrs.get(name)]
        if "id" in attrs:
            self.names.append(attrs["id"])


@pytest.fixture(scope="module")
def pages(site):
    return {path.name: Page(path) for path in site.glob("*.html")}


def test_all_pages_are_there(pages):
    assert set(pages) == {f"{name}.html" for name in PAGES}


@pytest.mark.parametrize("name", PAGES)
def test_links_are_alive(site, pages, name):
    page = pages[f"{name}.html"]
    assert len(page.links) > len(PAGES)  # the navigation at least
    assert len(page.names) == len(set(page.names))
    for link in page.links:
        parts = urlsplit(link)
        if parts.scheme == "data":
            continue
        assert not parts.scheme, f"{link} leads to another host"
        assert not parts.netloc, f"{link} leads to another host"
        target = unquote(parts.path) or f"{name}.html"
        assert (site / target).is_file(), f"{link} leads nowhere"
        if parts.fragment:
            assert parts.fragment in pages[target].names, f"{link} leads to no place on its page"


def test_every_table_of_a_figure_can_be_downloaded(site, pages):
    offered = {link for page in pages.values() for link in page.links}
    made = [path for folder in ("figures", "accuracy", "travel") for path in (site.parent / folder).glob("*.csv")]
    assert len(made) > 10
    for path in (path for path in made if "full" not in path.stem):
        assert f"figures/{path.name}" in offered
        assert (site / "figures" / path.name).read_bytes() == path.read_bytes()


def test_further_tables_can_be_downloaded(site, pages):
    for name in ("fixed_points.csv", "orbits.csv", "claims.json"):
        assert f"data/{name}" in pages["rerun.html"].links
        assert (site / "data" / name).read_bytes() == (site.parent / name).read_bytes()


def test_numbers_on_a_page_are_those_of_the_results(site):
    html = (site / "fixed_points.html").read_text(encoding="utf-8")
    points = pd.read_csv(site.parent / "fixed_points.csv")
    for value in points["C1"]:
        assert f"<td>{float(f'{value:.5g}'):.15g}</td>" in html
    claims = json.loads((site.parent / "claims.json").read_text(encoding="utf-8"))
    rows = (site / "claims.html").read_text(encoding="utf-8").count("<tr>")
    assert rows >= len(claims) > 24


@pytest.mark.parametrize(
    ("page", "folder", "figures", "number"),
    [
        ("figures", "figures", "fig10_", 11),
        ("companions", "figures", "companion_", 9),
        ("accuracy", "accuracy", ("work_precision", "hazards"), 2),
    ],
)
def test_every_figure_tells_where_it_comes_from_and_what_it_cost(site, page, folder, figures, number):
    html = (site / f"{page}.html").read_text(encoding="utf-8")
    sidecars = sorted((site.parent / folder).glob("*.provenance.json"))
    shown = [path for path in sidecars if path.name.startswith(figures)]
    assert len(shown) == number
    for path in shown:
        record = json.loads(path.read_text(encoding="utf-8"))
        assert str(record["lock"])[:12] in html
    assert html.count("Where it comes from") == number
    assert html.count("MB of memory") >= number
    assert "not recorded" not in html


def test_the_pdf_is_whole_and_the_report_is_light(site):
    pdf = (site / "report.pdf").read_bytes()
    assert pdf.startswith(b"%PDF")
    assert pdf.rstrip().endswith(b"%%EOF")
    assert 0.3 * MEGABYTE < len(pdf) < 10 * MEGABYTE
    assert (site / "motion.html").stat().st_size < 1.5 * MEGABYTE
    assert sum(path.stat().st_size for path in site.rglob("*") if path.is_file()) < 60 * MEGABYTE


def test_snakemake_makes_a_report_of_its_own_with_captions_and_categories(reported, tmp_path):
    reported.snakemake("--report", str(tmp_path / "all.zip"), "report")
    with ZipFile(tmp_path / "all.zip") as archive:
        (html,) = (archive.read(name).decode() for name in archive.namelist() if name.endswith("report.html"))
    for category in ("Figures of the chapter", "Companion figures", "Accuracy and speed", "Tables", "Fixed points"):
        assert category in html
    for figure in (f"fig10_{number:02d}" for number in range(1, 12)):
        assert f"{figure}.svg" in html
    assert "The vibro-impact system" in html
    assert "Accuracy against speed" in html
