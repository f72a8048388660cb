"""The engine of the page "Play", in a browser, agrees with the engine of the library and closed forms."""

from dataclasses import asdict

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from pipeline_trees import ROOT
from vibroimpact.system.state import IMPACT, KINDS

RUNS = """runs => runs.map(([parameters, start, cycles]) => {
  const run = new VibroImpact.Run(parameters, start);
  for (let n = 0; n < cycles; n++) run.advance(run.system.period);
  return { final: run.state, events: run.events };
})"""
FORCES = [(1.0, 1.0), (1.0, 0.89), (0.5, 0.5), None]
"""Forces of the cases of the chapter; None stands for random forces."""
KAPPAS = [0.65, 0.1, 0.3, None]
"""Restitution of the chapter, and low ones, with which balls chatter and stick; None stands for a random one."""
CYCLES, STARTS = 10, 100


@pytest.fixture(scope="module")
def play(browser):
    """Return a function that runs lists of [parameters, start, cycles] in the browser."""
    browser.page.goto("about:blank")
    browser.page.add_script_tag(path=ROOT / "report/live/exact.js")
    return lambda runs: browser.page.evaluate(RUNS, runs)


def examples():
    """Yield random pairs (system, start) with all FORCES and KAPPAS; in every fifth pair, a ball rests on a wall."""
    rng = np.random.default_rng(1)
    number = 0
    while True:
        f10, f20 = FORCES[number % 4] or rng.uniform(0.0, 1.6, 2)
        kappa = KAPPAS[number // 4 % 4] or rng.uniform(0.05, 0.9)
        boxes, gaps, velocities, balls = rng.uniform(-1.0, 1.0, (4, 2))
        start = np.array([boxes, boxes - gaps, velocities, 1.5 * balls])
        if number % 5 == 0:
            start[1, 0], start[3, 0] = boxes[0] - np.sign(gaps[0]), velocities[0]
        parameters = PARAMETERS | {"f10_hat": float(f10), "f20_hat": float(f20), "kappa": float(kappa)}
        yield vi.System(**parameters), start.reshape(2, 2, 2).transpose(0, 2, 1).ravel()
        number += 1


@pytest.fixture(scope="module")
def both(play):
    """Return pairs (run of the library, run in the browser) whose certificates in the library are decided."""
    runs = (vi.simulate(system, start, CYCLES) for system, start in examples())
    decided = (run for run in runs if run.certificate.decided)
    ours = [run for run, _ in zip(decided, range(STARTS), strict=False)]
    theirs = play([[asdict(run.system), run.start.tolist(), CYCLES] for run in ours])
    return list(zip(ours, theirs, strict=True))


def test_final_states_and_events_are_those_of_the_library(both):
    """Impacts are compared one by one in module, wall, time and state."""
    assert len(both) == STARTS
    for ours, theirs in both:
        np.testing.assert_allclose(theirs["final"], ours.final, rtol=0, atol=1e-6)
        kinds = [KINDS[kind] for kind in ours.events["kind"]]
        for kind in KINDS.values():
            assert [event["kind"] for event in theirs["events"]].count(kind) == kinds.count(kind)
        impacts = ours.events[ours.events["kind"] == IMPACT]
        found = [event for event in theirs["events"] if event["kind"] == "impact"]
        for name in ("module", "wall"):
            assert [event[name] for event in found] == impacts[name].tolist()
        for name in ("tau", "state"):
            np.testing.assert_allclose([event[name] for event in found], impacts[name], rtol=0, atol=1e-6)


def test_the_compared_runs_include_chatter_sticking_and_release(both):
    certificates = [ours.certificate for ours, _ in both]
    assert sum(certificate.chatters > 0 for certificate in certificates) > 10
    kinds = [[event["kind"] for event in theirs["events"]] for _, theirs in both]
    assert sum("stick" in kind and "release" in kind for kind in kinds) > 20
    assert {(ours.system.f10_hat, ours.system.f20_hat) for ours, _ in both} >= set(FORCES[:3])


@pytest.mark.parametrize("depth", [1e-3, 1e-6, 1e-10, 1e-13])
def test_a_shallow_contact_is_found_and_a_near_miss_is_no_contact(play, depth):
    """A box moves as X = A sin(tau) and its ball is at rest: W has its maximum 1 + depth or 1 - depth at pi/2."""
    free = dict.fromkeys(PARAMETERS, 0.0) | {"epsilon": 0.1, "kappa": 0.65, "f10_hat": 0.0, "f20_hat": 0.0}
    A = 0.75
    starts = [[0.0, A - 1 - side * depth, 0.0, 0.0, A, 0.0, 0.0, 0.0] for side in (1, -1)]
    hit, missed = play([[free, start, 1] for start in starts])
    assert missed["events"] == []
    np.testing.assert_allclose(missed["final"], starts[1], rtol=0, atol=1e-13)
    first = hit["events"][0]
    assert (first["kind"], first["module"], first["wall"]) == ("impact", 1, 1)
    rounding = 1e-15 / np.sqrt(depth)  # rounding of 1 - depth in the arc cosine
    assert first["tau"] == pytest.approx(np.pi / 2 - np.arccos(1 - depth / A), abs=rounding)
    assert first["speed"] == pytest.approx(np.sqrt(2 * A * depth - depth**2), abs=rounding)
