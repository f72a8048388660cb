"""The report as a reader's browser shows it."""

import re
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest
import yaml

from pipeline_trees import ROOT
from vibroimpact_pipeline.config import read
from vibroimpact_pipeline.report.results import Results

SETTINGS = yaml.safe_load((ROOT / "report/report.yaml").read_text(encoding="utf-8"))
ANIMATIONS = read(ROOT / "config/config.yaml")["report"]["animations"]
PAGES = [page["name"] for page in SETTINGS["pages"]]
LIBRARY = ["api/vibroimpact"]
WITH_MATHEMATICS = ["figures", "stability", "derivation", "errata"]
NARROW = 400


def address(site, page):
    return (site / f"{page}.html").as_uri()


PROSE = """[...document.querySelectorAll('article p, article li, article td, article h1, article h2, article h3')].map(
  block => [...block.childNodes].filter(n => n.nodeName !== 'CODE').map(n => n.textContent).join('')
).join('\\n')"""


@pytest.mark.parametrize("page", PAGES + LIBRARY)
def test_a_page_opens_without_trouble_and_can_be_read_by_everybody(browser, site, page):
    """It asks nobody else; axe finds no barrier; pictures are described, headings in order; a narrow window fits it."""
    browser.open(address(site, page))
    assert browser.problems == []
    assert address(site, page) in browser.requests
    assert [url for url in browser.requests if not url.startswith((site.as_uri(), "data:"))] == []
    browser.page.emulate_media(color_scheme="dark")
    assert browser.barriers(runOnly=["color-contrast"]) == []
    browser.page.emulate_media(color_scheme="light")
    assert browser.barriers() == []
    if page in PAGES:
        pictures = browser.run(
            "[...document.images].map(i => [i.getAttribute('src'), i.complete && i.naturalWidth, i.alt])"
        )
        assert [name for name, width, alt in pictures if not width or len(alt) < 20] == []
        unnamed = (
            "[...document.querySelectorAll('article svg')].filter(s => !(s.getAttribute('aria-label') || '').trim())"
        )
        assert browser.run(f"{unnamed}.length") == 0
        text = browser.run(PROSE)
        assert [sign for sign in ("$", "\\frac", "\\tag", "\\hat") if sign in text] == []
        assert_order(browser)
    browser.resize(NARROW)
    assert browser.run("document.documentElement.scrollWidth") <= NARROW
    assert browser.barriers(rules={"color-contrast": {"enabled": False}}) == []


def assert_order(browser):
    """What those rely on who hear a page or go through it by keyboard."""
    assert browser.run("document.documentElement.lang") == "en"
    assert browser.run("document.title").endswith(SETTINGS["title"])
    levels = browser.run("[...document.querySelectorAll('h1, h2, h3, h4')].map(head => Number(head.tagName[1]))")
    assert levels.count(1) == 1
    assert all(after - before <= 1 for before, after in pairwise(levels))
    browser.press("Tab")
    assert "skip" in browser.run("document.activeElement.className")
    browser.press("Enter")
    assert browser.run("document.querySelector(location.hash).closest('article') !== null")


@pytest.mark.parametrize("figure", ["fig10_04", "fig10_06", "fig10_08"])
def test_a_notebook_reads_offline(browser, site, figure):
    url = (site / f"notebooks/{figure}.html").as_uri()
    browser.open(url)
    assert browser.problems == []
    assert [request for request in browser.requests if not request.startswith("data:")] == [url]
    heights = browser.run(
        "[...document.querySelectorAll('math')].map(formula => formula.getBoundingClientRect().height)"
    )
    assert heights
    assert min(heights) > 5
    assert browser.run("[...document.images].every(image => image.complete && image.naturalWidth > 100)")


def test_pages_are_found_by_words_and_one_after_the_other(browser, site):
    """From a disk, where a browser loads nothing by a program."""
    browser.open((site / "search.html").as_uri() + "?q=saltation")
    browser.page.wait_for_selector("#search-results a")
    found = browser.run("[...document.querySelectorAll('#search-results a')].map(a => a.getAttribute('href'))")
    assert {link.partition("?")[0].partition("#")[0] for link in found} & {f"{page}.html" for page in PAGES}
    assert browser.problems == []
    browser.open(address(site, "figures"))
    browser.run("document.querySelector('.next-page').click()")
    browser.page.wait_for_url("**/fixed_points.html")
    listed = browser.run("[...document.querySelectorAll('.sidebar-tree a')].map(a => a.getAttribute('href'))")
    assert {f"{page}.html" for page in PAGES if page != "fixed_points"} <= set(listed)


