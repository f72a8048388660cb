"""Compare methods by cost and stress tests, and choose the cheapest ones for each problem and allowed error."""

from itertools import product

from vibroimpact.accuracy.stress_tests import ENDLESS, ERROR, RIGHT, SILENTLY_WRONG
from vibroimpact.system.extras import need

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the dependency check)

GOAL, GOALS = 1e-6, (1e-6, 1e-12)
OUTCOMES = {"right": [RIGHT], "wrong": [SILENTLY_WRONG], "stopped": [ERROR, ENDLESS]}


def methods_table(work_precision: pd.DataFrame, stress_tests: pd.DataFrame) -> pd.DataFrame:
    """Return one row per method: cost relative to the first method, and results of the stress tests.

    The arguments are rows of `work_precision.measure` and of `stress_tests.judge`. A method solves a problem if it has
    a run with an error of at most 1e-6 and no missed or spurious impacts. The cost of a solved problem is the shortest
    time of such a run. The first method is the method in the first row of `work_precision`.

    - problems: number of solved problems;
    - times: cost divided by the cost of the first method, for the problem with the largest quotient; blank if the
      method or the first method fails to solve a problem;
    - right: number of stress tests with a right result;
    - wrong: number of stress tests with a wrong result but no reported error or doubt;
    - stopped: number of stress tests that end with an error or do not finish;
    - tests: number of all stress tests.
    """
    good = _good(work_precision, GOAL)
    cost = good.pivot_table("seconds_per_cycle", "method", "problem", aggfunc="min")
    methods = work_precision.drop_duplicates("method").set_index("method")["family"]
    cost = cost.reindex(index=methods.index, columns=work_precision["problem"].unique())
    table = pd.DataFrame({"family": methods, "problems": cost.notna().sum(axis=1)})
    table["times"] = (cost / cost.iloc[0]).max(axis=1, skipna=False)
    counts = stress_tests.groupby("method")["verdict"]
    for name, verdicts in OUTCOMES.items():
        table[name] = counts.agg(lambda found, verdicts=verdicts: found.isin(verdicts).sum())
    table["tests"] = counts.size()
    return table.reset_index()


def choices(work_precision: pd.DataFrame, compared: pd.DataFrame) -> pd.DataFrame:
    """Return the two cheapest methods for each problem and each allowed error in GOALS.

    Methods without stress tests are left out. compared: result of `methods_table`.
    """
    counts = compared.dropna(subset="tests").set_index("method")[["wrong", "tests"]].astype(int)
    tested = work_precision[work_precision["method"].isin(counts.index)]
    by_cost = tested.sort_values("seconds_per_cycle", kind="stable")
    rows = []
    for problem, goal in product(work_precision["problem"].unique(), GOALS):
        cheapest = _good(by_cost[by_cost["problem"] == problem], goal).drop_duplicates("method").head(2)
        for place, run in enumerate(cheapest.itertuples(), start=1):
            row = {"problem": problem, "error": goal, "choice": place, "method": run.method, "setting": run.setting}
            rows.append(row | {"seconds_per_cycle": run.seconds_per_cycle, **counts.loc[run.method]})
    return pd.DataFrame(rows)


def _good(work_precision, goal):
    """Return the finished runs with an error of at most `goal` and without missed or spurious impacts."""
    exact = work_precision[["missed", "spurious"]].eq(0).all(axis=1) & (work_precision["outcome"] == "finished")
    return work_precision[exact & (work_precision["error_state"] <= goal)]
