"""Notebooks show the case of their own parameters, refuse files of other parameters, and describe motions correctly."""

import contextlib
import runpy
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from chapter import PARAMETERS, system_of
from pipeline_trees import ROOT
from vibroimpact.figures.plotting import case_motion, case_points
from vibroimpact.system import System

EQUAL = {**PARAMETERS, "f10_hat": 1.0, "f20_hat": 1.0}
SYSTEM = system_of("equal")
OTHERS = [EQUAL | change for change in ({"kappa": 0.650001}, {"f20_hat": 0.72}, {"f10_hat": 0.0, "f20_hat": 0.0})]
RUN = {"initial_state": [0.0] * 8, "transient_cycles": 20, "window_cycles": 3, "samples_per_cycle": 16}
RUN |= {"model": "float64"}


class Attributes(dict):
    """A mapping whose entries are also attributes, as in Snakemake."""

    __getattr__ = dict.__getitem__


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Return the paths of files of the case `equal` by name, written by the scripts of the build."""
    folder = tmp_path_factory.mktemp("files")
    outputs = {
        "fixed_points": Attributes(points="points.csv", orbits="orbits.csv", search="search.json"),
        "simulate": Attributes(samples="samples.csv", events="events.csv", strobe="strobe.csv", summary="summary.json"),
    }
    for name, paths in outputs.items():
        job = SimpleNamespace(log=[], threads=1, rule=name, input=[], output=paths)
        job.params, job.wildcards = Attributes(system=EQUAL, settings=RUN), Attributes(case="equal")
        with contextlib.chdir(folder):
            runpy.run_path(str(ROOT / f"workflow/scripts/{name}.py"), init_globals={"snakemake": job})
    return {name: folder / path for paths in outputs.values() for name, path in paths.items()}


def test_results_from_files_are_those_from_parameters(files):
    from_files, computed = (case_points.fixed_points("equal", SYSTEM, inputs) for inputs in (files, {}))
    pd.testing.assert_frame_equal(from_files, computed.drop(columns="multiple"))
    texts = [case_points.exact(case_points.verdicts("equal", SYSTEM, computed, inputs)) for inputs in (files, {})]
    assert texts[0] == texts[1] != ""
    for one, other in zip(*(case_motion.simulated("equal", EQUAL, RUN, inputs) for inputs in (files, {})), strict=True):
        pd.testing.assert_frame_equal(one, other, check_dtype=False)


def test_files_of_other_parameters_of_another_case_or_length_are_refused_in_one_line(files):
    for others in OTHERS:
        system = System(**others)
        with pytest.raises(ValueError, match=r"\Ainputs: .*points.csv.*\Z"):
            case_points.fixed_points("equal", system, files)
        with pytest.raises(ValueError, match=r"\Ainputs: .*summary.json was computed with (kappa|f[12]0_hat) = .*\Z"):
            case_motion.simulated("equal", others, RUN, files)
        with pytest.raises(ValueError, match=r"points.csv contains"):
            case_points.verdicts("equal", system, case_points.fixed_points("equal", system, {}), files)
    with pytest.raises(ValueError, match="of case equal"):
        case_points.fixed_points("unequal", SYSTEM, files)
    for case, settings, text in (("unequal", RUN, "case = equal"), ("equal", RUN | {"window_cycles": 4}, "cycles = 3")):
        with pytest.raises(ValueError, match=f"was computed with [a-z_]*{text}, but the notebook has"):
            case_motion.simulated(case, EQUAL, settings, files)


def sampled(period, decay=0.0, cycles=6, per_cycle=8):
    """Return displacements that repeat after `period` cycles, except for a part that decays."""
    t = np.arange(cycles * per_cycle + 1) / per_cycle
    return np.outer(np.sin(2 * np.pi * t / period) + decay * np.exp(-t), np.ones(4))


@pytest.mark.parametrize(
    ("displacements", "text"),
    [
        (sampled(1), "**repeats every period**: in the window it changes after one period"),
        (sampled(2), "**repeats after 2 periods**: in the window it changes after 2 periods"),
        (sampled(1, decay=0.015), "**nearly repeats**, but has not settled: in the window it changes after one period"),
        (sampled(np.pi), "**does not repeat**: in the window it changes after one period by up to "),
        (sampled(1, cycles=1), "**repeats every period**"),
    ],
)
def test_the_sentence_on_repetition_is_true_of_the_window(displacements, text):
    sentence = case_motion.repetition(displacements, 8)
    assert text in sentence
    if "does not repeat" in sentence:
        assert float(sentence.split()[-1]) > 0.02


def test_flights_are_computed_from_the_impacts():
    """Ball 1 flies for 0.3 and 0.7 of a period, ball 2 for 0.5; a ball with impacts at one wall only is omitted."""
    period = 6.0
    impacts = [(period * (n + at), module, wall) for n in range(3) for at, module, wall in
               [(0.1, 1, 1), (0.4, 1, -1), (0.2, 2, -1), (0.7, 2, 1)]]  # fmt: skip
    table = pd.DataFrame(sorted(impacts), columns=["tau", "module", "wall"])
    assert np.allclose(case_motion.flights(table, period), [(1, 0.3, 0.7), (2, 0.5, 0.5)])
    assert case_motion.flights(table[table["wall"] == 1], period) == []


@pytest.mark.parametrize("f20_hat", [1.0, 0.0])
def test_a_settled_motion_is_compared_with_its_mirror_image(f20_hat):
    """At equal forces the attractor is asymmetric: W_2 differs from -W_2 half a period later."""
    run = RUN | {"transient_cycles": 1500, "samples_per_cycle": 200}
    samples, events = case_motion.simulated("equal", EQUAL | {"f20_hat": f20_hat}, run, {})
    impacts = events[events["kind"] == "impact"]
    text = case_motion.exact(samples[["X1", "Y1", "X2", "Y2"]].to_numpy(), 200, impacts, SYSTEM.period)
    W = (samples["X2"] - samples["Y2"]).to_numpy()[:201]
    asymmetry = abs(W[:101] + W[100:]).max()
    assert ("asymmetric" in text) == (asymmetry > 1e-3 and "repeats every" in text)


def test_the_table_of_verdicts_has_the_multipliers_of_a_simulated_period(files):
    points = case_points.fixed_points("equal", SYSTEM, files)
    shown = case_points.why(case_points.verdicts("equal", SYSTEM, points, files))
    symmetric = [orbit for orbit in vi.orbits(SYSTEM) if orbit.symmetric]
    for name, largest in zip(shown["exact orbit"], shown["its largest multiplier"], strict=True):
        jacobian = vi.simulate(SYSTEM, symmetric[int(name[1:]) - 1].state, 1).jacobian
        assert largest == pytest.approx(abs(np.linalg.eigvals(jacobian)).max(), abs=1e-4)
    columns = ["printed_10_26: impacts, by (10.26)", "slow: slow flow", "exact: its multipliers"]
    assert shown.loc["b", columns].tolist() == ["stable", "unstable", "unstable"]