def test_a_notebook_folds_its_code_and_leads_back(browser, site):
    browser.open((site / "notebooks/fig10_08.html").as_uri(), width=NARROW)
    assert browser.run("document.title").startswith("Figure 10.8")
    assert browser.run("[...document.querySelectorAll('.input_area')].some(area => area.checkVisibility())") is False
    browser.run("document.querySelector('summary').click()")
    wide = "[...document.querySelectorAll('.input_area')].filter(a => a.scrollWidth > a.clientWidth).length"
    assert browser.run(wide) == 0
    assert browser.run("document.querySelector('.of a').getAttribute('href')") == "../figures.html#fig10_08"


def test_trouble_on_a_page_would_be_seen(browser, tmp_path):
    """The checks above can fail: a page with everything wrong on it."""
    page = tmp_path / "wrong.html"
    page.write_text(
        "<!DOCTYPE html><img src='missing.png'><img src='http://127.0.0.1:9/outside.png'>"
        "<script>console.error('said'); undefinedFunction();</script>"
    )
    browser.open(page.as_uri())
    found = " ".join(browser.problems)
    assert "ERR_FILE_NOT_FOUND" in found
    assert "said" in found
    assert "undefinedFunction" in found
    assert any(url.startswith("http://127.0.0.1") for url in browser.requests)


TALL_FORMULAS = """() => [...document.querySelectorAll('mfrac')].filter(fraction => {
  const [over, under] = [...fraction.children].map(part => part.getBoundingClientRect());
  return over.height > 0 && over.bottom <= under.top + 1;
}).length"""


@pytest.mark.parametrize("page", WITH_MATHEMATICS)
def test_mathematics_is_set(browser, site, page):
    browser.open(address(site, page))
    fractions = browser.run("document.querySelectorAll('mfrac').length")
    assert fractions > 0
    assert browser.run(f"({TALL_FORMULAS})()") == fractions


@pytest.mark.parametrize("page", ["derivation", "stability", "notebooks/fig10_06"])
def test_formulas_are_set_in_the_font_that_is_shipped_and_fit_a_desktop(browser, site, page):
    browser.open(address(site, page), width=1280)
    fonts = "document.fonts.ready.then(fonts => [...fonts].map(font => [font.family, font.status]))"
    assert [(name.strip('"'), status) for name, status in browser.run(fonts)] == [("STIX Two Math", "loaded")]
    lines = "[...document.querySelectorAll('math[display=block]')].map(formula => formula.parentElement)"
    assert browser.run(f"{lines}.length") > 0
    cut = f"{lines}.filter(line => line.scrollWidth > line.clientWidth)"
    assert browser.run(f"{cut}.length") <= 2
    hints = f"{lines}.every(line => getComputedStyle(line).backgroundImage.includes('gradient'))"
    assert page.startswith("notebooks") or browser.run(hints)


FIXED_POINTS = """(() => {
  const all = (kind) => [...document.querySelectorAll('[data-force-sweep] ' + kind)];
  return {
    value: all('output')[0].textContent,
    places: all('circle[data-label]').map(circle => ['cx', 'cy'].map(name => Number(circle.getAttribute(name)))),
    rows: all('tbody tr').map(row => [...row.cells].map(cell => cell.textContent)),
  };
})()"""


def found_C(shown):
    return sorted((float(row[1]), float(row[3])) for row in shown["rows"])


def expected_C(site, case):
    points = pd.read_csv(site.parent / f"fixed_points/{case}.csv")
    return sorted(zip(points["C1"], points["C2"], strict=True))


