"""Files of the report: links have targets, data are those of the build, and the PDF contains the findings."""

import json
import re
import unicodedata
from html import unescape
from urllib.parse import unquote, urlsplit

import pandas as pd
import pypdfium2 as pdfium
import pytest
import yaml
from fontTools.ttLib import TTFont

from configs import GOOD as CONFIG
from hostile import Markup
from pipeline_trees import ROOT
from vibroimpact_pipeline.html.figure_texts import figure_texts
from vibroimpact_pipeline.html.mathematics import FONT

SETTINGS = yaml.safe_load((ROOT / "report/report.yaml").read_text(encoding="utf-8"))
PAGES = sorted(
    path.stem for folder in ("docs", "docs/studies", "report/pages") for path in (ROOT / folder).glob("*.md")
)
MEGABYTE = 1e6


@pytest.fixture(scope="module")
def pages(site):
    """Return the parsed pages by path."""
    return {path: Markup(path.read_text(encoding="utf-8")) for path in [*site.glob("*.html"), *site.glob("api/*.html")]}


def test_the_report_has_all_pages(site, pages):
    assert {path.stem for path in pages if path.parent == site} == {*PAGES, "search"}


def test_links_have_targets_in_the_report(pages):
    names = {path: [values["id"] for _, values in page.elements if "id" in values] for path, page in pages.items()}
    for path, page in pages.items():
        assert len(page.links) > len(PAGES)  # the navigation at least
        assert len(names[path]) == len(set(names[path]))
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme == "data":
                continue
            assert not parts.scheme + parts.netloc, f"{path}: {link} leads to another host"
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            assert target.is_file(), f"{path}: {link} leads nowhere"
            if parts.fragment and target in pages:
                assert parts.fragment in names[target], f"{path}: {link} leads to no place on its page"


def test_every_page_has_a_content_security_policy_and_is_small(site):
    """The policy precedes everything that a page loads, also in notebooks and in the library reference."""
    pages = list(site.rglob("*.html"))
    assert len(pages) > len(PAGES) + 10
    for path in pages:
        before, found, _ = path.read_text(encoding="utf-8").partition('<meta http-equiv="Content-Security-Policy"')
        assert found, path
        assert "<link" not in before
        assert "<script" not in before
        assert path.stat().st_size < 2 * MEGABYTE
    assert sum(path.stat().st_size for path in site.rglob("*") if path.is_file()) < 60 * MEGABYTE


def test_every_figure_is_shown_and_every_table_can_be_downloaded(site, pages):
    offered = {link for page in pages.values() for link in page.links}
    made = [path for folder in ("figures", "accuracy") for path in (site.parent / folder).glob("*.csv")]
    shown = {link.split("/")[-1] for link in offered if link.startswith("_images/")}
    assert {path.name for path in (site / "figures").glob("*.svg")} <= shown
    assert {f"fig10_{number:02d}.svg" for number in range(1, 12)} <= shown
    tables = [path for path in made if (site / "figures" / path.with_suffix(".svg").name).exists()]
    assert len(tables) > 10
    for path, folder in [*((path, "figures") for path in tables), (site.parent / "orbits.csv", "data")]:
        assert f"{folder}/{path.name}" in offered
        assert (site / folder / path.name).read_bytes() == path.read_bytes()


def test_numbers_on_a_page_are_those_of_the_results_and_name_their_source(site):
    html = (site / "fixed_points.html").read_text(encoding="utf-8")
    for value in pd.read_csv(site.parent / "fixed_points.csv")["C1"]:
        assert f">{float(f'{value:.5g}'):.15g}<" in html
    claims = json.loads((site.parent / "claims.json").read_text(encoding="utf-8"))
    page = (site / "claims.html").read_text(encoding="utf-8")
    assert sorted(re.findall(r'href="#claim-([\w-]+)"', page)) == sorted(claim["id"] for claim in claims)
    assert len(re.findall(r'<details class="[^"]*" id="claim-', page)) == len(claims)
    (distance,) = (claim["numbers"]["largest error of C"] for claim in claims if claim["id"] == "periodic-solutions")
    article, numbers = ((site / f"{name}.html").read_text(encoding="utf-8") for name in ("findings", "numbers"))
    assert re.search(rf'href="numbers.html#number-largest-distance">(<[^>]+>)*{distance:.3f}<', article)
    assert f"{distance:.6g}: " in numbers
    source = "results/claims.json | periodic-solutions | numbers | largest error of C"
    assert source in re.sub("<[^>]+>", "", numbers)


def test_the_font_of_the_report_has_every_character_of_its_formulas(site):
    """It also has the letters in italics, since browsers draw the letters of formulas in italics."""
    signs = set(map(chr, TTFont(FONT).getBestCmap()))
    shown = set()
    for path in [*site.glob("*.html"), *site.glob("notebooks/*.html")]:
        for formula in re.findall("<math.*?</math>", path.read_text(encoding="utf-8"), re.DOTALL):
            shown |= set(unescape(re.sub("<annotation.*?</annotation>|<[^>]*>", "", formula)))
            shown |= {"√"} if "<msqrt" in formula else set()  # drawn by the browser with this character
    assert len(shown) > 100
    assert [sign for sign in shown - signs if not sign.isspace()] == []
    upright = {unicodedata.normalize("NFKD", sign) for sign in signs if "ITALIC" in unicodedata.name(sign, "")}
    assert [letter for letter in shown if re.fullmatch("[A-Za-zα-ω]", letter) and letter not in upright | {"h"}] == []


def test_the_article_is_a_pdf_with_its_numbers_and_pictures(site):
    document = pdfium.PdfDocument(site / "findings.pdf")
    words = " ".join("".join(page.get_textpage().get_text_bounded() for page in document).split())
    article = (ROOT / "docs/studies/findings.md").read_text(encoding="utf-8")
    title, *headings = re.findall("^#+ (.*)", article, re.MULTILINE)
    assert words.startswith(title)
    assert [heading for heading in headings if heading not in words] == []
    assert re.search(r"Built from (commit .* of \d{4}-\d\d-\d\d|a copy without git history)\.", words)
    assert "numbers.yaml" not in words
    assert len(document) < 20
    titles = [figure_texts(CONFIG)[f"fig10_{number:02d}"]["title"] for number in range(2, 12)]
    assert [title for title in titles if title.split(". ")[0] + "." not in words] == []
    assert "press" not in words
    drawn = [kind.type for page in document for kind in page.get_objects()]
    assert len(drawn) > 1000  # pictures are vectors


def test_an_equation_of_the_chapter_links_to_its_explanation(site):
    assert list(SETTINGS["equations"]) == [f"10.{n}" for n in range(1, 27)]
    for name in PAGES:
        html = (site / f"{name}.html").read_text(encoding="utf-8")
        assert not re.search(r"<(h[1-6]|a)\b[^>]*>[^<]*<a [^>]*#equation-", html)  # not in headings and links
    links = re.findall(r'href="([^"]+)"[^>]*>\(10\.26\)</a>', (site / "findings.html").read_text(encoding="utf-8"))
    assert set(links) == {"numbers.html#equation-10-26"}
    explained = (site / "numbers.html").read_text(encoding="utf-8").partition('id="equation-10-26"')[2]
    assert "C_i &gt; 4 / (4 + π ρ)" in explained[:300]
