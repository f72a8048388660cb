"""Pages of the report in a browser: accessibility, search, and live parts compared with the library."""

import re

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from pipeline_trees import ROOT
from vibroimpact.theory.response import leading_order

PAGES = sorted(
    path.stem for folder in ("docs", "docs/studies", "report/pages") for path in (ROOT / folder).glob("*.md")
)
NARROW = 390
PROSE = """[...document.querySelectorAll('article p, article li, article td, article h1, article h2, article h3')].map(
  block => [...block.childNodes].filter(n => n.nodeName !== 'CODE').map(n => n.textContent).join('')
).join('\\n')"""


ALWAYS_TESTED = "index", "figures", "claims"
"""Pages that are always tested; `make test-all` tests all pages."""


def address(site, page):
    return (site / f"{page}.html").as_uri()


@pytest.mark.parametrize(
    "page", [*ALWAYS_TESTED, *(pytest.param(page, marks=pytest.mark.thorough) for page in (*PAGES, "api/vibroimpact"))]
)
def test_a_page_opens_without_errors_and_is_accessible(browser, site, page):
    """No other hosts are used. axe finds no barriers, even in dark mode and on phones; formulas are typeset."""
    browser.open(address(site, page))
    assert browser.problems == []
    assert [url for url in browser.requests if not url.startswith((site.as_uri(), "data:"))] == []
    browser.page.emulate_media(color_scheme="dark")
    assert browser.barriers(runOnly=["color-contrast"]) == []
    browser.page.emulate_media(color_scheme="light")
    assert browser.barriers() == []
    attributes = "[i.getAttribute('src'), i.complete && i.naturalWidth, i.alt]"
    pictures = browser.run(f"[...document.images].map(i => {attributes})")
    assert [name for name, width, alt in pictures if not width or len(alt) < 20] == []
    assert browser.run("document.querySelectorAll('h1').length") == 1
    fonts = browser.run("""document.fonts.ready.then(fonts => [...fonts].map(
      font => [font.family.replaceAll('"', ''), font.status]))""")
    assert not browser.run("document.querySelectorAll('math').length") or fonts == [["STIX Two Math", "loaded"]]
    text = browser.run(PROSE)
    assert page.startswith("api/") or not re.search(r"\$|\\frac|\\tag|\\hat|\{abbr\}", text)
    browser.resize(NARROW)
    assert browser.run("document.documentElement.scrollWidth") <= NARROW
    assert browser.barriers(rules={"color-contrast": {"enabled": False}}) == []


@pytest.mark.parametrize(("words", "page"), [("saltation", "engine"), ("(10.26)", "findings"), ("10.24", "derivation")])
def test_the_search_finds_pages_by_words_and_equation_numbers(browser, site, words, page):
    """Pages are opened from a disk, where a browser does not let scripts load files."""
    browser.open((site / "search.html").as_uri() + f"?q={words}")
    # Results appear one after another, so that waiting for the first of them is not enough.
    browser.page.wait_for_selector(
        f"#search-results a:is([href='{page}.html'], [href^='{page}.html?'], [href^='{page}.html#'])"
    )
    assert browser.problems == []


def test_errors_and_barriers_on_a_faulty_page_are_found(browser, tmp_path):
    page = tmp_path / "wrong.html"
    page.write_text(
        "<!DOCTYPE html><img src='missing.png'><img src='http://127.0.0.1:9/outside.png'>"
        "<script>console.error('logged'); undefinedFunction();</script>"
    )
    browser.open(page.as_uri())
    found = " ".join(browser.problems)
    assert all(words in found for words in ("ERR_FILE_NOT_FOUND", "logged", "undefinedFunction"))
    assert any(url.startswith("http://127.0.0.1") for url in browser.requests)
    assert browser.barriers()


@pytest.mark.thorough
@pytest.mark.parametrize("criterion", ["theory", "printed_10_26"])
def test_the_slider_of_epsilon_shows_the_counts_of_the_table(browser, site, criterion):
    """The criterion `theory` combines Masri's analysis and the slow flow."""
    browser.open(address(site, "fixed_points"))
    table = pd.read_csv(site.parent / "verdict_grid.csv")
    browser.run(f"document.querySelector('[data-criterion={criterion}]').click()")
    browser.page.focus("#verdicts-epsilon")
    for epsilon in sorted(table["epsilon"].unique(), reverse=True):
        called = table[(table["epsilon"] == epsilon) & (table[criterion] == "stable")]
        right, none = (int((called["exact"] == verdict).sum()) for verdict in ("stable", "no orbit"))
        assert browser.run("document.querySelector('#verdicts-count').textContent") == (
            f"At ε = {epsilon}, {len(called)} points are called stable. "
            f"{right} of them have a stable exact orbit, and {none} have no exact orbit."
        )
        assert browser.run("document.querySelectorAll('#verdicts-map [data-stable=true]').length") == right
        assert browser.run("document.querySelectorAll('#verdicts-map [data-stable]').length") == len(called)
        browser.press("ArrowRight")


SOME_FRAMES = """new Promise(done => {
  const next = left => left ? requestAnimationFrame(() => next(left - 1)) : done();
  next(20);
})"""
"""Wait for 20 frames, which a machine under load draws late."""


@pytest.fixture
def still(browser, site):
    """Return a browser with the page "Play" under reduced motion: the animation does not start by itself."""
    browser.page.emulate_media(reduced_motion="reduce")
    browser.open(address(site, "play"))
    yield browser
    browser.page.emulate_media(reduced_motion="no-preference")