def test_the_control_moves_the_fixed_points_by_keyboard(browser, site):
    browser.open(address(site, "fixed_points"))
    start = browser.run(FIXED_POINTS)
    browser.run("document.querySelector('#f20').focus()")
    browser.press("ArrowLeft", times=11)
    moved = browser.run(FIXED_POINTS)
    assert (float(start["value"]), float(moved["value"])) == (1.0, 0.89)
    assert len(start["places"]) == len(moved["places"]) == 6
    gaps = [abs(a[0] - b[0]) for a, b in zip(start["places"], moved["places"], strict=True)]
    assert min(gaps) > 1.0  # each circle has moved by more than a pixel
    for case, shown in (("equal", start), ("unequal", moved)):
        for found, expected in zip(found_C(shown), expected_C(site, case), strict=True):
            assert found == pytest.approx(expected, abs=6e-4)
    browser.press("Home")
    assert len(browser.run(FIXED_POINTS)["rows"]) == 1


def test_the_points_stay_on_the_manifold(browser, site):
    browser.open(address(site, "fixed_points"))
    kappa = 0.65
    rho = 2 * (1 - kappa) / (3.141592653589793 * (1 + kappa))
    browser.run("document.querySelector('#f20').focus()")
    for _ in range(4):
        browser.press("ArrowRight", times=7)
        rows = browser.run(FIXED_POINTS)["rows"]
        assert rows
        for C, B in [(float(row[i]), float(row[i + 1])) for row in rows for i in (1, 3)]:
            on_manifold = 1 - 2 * C + (1 + rho**2) * C**2
            assert pytest.approx(on_manifold, abs=4e-3) == B**2


def test_a_disc_says_what_the_theory_says_and_its_ring_what_is_true(browser, site):
    """Both as in the table of the fixed points, whose letters are the chapter's."""
    browser.open(address(site, "fixed_points"))
    table = pd.read_csv(site.parent / "fixed_points.csv").query("case == 'equal'").sort_values("label")
    rows = browser.run(FIXED_POINTS)["rows"]
    assert [row[0] for row in rows] == table["label"].tolist() == ["a", "b", "c"]
    assert [row[7] for row in rows] == table["slow"].tolist()
    assert [row[9] for row in rows] == table["exact"].tolist()
    plane = "document.querySelector('[data-force-sweep] .planes svg')"
    discs = browser.run(
        f"[...{plane}.querySelectorAll('[data-label]')].map(c => [c.dataset.label, c.getAttribute('fill')])"
    )
    filled = [label for label, fill in discs if fill != "#fff"]
    assert filled == [row[0] for row in rows if row[8] == "stable"] == ["c"]
    assert browser.run(f"[...{plane}.querySelectorAll('[data-exact]')].map(c => c.dataset.exact)") == ["unstable"] * 3


PLANE = "document.querySelectorAll('[data-force-sweep] .planes svg')[1]"
LETTERS = f"""Object.fromEntries([...{PLANE}.querySelectorAll('[data-label]')].map(disc =>
  [disc.dataset.label, [disc.getAttribute('stroke'), Number(disc.getAttribute('cx'))]]))"""


def test_colour_and_letter_stay_with_a_branch(browser, site):
    """From step to step each letter keeps its colour, and its place but for a little; the others are further away."""
    browser.open(address(site, "fixed_points"))
    browser.run("document.querySelector('#f20').focus()")
    before = start = browser.run(LETTERS)
    for _ in range(28):
        browser.press("ArrowLeft")
        now = browser.run(LETTERS)
        assert {letter: hue for letter, (hue, _) in now.items()} == {letter: hue for letter, (hue, _) in start.items()}
        assert all(abs(now[letter][1] - place) < 6 for letter, (_, place) in before.items())
        before = now
    assert browser.run(FIXED_POINTS)["value"] == "0.72"
    assert [row[0] for row in browser.run(FIXED_POINTS)["rows"]] == ["a", "b", "c"]


@pytest.mark.parametrize("case", ["equal", "unequal"])
def test_badges_say_what_the_chapter_says_and_what_is_exact(browser, site, case):
    """By the chapter's letters of the case, which the badges give where a branch has another."""
    browser.open(address(site, "fixed_points"))
    browser.run(f"document.querySelectorAll('[data-force-sweep] button')[{int(case == 'unequal')}].click()")
    lines = browser.run("[...document.querySelectorAll('.badges li')].map(line => line.textContent)")
    table = pd.read_csv(site.parent / "fixed_points.csv").query("case == @case").set_index("label")
    found = {}
    for line in lines:
        name, order, chapter, exact = re.fullmatch(
            r"(\w+) (?:\((\w) in the chapter’s order\)|of asymmetric orbits)? ?the chapter says: (.+) exact: (.+)", line
        ).groups()
        found[order or name] = (chapter, exact)
    assert found.pop("pair") == ("nothing", "stable")
    assert found == {label: (row["printed_10_26"], row["exact"]) for label, row in table.iterrows()}


