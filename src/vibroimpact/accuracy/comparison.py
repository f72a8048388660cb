"""One row per method: what an error of at most 1e-6 costs it, and how it fares in the stress tests."""

from vibroimpact.accuracy.stress_tests import ENDLESS, ERROR, RIGHT, SILENTLY_WRONG
from vibroimpact.system.extras import need

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the word on what is missing)

GOAL = 1e-6
OUTCOMES = {"right": [RIGHT], "wrong": [SILENTLY_WRONG], "stopped": [ERROR, ENDLESS]}


def compare(work_precision: pd.DataFrame, hazards: pd.DataFrame) -> pd.DataFrame:
    """Return methods in the order of the chart, with their cost relative to the first and their stress tests.

    Args:
        work_precision, hazards: the tables of the same names.

    Columns method, family, problems (test problems that it solves with an error of at most 1e-6, without an impact
    missed or spurious), times (run time of its fastest such runs over those of the first method, the worst problem;
    blank unless it solves all), right, wrong (silently), stopped (by an error, or not finished), tests.
    """
    exact = work_precision[["missed", "spurious"]].eq(0).all(axis=1) & (work_precision["outcome"] == "finished")
    good = work_precision[exact & (work_precision["error_state"] <= GOAL)]
    cost = good.pivot_table("seconds_per_cycle", "method", "problem", aggfunc="min")
    methods = work_precision.drop_duplicates("method").set_index("method")["family"]
    cost = cost.reindex(index=methods.index, columns=work_precision["problem"].unique())
    table = pd.DataFrame({"family": methods, "problems": cost.notna().sum(axis=1)})
    table["times"] = (cost / cost.iloc[0]).max(axis=1, skipna=False)
    counts = hazards.groupby("method")["verdict"]
    for name, verdicts in OUTCOMES.items():
        table[name] = counts.agg(lambda found, verdicts=verdicts: found.isin(verdicts).sum())
    table["tests"] = counts.size()
    return table.reset_index()
