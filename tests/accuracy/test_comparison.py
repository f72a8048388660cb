"""One row per method: cost of an error of 1e-6, and stress tests."""

import numpy as np
import pandas as pd

from vibroimpact.accuracy.comparison import choices, methods_table

RUN = {"missed": 0, "spurious": 0, "outcome": "finished", "family": "f"}


def run(problem, method, error, seconds, **other):
    return RUN | {"problem": problem, "method": method, "error_state": error, "seconds_per_cycle": seconds} | other


def test_the_cost_is_that_of_the_fastest_good_run_on_the_worst_problem():
    runs = [
        run("p", "a", 1e-9, 1.0),
        run("q", "a", 1e-9, 2.0),
        run("p", "b", 1e-5, 1.0),  # not good enough
        run("p", "b", 1e-7, 3.0),
        run("p", "b", 1e-9, 9.0),
        run("q", "b", 1e-7, 8.0),
        run("p", "c", 1e-7, 1.0),
        run("q", "c", 1e-7, 1.0, missed=1),  # an impact was missed
        run("p", "d", 1e-7, 1.0, outcome="unfinished"),
    ]
    verdicts = {"a": ["right", "right"], "b": ["silently wrong", "did not finish"], "c": ["refused with an error"]}
    rows = [{"method": method, "verdict": one} for method, all_ in verdicts.items() for one in all_]
    found = methods_table(pd.DataFrame(runs), pd.DataFrame(rows)).set_index("method")
    assert found.index.tolist() == ["a", "b", "c", "d"]
    assert found["problems"].tolist() == [2, 2, 1, 0]
    np.testing.assert_array_equal(found["times"], [1.0, 4.0, np.nan, np.nan])
    assert found.loc["b", ["right", "wrong", "stopped", "tests"]].tolist() == [0, 1, 1, 2]
    assert found.loc["a", "right"] == 2


def test_the_choices_are_the_two_cheapest_tested_methods_that_are_accurate_enough():
    runs = [
        run("p", "a", 1e-13, 5.0, setting="fine"),
        run("p", "a", 1e-7, 3.0, setting="coarse"),
        run("p", "b", 1e-7, 2.0, setting="1"),
        run("p", "b", 1e-7, 1.0, setting="2"),
        run("p", "c", 1e-7, 4.0, setting="1"),
        run("p", "untested", 1e-7, 0.1, setting="1"),
        run("p", "d", 1e-13, 0.1, setting="1", missed=1),
    ]
    verdicts = [("a", "right"), ("a", "silently wrong"), ("b", "right"), ("c", "right"), ("d", "right")]
    work_precision = pd.DataFrame(runs)
    compared = methods_table(work_precision, pd.DataFrame(verdicts, columns=["method", "verdict"]))
    found = choices(work_precision, compared)
    assert found[["error", "choice", "method", "setting", "seconds_per_cycle"]].to_numpy().tolist() == [
        [1e-6, 1, "b", "2", 1.0],
        [1e-6, 2, "a", "coarse", 3.0],
        [1e-12, 1, "a", "fine", 5.0],
    ]
    assert found[["wrong", "tests"]].to_numpy().tolist() == [[0, 1], [1, 2], [1, 2]]


def test_what_the_article_says_of_a_build(built):
    """All four solvers of SciPy handle chatter, and are silently wrong in grazing only, where impacts are missed."""
    stress_tests = pd.read_csv(built / "results/accuracy/stress_tests.csv")
    scipy = stress_tests[stress_tests["method"].isin(["RK45", "DOP853", "Radau", "LSODA"])]
    bad = scipy[scipy["verdict"] == "silently wrong"]
    assert set(bad["test"]) == {"hits by 1e-6", "hits by 1e-10", "hits by 1e-14"}
    assert (bad["missed"] > 0).all()
    chatter = stress_tests[stress_tests["group"] == "chatter"].groupby("method")["verdict"].unique()
    assert chatter["power law"].tolist() == ["silently wrong"]
    assert chatter["Ivanov, events"].tolist() == ["did not finish"]