@pytest.mark.parametrize("value", [0.72, 0.81, 1.0, 1.2, 1.5])
def test_texts_of_the_multipliers_clear_the_circle(browser, site, value):
    browser.open(address(site, "fixed_points"))
    browser.run("document.querySelector('#f20').focus()")
    browser.press("ArrowLeft" if value < 1 else "ArrowRight", times=round(100 * abs(value - 1)))
    picture = "[...document.querySelectorAll('[data-force-sweep] .planes svg:nth-child(4) {}')]"
    boxes = f"{picture}.map(e => e.getBoundingClientRect())"
    texts = f"{boxes.format('[data-far]')}.map(box => [box.left, box.bottom])"
    drawn = f"Math.max(...{boxes.format('circle, rect[data-multiplier]')}.map(box => box.right))"
    frame = browser.run(f"{boxes.format('rect')}[0].bottom")
    for left, bottom in browser.run(texts):
        assert left > browser.run(drawn)
        assert bottom < frame


@pytest.mark.parametrize(("value", "said"), [(0.81, "Below 0.817"), (0.82, "Above 0.817"), (0.92, "From 0.913")])
def test_the_sentence_of_the_force_is_said(browser, site, value, said):
    """One at a time, and on paper all."""
    browser.open(address(site, "fixed_points"))
    browser.run("document.querySelector('#f20').focus()")
    browser.press("ArrowLeft", times=round(100 * (1 - value)))
    spoken = "[...document.querySelectorAll('.stations li')].filter(li => li.checkVisibility()).map(li => li.innerText)"
    (sentence,) = browser.run(spoken)
    assert sentence.startswith(said)
    browser.page.emulate_media(media="print")
    assert len(browser.run(spoken)) == 4
    browser.page.emulate_media(media="screen")


@pytest.mark.parametrize(("value", "outside"), [(0.81, 2), (0.82, 0)])
def test_the_multipliers_of_the_asymmetric_orbits_cross_the_unit_circle(browser, site, value, outside):
    """Where the sentence says so, as a pair; those of the symmetric orbits of the points are outside on both sides."""
    browser.open(address(site, "fixed_points"))
    browser.run("document.querySelector('#f20').focus()")
    browser.press("ArrowLeft", times=round(100 * (1 - value)))
    count = "document.querySelectorAll('[data-force-sweep] .planes svg:nth-child(4) {}').length"
    assert browser.run(count.format("rect[data-multiplier]")) == 8
    assert browser.run(count.format('rect[data-multiplier][fill="#fff"]')) == outside
    assert browser.run(count.format('circle[data-multiplier=unstable][fill="#fff"]')) >= 3


@pytest.mark.parametrize("criterion", ["theory", "printed_10_26"])
def test_the_slider_of_epsilon_shows_what_is_called_stable_and_is(browser, site, criterion):
    """As counted in the table; by both time scales means by Masri's analysis and the slow flow."""
    browser.open(address(site, "fixed_points"))
    table = pd.read_csv(site.parent / "verdict_grid.csv")
    assert (table["theory"] == table["fast"].where(table["fast"] != "stable", table["slow"])).all()
    browser.run(f"document.querySelector('[data-criterion={criterion}]').click()")
    browser.run("document.querySelector('#verdicts-epsilon').focus()")
    shares = []
    for epsilon in sorted(table["epsilon"].unique(), reverse=True):
        called = table[(table["epsilon"] == epsilon) & (table[criterion] == "stable")]
        right = int((called["exact"] == "stable").sum())
        told = browser.run("document.querySelector('#verdicts-count').textContent")
        none = int((called["exact"] == "no orbit").sum())
        assert told == (
            f"At ε = {epsilon}, {len(called)} points are called stable. "
            f"The exact orbits of {right} of them are; {none} have none."
        )
        assert browser.run("document.querySelectorAll('#verdicts-map [data-stable=true]').length") == right
        assert browser.run("document.querySelectorAll('#verdicts-map [data-stable]').length") == len(called)
        shares.append(right / len(called))
        browser.press("ArrowRight")
    assert shares == sorted(shares)
    assert shares[0] < shares[-1]


