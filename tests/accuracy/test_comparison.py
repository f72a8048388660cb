"""The table of methods has the cost of an error of 1e-6 and the stress tests; the cheapest methods are chosen."""

import numpy as np
import pandas as pd

from vibroimpact.accuracy.comparison import choices, methods_table

RUN = {"missed": 0, "spurious": 0, "outcome": "finished", "family": "f", "setting": ""}


def run(problem, method, error, seconds, **other):
    return RUN | {"problem": problem, "method": method, "error_state": error, "seconds_per_cycle": seconds} | other


def test_the_cost_is_the_largest_over_all_problems_and_the_cheapest_methods_are_chosen():
    """The cost of a method in a problem is that of its fastest run within the error and without missed impacts."""
    runs = [
        run("p", "a", 1e-9, 1.0, setting="coarse"),
        run("p", "a", 1e-13, 5.0, setting="fine"),
        run("q", "a", 1e-9, 2.0),
        run("p", "b", 1e-5, 0.5),  # error too large
        run("p", "b", 1e-7, 3.0),
        run("q", "b", 1e-7, 8.0),
        run("p", "c", 1e-7, 0.8),
        run("p", "c", 1e-8, 0.9),
        run("p", "c", 1e-13, 0.1, missed=1),
        run("q", "c", 1e-7, 1.0, outcome="unfinished"),
        run("p", "untested", 1e-7, 0.1),
    ]
    verdicts = {"a": ["right", "right"], "b": ["silently wrong", "did not finish"], "c": ["refused with an error"]}
    rows = [{"method": method, "verdict": one} for method, all_ in verdicts.items() for one in all_]
    compared = methods_table(pd.DataFrame(runs), pd.DataFrame(rows))
    assert compared["method"].tolist() == ["a", "b", "c", "untested"]
    assert compared["problems"].tolist() == [2, 2, 1, 1]
    np.testing.assert_array_equal(compared["times"], [1.0, 4.0, np.nan, np.nan])
    counts = compared[["right", "wrong", "stopped", "tests"]].to_numpy().tolist()
    assert counts[:3] == [[2, 0, 0, 2], [0, 1, 1, 2], [0, 0, 1, 1]]
    found = choices(pd.DataFrame(runs), compared)
    assert found[["problem", "error", "choice", "method", "setting", "wrong"]].to_numpy().tolist() == [
        ["p", 1e-6, 1, "c", "", 0],
        ["p", 1e-6, 2, "a", "coarse", 0],
        ["p", 1e-12, 1, "a", "fine", 0],
        ["q", 1e-6, 1, "a", "", 0],
        ["q", 1e-6, 2, "b", "", 1],
    ]


def test_statements_of_the_article_on_stress_tests_hold_in_a_build(built):
    """All four solvers of SciPy handle chatter; they are silently wrong only in grazing, where they miss impacts."""
    stress_tests = pd.read_csv(built / "results/accuracy/stress_tests.csv")
    scipy = stress_tests[stress_tests["method"].isin(["RK45", "DOP853", "Radau", "LSODA"])]
    bad = scipy[scipy["verdict"] == "silently wrong"]
    assert set(bad["test"]) == {"hits by 1e-6", "hits by 1e-10", "hits by 1e-14"}
    assert (bad["missed"] > 0).all()
