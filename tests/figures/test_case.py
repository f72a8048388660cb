"""What notebooks show of a case: of their own parameters, not of other files, in words that fit the numbers."""

import contextlib
import runpy
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from pipeline_trees import ROOT
from vibroimpact.figures.plotting import case_motion, case_points
from vibroimpact.system import System

EQUAL = {**PARAMETERS, "f10_hat": 1.0, "f20_hat": 1.0}
OTHERS = [EQUAL | change for change in ({"kappa": 0.650001}, {"f20_hat": 0.72}, {"f10_hat": 0.0, "f20_hat": 0.0})]
RUN = {"initial_state": [0.0] * 8, "transient_cycles": 20, "window_cycles": 3, "samples_per_cycle": 16}
RUN |= {"model": "float64"}


class Given(dict):
    """A mapping whose entries are also attributes, as in Snakemake."""

    __getattr__ = dict.__getitem__


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Files of the case `equal`, as a build makes them, by name."""
    folder = tmp_path_factory.mktemp("made")
    outputs = {
        "fixed_points": Given(points="points.csv", orbits="orbits.csv", search="search.json"),
        "simulate": Given(samples="samples.csv", events="events.csv", strobe="strobe.csv", summary="summary.json"),
    }
    for name, paths in outputs.items():
        job = SimpleNamespace(log=[], threads=1, rule=name, input=[], output=paths)
        job.params, job.wildcards = Given(system=EQUAL, settings=RUN), Given(case="equal")
        with contextlib.chdir(folder):
            runpy.run_path(str(ROOT / f"workflow/scripts/{name}.py"), init_globals={"snakemake": job})
    return {name: folder / path for paths in outputs.values() for name, path in paths.items()}


def test_files_and_parameters_say_the_same(made):
    system = System(**EQUAL)
    read, own = (case_points.fixed_points("equal", system, inputs) for inputs in (made, {}))
    pd.testing.assert_frame_equal(read, own.drop(columns="multiple"))
    said = [case_points.exact(case_points.verdicts("equal", system, read, inputs)) for inputs in (made, {})]
    assert said[0] == said[1] != ""
    for one, other in zip(*(case_motion.simulated("equal", EQUAL, RUN, inputs) for inputs in (made, {})), strict=True):
        pd.testing.assert_frame_equal(one, other, check_dtype=False)


def test_files_of_other_parameters_of_another_case_or_length_are_refused_in_one_line(made):
    for others in OTHERS:
        system = System(**others)
        with pytest.raises(ValueError, match=r"\Ainputs: .*points.csv.*\Z"):
            case_points.fixed_points("equal", system, made)
        with pytest.raises(ValueError, match=r"\Ainputs: .*summary.json was computed with (kappa|f[12]0_hat) = .*\Z"):
            case_motion.simulated("equal", others, RUN, made)
        with pytest.raises(ValueError, match=r"points.csv contains"):
            case_points.verdicts("equal", system, case_points.fixed_points("equal", system, {}), made)
    with pytest.raises(ValueError, match="of case equal"):
        case_points.fixed_points("unequal", System(**EQUAL), made)
    for case, settings, said in (("unequal", RUN, "case = equal"), ("equal", RUN | {"window_cycles": 4}, "cycles = 3")):
        with pytest.raises(ValueError, match=f"was computed with [a-z_]*{said}, but the notebook has"):
            case_motion.simulated(case, EQUAL, settings, made)


def sampled(period, decay=0.0, cycles=6, per_cycle=8):
    """Displacements that repeat after `period` cycles, but for a part that dies out."""
    t = np.arange(cycles * per_cycle + 1) / per_cycle
    return np.outer(np.sin(2 * np.pi * t / period) + decay * np.exp(-t), np.ones(4))


@pytest.mark.parametrize(
    ("displacements", "said"),
    [
        (sampled(1), "**repeats every period**: in the window it changes after one period"),
        (sampled(2), "**repeats after 2 periods**: in the window it changes after 2 periods"),
        (sampled(1, decay=0.015), "**nearly repeats**, but has not settled: in the window it changes after one period"),
        (sampled(np.pi), "**does not repeat**: in the window it changes after one period by up to "),
        (sampled(1, cycles=1), "**repeats every period**"),
    ],
)
def test_words_on_repetition_fit_the_window(displacements, said):
    sentence = case_motion.repetition(displacements, 8)
    assert said in sentence
    if "does not repeat" in sentence:
        assert float(sentence.split()[-1]) > 0.02


def test_flights_are_measured_from_the_impacts():
    """Ball 1 flies for 0.3 and 0.7 of a period, ball 2 for halves; a ball at one wall alone has no flight across."""
    period = 6.0
    impacts = [(period * (n + at), module, wall) for n in range(3) for at, module, wall in
               [(0.1, 1, 1), (0.4, 1, -1), (0.2, 2, -1), (0.7, 2, 1)]]  # fmt: skip
    table = pd.DataFrame(sorted(impacts), columns=["tau", "module", "wall"])
    assert np.allclose(case_motion.flights(table, period), [(1, 0.3, 0.7), (2, 0.5, 0.5)])
    assert case_motion.flights(table[table["wall"] == 1], period) == []


@pytest.mark.parametrize("f20_hat", [1.0, 0.0])
def test_a_settled_motion_is_compared_with_its_mirror_image(f20_hat):
    """At equal forces the attractor is asymmetric, from brute force: the maxima of W_2 and of -W_2 differ in time."""
    run = RUN | {"transient_cycles": 1500, "samples_per_cycle": 200}
    samples, events = case_motion.simulated("equal", EQUAL | {"f20_hat": f20_hat}, run, {})
    system = System(**EQUAL)
    impacts = events[events["kind"] == "impact"]
    said = case_motion.exact(samples[["X1", "Y1", "X2", "Y2"]].to_numpy(), 200, impacts, system.period)
    W = (samples["X2"] - samples["Y2"]).to_numpy()[:201]
    even = abs(W[:101] + W[100:]).max()
    assert ("asymmetric" in said) == (even > 1e-3 and "repeats every" in said)


def test_why_a_fixed_point_is_unstable_is_said_with_the_multipliers_of_a_simulated_period(made):
    system = System(**EQUAL)
    points = case_points.fixed_points("equal", system, made)
    shown = case_points.why(case_points.verdicts("equal", system, points, made))
    symmetric = [orbit for orbit in vi.orbits(system) if orbit.symmetric]
    for name, largest in zip(shown["exact orbit"], shown["its largest multiplier"], strict=True):
        jacobian = vi.simulate(system, symmetric[int(name[1:]) - 1].state, 1).jacobian
        assert largest == pytest.approx(abs(np.linalg.eigvals(jacobian)).max(), abs=1e-4)
    columns = ["printed_10_26: impacts, by (10.26)", "slow: slow flow", "exact: its multipliers"]
    assert shown.loc["b", columns].tolist() == ["stable", "unstable", "unstable"]