def test_a_figure_opens_large_and_closes_by_keyboard(browser, site):
    browser.open(address(site, "figures"), width=390)
    small = browser.run("document.querySelector('figure img').getBoundingClientRect().width")
    opened = "document.querySelector('dialog.large')?.open"
    browser.run("document.querySelector('.enlarge button').focus()")
    browser.press("Enter")
    assert browser.run(opened)
    assert browser.run("document.querySelector('.large img').getBoundingClientRect().width") > 2 * small
    assert browser.run("document.querySelector('.large img').alt") == browser.run(
        "document.querySelector('figure img').alt"
    )
    browser.press("Escape")
    assert not browser.run(opened)
    browser.page.locator("figure img").first.click()
    assert browser.run(opened)
    browser.page.locator(".large img").click()
    assert not browser.run(opened)
    assert browser.problems == []


def test_the_buttons_bring_the_cases_of_the_chapter(browser, site):
    browser.open(address(site, "fixed_points"))
    browser.run("document.querySelectorAll('[data-force-sweep] button')[1].focus()")
    browser.press("Enter")
    assert float(browser.run(FIXED_POINTS)["value"]) == 0.89


SOME_FRAMES = """new Promise(done => {
  const next = left => left ? requestAnimationFrame(() => next(left - 1)) : done();
  next(20);
})"""
"""A loaded machine draws them late, but draws them."""


@pytest.mark.parametrize("number", range(len(ANIMATIONS)))
def test_an_animation_plays_pauses_and_obeys_the_keyboard(browser, site, number):
    scene = list(ANIMATIONS.values())[number]
    browser.open(address(site, "motion"))
    root = f"document.querySelectorAll('[data-animation]')[{number}]"
    ball = f"Number({root}.querySelector('circle').getAttribute('cx'))"
    before = browser.run(ball)
    browser.run(SOME_FRAMES)
    assert browser.run(ball) != before, "does not play"
    browser.run(f"{root}.querySelector('button').focus()")
    browser.press("Enter")
    before = browser.run(ball)
    browser.run(SOME_FRAMES)
    assert browser.run(ball) == before, "does not pause"
    browser.run(f"{root}.querySelector('input').focus()")
    browser.press("Home")
    samples = pd.read_csv(site.parent / f"simulations/{scene['case']}/samples.csv")
    places = [-3.0, 3.0]
    for module, place in enumerate(places, start=1):
        circle = f"{root}.querySelectorAll('circle')[{module - 1}]"
        assert browser.run(f"Number({circle}.getAttribute('cx'))") == pytest.approx(
            place + samples[f"Y{module}"].iloc[0], abs=1e-3
        )
        box = f"{root}.querySelectorAll('svg g')[{module - 1}].transform.baseVal[0].matrix.e"
        assert browser.run(box) == pytest.approx(place + samples[f"X{module}"].iloc[0], abs=1e-3)
    browser.press("ArrowRight", times=5)
    assert browser.run(ball) != before


def test_a_wall_lights_up_when_it_is_hit(browser, site):
    browser.open(address(site, "motion"))
    root = "document.querySelector('[data-animation]')"
    browser.run(f"{root}.querySelector('button').click()")
    hit = browser.run("JSON.parse(document.getElementById('data-periodic').textContent).impacts[0]")
    lights = f"[...{root}.querySelectorAll('rect[opacity]')].map(rect => Number(rect.getAttribute('opacity')))"
    slider = f"const slider = {root}.querySelector('input'); slider.step = 'any'"
    moment = f"(t => {{ {slider}; slider.value = t; slider.dispatchEvent(new Event('input')); }})"
    browser.run(f"{moment}({hit[0] + 0.005})")
    lit = browser.run(lights)
    browser.run(f"{moment}({max(hit[0] - 0.005, 0)})")
    dark = browser.run(lights)
    assert max(lit) > 0.9
    index = lit.index(max(lit))
    assert dark[index] == 0


