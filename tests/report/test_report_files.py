"""The report as files: links lead somewhere, data are those of the build, the PDF holds the same pages."""

import json
import re
import unicodedata
from html import unescape
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit
from zipfile import ZipFile

import numpy as np
import pandas as pd
import pypdfium2 as pdfium
import pytest
import yaml
from fontTools.ttLib import TTFont

import vibroimpact as vi
from pipeline_trees import ROOT
from vibroimpact_pipeline.data_dictionary import files, read
from vibroimpact_pipeline.report.api import documented
from vibroimpact_pipeline.report.mathematics import FONT

SETTINGS = yaml.safe_load((ROOT / "report/report.yaml").read_text(encoding="utf-8"))
PAGES = [page["name"] for page in SETTINGS["pages"]]
CONFIG = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
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
    assert set(pages) == {f"{name}.html" for name in [*PAGES, "search"]}


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


def test_every_page_says_first_what_it_may_do(site):
    """Notebooks and the library among them."""
    pages = list(site.rglob("*.html"))
    assert len(pages) > 2 * len(PAGES)
    policy = '<head>\n<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; '
    assert [page for page in pages if policy not in page.read_text(encoding="utf-8")] == []


@pytest.fixture(scope="module")
def library(site):
    """The pages on the library, by the part that they show."""
    return {path.stem: Page(path) for path in (site / "api").glob("*.html")}


def test_every_module_that_is_shown_has_a_place_and_no_link_leads_outside(site, pages, library):
    names = {name for page in library.values() for name in page.names}
    assert {f"module-{name}" for name in documented(SETTINGS["api"]["left_out"])} <= names
    for name, page in library.items():
        for link in page.links:
            parts = urlsplit(link)
            assert not parts.scheme or parts.scheme == "data", link
            target = (site / "api" / unquote(parts.path)).resolve() if parts.path else site / f"api/{name}.html"
            assert target.is_file(), f"{name}: {link} leads nowhere"
            if parts.fragment:
                known = (library[target.stem] if target.parent.name == "api" else pages[target.name]).names
                assert parts.fragment in known, f"{name}: {link} leads to no place on its page"


def test_the_pages_on_the_library_have_its_public_names(library):
    public = {f"vibroimpact.{name}" for name in vi.__all__ if callable(getattr(vi, name))}
    assert len(public) > 8
    assert public <= set(library["vibroimpact"].names)
    theory = {"B_of_C", "C_min", "impact_phase"}
    assert {f"vibroimpact.theory.manifold.{name}" for name in theory} <= set(library["vibroimpact.theory"].names)


def test_data_of_the_report_are_in_the_dictionary(reported):
    listed = files(*read(ROOT))
    made = [path for name in ("animations", "force_sweep") for path in (reported / f"results/{name}").glob("*.*")]
    data = [path for path in made if path.suffix in (".csv", ".json")]
    assert len(data) == len(CONFIG["report"]["animations"]) + 2
    for path in data:
        (file,) = (file for file in listed if file.has(str(path.relative_to(reported.path))))
        found = pd.read_csv(path).columns if path.suffix == ".csv" else json.loads(path.read_text(encoding="utf-8"))
        assert list(found) == list(file.columns or file.keys)


def test_every_figure_is_shown(site, pages):
    shown = {link.split("/")[-1] for page in pages.values() for link in page.links}
    assert {path.name for path in (site / "figures").glob("*.svg")} <= shown
    assert {f"fig10_{number:02d}.svg" for number in range(1, 12)} <= shown


def test_every_table_of_a_figure_can_be_downloaded(site, pages):
    offered = {link for page in pages.values() for link in page.links}
    made = [path for folder in ("figures", "accuracy", "force_sweep") for path in (site.parent / folder).glob("*.csv")]
    assert len(made) > 10
    for path in (path for path in made if path.with_suffix(".provenance.json").exists()):
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


def test_models_are_told_in_words(site):
    """No entry of the table that is behind it, as a program writes it, is left on the page."""
    html = (site / "accuracy.html").read_text(encoding="utf-8")
    table = html[html.index('id="scene_models"') :]
    assert [raw for raw in ("True", "False", "nan", "inf<", "closed_form") if raw in table] == []
    assert re.findall(r"\d\.\d{5}", table) == []
    for told in ("cannot show it", "✓ yes", "✗ no", "<strong>proven simulation</strong>"):
        assert told in table


