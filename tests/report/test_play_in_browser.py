"""The page "Play" in a browser: the theory that it shows, its controls, and that it keeps to itself."""

import json
from dataclasses import asdict

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from pipeline_trees import ROOT
from vibroimpact.theory.response import leading_order
from vibroimpact_pipeline.report.live import live_data, regime_map

LIVE = ROOT / "report/live"
CENTRES = np.arange(0.05, 1.6, 0.1)
"""Of the cells of the map, here 16 x 16: asymmetric above the diagonal, chaotic below."""
CONFIG = {
    "system": PARAMETERS,
    "cases": {name: {"f10_hat": f10, "f20_hat": f20} for name, (f10, f20) in FORCES.items()},
}


class Cells:
    """Results with a map of regimes."""

    def table(self, name):
        assert name == "figures/companion_regime_map.csv"
        f10, f20 = (axis.ravel() for axis in np.meshgrid(CENTRES, CENTRES))
        regime = np.where(f20 > f10, "asymmetric", "chaotic")
        table = pd.DataFrame({"series": "cell", "f10_hat": f10, "f20_hat": f20, "regime": regime})
        case = pd.DataFrame({"series": ["case"], "f10_hat": [1.0], "f20_hat": [1.0]})
        return pd.concat([table.sample(frac=1, random_state=1), case])


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The fragment with its data, style and scripts, and nothing else."""
    file = tmp_path_factory.mktemp("play") / "play.html"
    text = {path.name: path.read_text(encoding="utf-8") for path in LIVE.iterdir()}
    data = live_data(Cells(), CONFIG, ["companion_regime_map"])
    scripts = "".join(f"<script>{text[name]}</script>" for name in ("exact.js", "theory.js", "chart.js", "play.js"))
    file.write_text(
        f'<!DOCTYPE html><html lang="en"><meta charset="utf-8"><style>{text["play.css"]}</style>{text["play.html"]}'
        f'<script type="application/json" id="play-data">{data}</script>{scripts}</html>',
        encoding="utf-8",
    )
    return file.as_uri()


@pytest.fixture
def still(browser, page):
    """The page as those see it who want less motion: it waits."""
    browser.page.emulate_media(reduced_motion="reduce")
    browser.open(page)
    yield browser
    browser.page.emulate_media(reduced_motion="no-preference")


def text(browser, part):
    return browser.run(f"document.getElementById('play-{part}').textContent")


def clock(browser):
    return float(text(browser, "clock").removeprefix("cycle "))


def focus(browser, part):
    browser.run(f"document.getElementById('play-{part}').focus()")


def test_the_fixed_points_are_those_of_the_library(browser):
    """Their places, phases, labels and verdicts, at random forces and restitutions."""
    rng = np.random.default_rng(3)
    systems = [
        vi.System(**PARAMETERS | {"f10_hat": f10, "f20_hat": f20, "kappa": kappa})
        for f10, f20, kappa in rng.uniform([0.05, 0.05, 0.1], [1.6, 1.6, 0.9], (60, 3)).tolist()
    ]
    browser.page.goto("about:blank")
    browser.page.add_script_tag(path=LIVE / "theory.js")
    found = browser.page.evaluate("systems => systems.map(SlowFlow.fixedPoints)", list(map(asdict, systems)))
    for system, theirs in zip(systems, found, strict=True):
        ours = sorted(vi.fixed_points(system), key=lambda point: point.label)
        assert [point["label"] for point in theirs] == [point.label for point in ours]
        for mine, other in zip(ours, theirs, strict=True):
            np.testing.assert_allclose(other["C"], mine.C, atol=1e-8)
            np.testing.assert_allclose(other["psi"], mine.psi, atol=1e-8)
            assert other["growth"] == pytest.approx(mine.slow_eigenvalues.real.max(), rel=1e-4, abs=1e-4)
            assert other["both"] == (mine.stability.theory == "stable")


def test_the_response_of_the_theory_is_that_of_the_library(browser):
    system = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=0.89)
    phases = np.linspace(-7.0, 7.0, 57)
    browser.page.goto("about:blank")
    browser.page.add_script_tag(path=LIVE / "theory.js")
    draw = """([p, phases]) => SlowFlow.fixedPoints(p).map((point) => [0, 1].map((i) =>
        phases.map((phase) => { const { X, W } = SlowFlow.response(p, point, i, phase); return [X, W]; })))"""
    drawn = np.array(browser.page.evaluate(draw, [asdict(system), phases.tolist()]))
    points = sorted(vi.fixed_points(system), key=lambda point: point.label)
    assert len(points) == len(drawn) == 3
    for point, theirs in zip(points, drawn, strict=True):
        ours = leading_order(system, point, phases / system.Omega)
        np.testing.assert_allclose(theirs[:, :, 0].T, ours.X, atol=1e-7)
        np.testing.assert_allclose(theirs[:, :, 1].T, ours.W, atol=1e-7)


def test_the_map_is_that_of_the_table():
    found = regime_map(Cells().table("figures/companion_regime_map.csv"))
    assert found["f10"] == found["f20"] == np.round(CENTRES, 6).tolist()
    assert found["counts"] == {"chaotic": 136, "asymmetric": 120}
    shown = [[found["regimes"][cell] for cell in row] for row in found["cells"]]
    assert shown[9][4] == "asymmetric"
    assert shown[4][9] == "chaotic"
    json.loads(live_data(Cells(), CONFIG, []))


def test_nothing_goes_wrong_and_no_request_leaves_the_page(browser, page):
    browser.open(page)
    assert browser.problems == []
    assert browser.requests == [page]


def test_it_plays_pauses_and_steps(browser, page):
    browser.open(page)
    assert text(browser, "run") == "Pause"
    before = clock(browser)
    browser.page.wait_for_function(f"parseFloat(document.getElementById('play-clock').textContent.slice(6)) > {before}")
    focus(browser, "run")
    browser.press("Enter")
    paused = clock(browser)
    browser.page.wait_for_timeout(200)
    assert clock(browser) == paused
    focus(browser, "step")
    browser.press("Enter", times=20)
    assert clock(browser) == pytest.approx(paused + 1, abs=0.11)


def test_motion_waits_for_those_who_want_less_of_it(still):
    assert text(still, "run") == "Play"
    before = clock(still)
    still.page.wait_for_timeout(200)
    assert clock(still) == before


def test_it_opens_on_the_lopsided_flights_of_figure_10_8(still):
    """Whose mirror image has them in the other order."""
    assert sorted(text(still, "flights").removesuffix(" of the period").split(" and ")) == ["0.38", "0.62"]
    assert text(still, "repeats") == "every cycle"
    assert text(still, "exact") == "a motion with unequal flights"
    shares = still.run("[...document.querySelectorAll('#play-ball .share')].map(share => share.textContent)")
    assert set(shares) == {"0.38", "0.62"}
    assert "point c" in text(still, "theory")
    assert text(still, "said") == "the chapter says: stable"


def test_two_motions_coexist_at_the_forces_of_the_unequal_case(still):
    """The repeating one is followed there from the equal case; from a start there the motion does not repeat."""
    focus(still, "f2")
    for _ in range(11):
        still.press("ArrowLeft")
        still.run("document.getElementById('play-skip').click()")
    assert still.run("document.getElementById('play-f2').value") == "0.89"
    assert text(still, "repeats") == "every cycle"
    assert still.run("document.getElementById('play-f2').getAttribute('aria-valuetext')") == "0.89"
    still.run("document.getElementById('play-again').click()")
    for _ in range(3):
        still.run("document.getElementById('play-skip').click()")
    assert text(still, "repeats") == "not so far"


def test_a_click_in_the_map_starts_there(still):
    still.run("document.getElementById('play-map').scrollIntoView()")
    frame = "document.querySelector('#play-map .frame').getBoundingClientRect()"
    box = still.run(f"(({{ left, top, width }}) => [left, top, width])({frame})")
    cell = box[2] / len(CENTRES)
    still.page.mouse.click(box[0] + 4.5 * cell, box[1] + (16 - 9.5) * cell)
    marker = "document.querySelector('#play-map .here[data-forces]').dataset.forces.split(',').map(Number)"
    assert still.run(marker) == pytest.approx([CENTRES[4], CENTRES[9]])
    assert text(still, "here") == "At 0.45, 0.95 most starts end in: asymmetric."
    assert clock(still) == 0.0
    focus(still, "map")
    still.press("ArrowRight", times=6)
    still.press("ArrowDown")
    assert still.run(marker) == pytest.approx([CENTRES[10], CENTRES[8]])
    assert "chaotic" in text(still, "here")
    assert still.run("document.getElementById('play-f1').value") == "1.05"


def test_a_map_of_another_restitution_says_so(still):
    focus(still, "kappa")
    still.press("ArrowLeft")
    assert text(still, "here").startswith("At these forces, but κ = 0.65, which the map is for, most starts end in: ")


def test_the_trace_is_the_motion_of_the_library(still):
    """One step after a start: X2 and W2 at the right end of both lines, by their scales."""
    focus(still, "start")
    still.press("End")
    for _ in range(30):
        still.run("document.getElementById('play-step').click()")
    system = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
    run = vi.simulate(system, [0, 0, 0, 0, 0, 2.0, 0, 2.0], 2, sample_times=[1.5 * system.period])
    X2, Y2 = run.samples[0, 2:4]
    scale = "Number(document.querySelector('#play-box .tick text').textContent.slice(1))"
    for part, end, expected in (("box", scale, X2), ("ball", "1.12", X2 - Y2)):
        last = f"[...document.querySelector('#play-{part} .exact').points].at(-1).y"
        top, height = (
            f"document.querySelector('#play-{part} .frame').{name}.baseVal.value" for name in ("y", "height")
        )
        assert still.run(f"(1 - 2 * ({last} - {top}) / {height}) * {end}") == pytest.approx(expected, abs=0.005)


@pytest.mark.parametrize("width", [390, 1280])
def test_it_fits_and_its_letters_keep_their_size(still, page, width):
    still.open(page, width=width)
    assert still.run("document.documentElement.scrollWidth") <= width
    sizes = still.run(
        "[...document.querySelectorAll('.play svg text')].map(t => t.getBoundingClientRect().height).filter(h => h > 0)"
    )
    assert min(sizes) > 11