def test_motions_lie_over_each_other_and_each_can_be_taken_away(browser, site):
    browser.open(address(site, "motion"))
    lines = "[...document.querySelectorAll('[data-layers] polyline')]"
    shown = f"{lines}.filter(line => line.getAttribute('visibility') == 'visible')"
    names = f"{shown}.map(line => line.dataset.name)"
    assert browser.run(names) == ["theory", "simulation"]
    browser.run("document.querySelector('button[data-name=\"mirror image\"]').focus()")
    browser.press("Enter")
    browser.run("document.querySelector('[data-layers] button').click()")
    assert browser.run(names) == ["simulation", "mirror image"]
    drawn = browser.run(f"{shown}.map(line => [...line.points].map(p => [p.x, p.y]))")
    table = pd.read_csv(site.parent / "figures/companion_10_08.csv").query("panel == 'simulation'")
    for line, series in zip(drawn, ("W_2", "mirror image"), strict=True):
        rows = table[table["series"] == series]
        across, down = np.transpose(line)
        assert np.corrcoef(across, rows["phase"])[0, 1] == pytest.approx(1, abs=1e-6)
        assert np.corrcoef(down, -rows["W2"])[0, 1] == pytest.approx(1, abs=1e-6)


def test_a_number_of_the_findings_tells_its_source_by_keyboard(browser, site):
    browser.open(address(site, "index"))
    assert browser.run("document.querySelectorAll('.sourced').length") > 25
    browser.run("document.querySelector('.sourced').focus()")
    open_ones = "[...document.querySelectorAll('.source:popover-open')].map(source => source.textContent)"
    browser.press("Enter")
    (told,) = browser.run(open_ones)
    place = re.match(r"(\S+) in results/claims\.json: (.+)\. Made by", told)
    assert float(place[1]) == pytest.approx(Results(site.parent).value("claims.json", *place[2].split(", ")), rel=1e-5)
    assert told.endswith("snakemake --cores 2 results/claims.json")
    browser.press("Escape")
    assert browser.run(open_ones) == []


STATEMENTS = """[...document.querySelectorAll('#statements tbody tr')].filter(row => row.checkVisibility()).map(
  row => row.querySelector('.of').dataset.verdict + ' ' + row.querySelector('.of').dataset.section
)"""


def test_statements_are_filtered_by_verdict_and_section_by_keyboard(browser, site):
    browser.open(address(site, "claims"))
    every = browser.run(STATEMENTS)
    assert len(every) > 40
    for kind, value in (("verdict", "refuted"), ("section", "10-4")):
        browser.run(f"document.querySelector('button[data-kind={kind}][data-value=\"{value}\"]').focus()")
        browser.press("Enter")
    left = browser.run(STATEMENTS)
    assert left == ["refuted 10-4"] * every.count("refuted 10-4")
    assert 0 < len(left) < len(every)
    assert browser.run("document.querySelector('[data-filter] output').textContent") == (
        f"{len(left)} of {len(every)} statements"
    )
    browser.run("location.hash = '#small-balls'")  # of section 10.2
    browser.run(SOME_FRAMES)
    assert browser.run(STATEMENTS) == every


def test_a_statement_is_a_card_on_a_phone(browser, site):
    browser.open(address(site, "claims"), width=390)
    edges = browser.run("[...document.querySelectorAll('#statements .of')].map(e => e.getBoundingClientRect().right)")
    assert 0 < max(edges) <= 390


def test_print_shows_stills_in_place_of_controls(browser, site):
    browser.open(address(site, "motion"))
    state = "['.still', '.live', '.sidebar-drawer'].map(name => getComputedStyle(document.querySelector(name)).display)"
    assert browser.run(state) == ["none", "block", "flex"]
    browser.page.emulate_media(media="print")
    assert browser.run(state) == ["block", "none", "none"]
    browser.page.emulate_media(media="screen")


def test_motion_waits_for_those_who_want_less_of_it(browser, site):
    browser.page.emulate_media(reduced_motion="reduce")
    browser.open(address(site, "motion"))
    assert (
        browser.run("[...document.querySelectorAll('[data-animation] button')].map(b => b.textContent)") == ["Play"] * 2
    )
    browser.page.emulate_media(reduced_motion="no-preference")