def shown(browser, part):
    return browser.run(f"document.getElementById('play-{part}').textContent")


@pytest.mark.thorough
def test_the_trace_is_the_motion_of_the_library(still):
    """X2 and W2 at the right end of both lines are compared after 30 steps, 1.5 periods after the start."""
    still.page.focus("#play-start")
    still.press("End")
    for _ in range(30):
        still.run("document.getElementById('play-step').click()")
    system = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
    run = vi.simulate(system, [0, 0, 0, 0, 0, 2.0, 0, 2.0], 2, sample_times=[1.5 * system.period])
    X2, Y2 = run.samples[0, 2:4]
    lowest = "[...document.querySelectorAll('#play-box text')].find(t => t.textContent.startsWith('−'))"
    scale = f"Number({lowest}.textContent.slice(1))"
    for part, end, expected in (("box", scale, X2), ("ball", "1.12", X2 - Y2)):
        last = f"[...document.querySelector('#play-{part} .exact').points].at(-1).y"
        frame = f"document.querySelector('#play-{part} .frame')"
        top, height = (f"{frame}.{name}.baseVal.value" for name in ("y", "height"))
        assert still.run(f"(1 - 2 * ({last} - {top}) / {height}) * {end}") == pytest.approx(expected, abs=0.005)


def test_the_prediction_is_the_response_at_leading_order(still):
    system = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
    for point in vi.fixed_points(system):
        C, B, psi = (float(of_modules[1]) for of_modules in (point.C, point.B, point.psi))
        found = still.run(f"predicted({{C: {C}, B: {B}, psi: {psi}}}, {{epsilon: 0.1, kappa: 0.65}})")
        tau = np.arange(len(found["X"])) / len(found["X"]) * system.period
        response = leading_order(system, point, tau)
        for name in ("X", "W"):
            np.testing.assert_allclose(found[name], getattr(response, name)[:, 1], atol=1e-9)


def test_a_click_on_the_map_shows_exact_motion_and_theory_with_the_multiplier(still):
    """The forces are those of the centre of the cell; `vi.orbits` gives the multiplier. An arrow key changes cells."""
    still.page.locator("#play-map").scroll_into_view_if_needed()
    square = still.run(
        "(b => [b.x, b.y, b.width, b.height])(document.querySelector('#play-map .frame').getBoundingClientRect())"
    )
    still.page.mouse.click(square[0] + 22.5 / 30 * square[2], square[1] + (1 - 20.5 / 30) * square[3])
    system = vi.System(**PARAMETERS, f10_hat=1.2, f20_hat=20.5 / 30 * 1.6)
    assert shown(still, "place").startswith("Forces 1.20 and 1.09: most often ")
    assert still.run("document.getElementById('play-point').options.length") == len(vi.fixed_points(system)) + 1
    assert still.run("document.querySelector('#play-ball .ghost').points.length") > 100
    multiplier = float(shown(still, "stable").rpartition(" ")[2])
    assert any(abs(orbit.multipliers[0]) == pytest.approx(multiplier, rel=0.01) for orbit in vi.orbits(system))
    still.press("ArrowUp")
    assert shown(still, "place").startswith("Forces 1.20 and 1.15: ")


@pytest.mark.thorough
def test_the_perturbed_motion_is_drawn_per_period_and_plays_again(browser, site):
    """Under reduced motion, there is a dot for each period, at first on the line of the multiplier."""
    browser.page.emulate_media(reduced_motion="reduce")
    browser.open(address(site, "findings"))
    dots = """[...document.querySelector('[data-nudge] .even svg').querySelectorAll('circle')].map(
      dot => [dot.cx, dot.cy].map(place => place.baseVal.value))"""
    x, y = zip(*browser.run(dots), strict=True)
    assert len(x) == 41
    ends = "['x1', 'y1', 'x2', 'y2'].map(n => Number(document.querySelector('[data-nudge] .ghost').getAttribute(n)))"
    x1, y1, x2, y2 = browser.run(ends)
    for n in range(1, 14):
        assert y[n] == pytest.approx(y1 + (x[n] - x1) * (y2 - y1) / (x2 - x1), abs=2.5)
    assert max(y[20:]) < y[10]
    assert browser.run("document.querySelector('[data-nudge] button').textContent") == "Play again"
    browser.page.click("[data-nudge] button")
    browser.run(SOME_FRAMES)
    assert 0 < len(browser.run(dots)) < 20
    browser.page.emulate_media(reduced_motion="no-preference")


@pytest.mark.thorough
def test_the_matrix_of_dots_is_the_table(browser, site):
    browser.open(address(site, "findings"))
    table = pd.read_csv(site.parent / "verdicts_by_epsilon.csv")
    rows = "[...document.querySelectorAll('.dots tbody tr')].map(row => row.innerText.match(/\\S+/g).join(' '))"
    for number, epsilon in enumerate(table["epsilon"].unique(), start=1):
        browser.page.click(f"label[for=dots-{number}]")
        expected = [
            f"{row.case} {row.label} {row.printed_10_26} {row.fast} {row.theory} {row.exact} × {row.multiplier:.3g}"
            for row in table[table["epsilon"] == epsilon].itertuples()
        ]
        assert sorted(browser.run(rows)) == sorted(expected)