def test_the_font_that_is_shipped_has_every_sign_of_a_formula(site):
    """And every letter in italics too, as which browsers draw it."""
    signs = set(map(chr, TTFont(FONT).getBestCmap()))
    shown = set()
    for path in [*site.glob("*.html"), *site.glob("notebooks/*.html")]:
        for formula in re.findall("<math.*?</math>", path.read_text(encoding="utf-8"), re.DOTALL):
            shown |= set(unescape(re.sub("<annotation.*?</annotation>|<[^>]*>", "", formula)))
            shown |= {"√"} if "<msqrt" in formula else set()  # drawn by the browser, with the sign of the font
    assert len(shown) > 100
    assert [sign for sign in shown - signs if not sign.isspace()] == []
    upright = {unicodedata.normalize("NFKD", sign) for sign in signs if "ITALIC" in unicodedata.name(sign, "")}
    assert [letter for letter in shown if re.fullmatch("[A-Za-zα-ω]", letter) and letter not in upright | {"h"}] == []


@pytest.mark.parametrize(
    ("page", "folder", "figures", "number"),
    [
        ("figures", "figures", ("fig10_", "machines"), 12),
        ("companions", "figures", "companion_", 17),
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
        assert record["code"]["lock"] in html
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


@pytest.fixture(scope="module")
def paper(site):
    return pdfium.PdfDocument(site / "report.pdf")


def test_the_pdf_begins_with_an_abstract_and_the_date_of_the_commit(site, paper):
    first = " ".join(paper[0].get_textpage().get_text_bounded().split())
    assert "Abstract" in first
    index = (site / "index.html").read_text(encoding="utf-8")
    footer = re.search(r'<div class="built"><p>(.*?) <a', index)[1]
    assert footer in first
    assert re.search(r" of \d{4}-\d\d-\d\d\.$", footer) or "without its history" in footer


def test_on_paper_there_is_nothing_to_move(paper):
    words = "".join(page.get_textpage().get_text_bounded() for page in paper)
    assert "Over the second force" in words
    assert [told for told in ("Move the force", "arrow keys") if told in words] == []


def test_the_pdf_is_an_article_with_appendices(paper):
    assert len(paper) <= 25


def test_no_page_of_the_pdf_is_nearly_empty(paper):
    """But for the last one: ink reaches down to a fourth of the page."""
    for page in list(paper)[:-1]:
        dark = page.render(scale=0.25).to_numpy().min(axis=(1, 2))[: int(0.93 * page.get_height() * 0.25)] < 200
        assert np.flatnonzero(dark).max() > 0.25 * len(dark)


def test_nothing_is_printed_over_anything_else(paper):
    for number, page in enumerate(paper, start=1):
        text = page.get_textpage()
        boxes = np.array([text.get_rect(k) for k in range(text.count_rects())])
        left, bottom, right, top = boxes.T[:, :, None]
        across = np.minimum(right, right.T) - np.maximum(left, left.T)
        down = np.minimum(top, top.T) - np.maximum(bottom, bottom.T)
        over = np.triu((across > 4) & (down > 3.5), k=1)
        assert not over.any(), (number, [text.get_text_bounded(*boxes[k]) for k in np.argwhere(over)[0]])


def test_snakemake_makes_a_report_of_its_own_with_captions_and_categories(reported, tmp_path):
    reported.snakemake("--report", str(tmp_path / "all.zip"), "report")
    with ZipFile(tmp_path / "all.zip") as archive:
        (html,) = (archive.read(name).decode() for name in archive.namelist() if name.endswith("report.html"))
    for category in ("Figures of the chapter", "Companion figures", "Accuracy and speed", "Tables", "Fixed points"):
        assert category in html
    for figure in (f"fig10_{number:02d}" for number in range(1, 12)):
        assert f"{figure}.svg" in html
    assert "This page holds what one run of the pipeline made of it" in html
    assert "The vibro-impact system" in html
    assert "Accuracy against speed" in html


def test_an_equation_of_the_chapter_is_explained_where_it_is_named(site):
    assert list(SETTINGS["equations"]) == [f"10.{n}" for n in range(1, 27)]
    for name in PAGES:
        html = (site / f"{name}.html").read_text(encoding="utf-8")
        assert not re.search(r'<(h[1-6]|a)\b[^>]*>[^<]*<span class="equation"', html)  # names in navigation and search
    article = (site / "index.html").read_text(encoding="utf-8")
    said = re.findall(r'<span class="equation" title="([^"]+)">\(10\.26\)</span>', article)
    assert said
    assert all("C_i &gt; 4 / (4 + π ρ)" in one for one in said)
