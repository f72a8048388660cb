"""Test distances between tables: measures for numbers with known distances, and changes of published tables."""

import numpy as np
import pytest
from scipy.stats import binomtest, norm

import vibroimpact as vi
from chapter import PARAMETERS
from published_tables import COLUMNS, published, tables_in, unnoticed
from vibroimpact.figures import fig10_08
from vibroimpact.tables import curve, join
from vibroimpact_pipeline.figure_check.table_distances import KINDS, MAX_DISTANCE, table_differences

RANDOM = np.random.default_rng(5)
COLUMN = {"value": {"compared": "kind"}}
BOTH = {"absolute": 0.5, "relative": 0.1}


@pytest.fixture
def distance(monkeypatch):
    """Return a function that computes the distance of two columns by a measure, relative to a limit."""

    def distance(measure, old, new, limit=1.0):
        monkeypatch.setitem(KINDS, "kind", {"limits": {measure: limit}})
        old, new = (curve("a", "s", value=values) for values in (old, new))
        return {one["measure"]: one["distance"] for one in table_differences(old, new, COLUMN)[1]}[measure]

    return distance


def test_measures_of_numbers_equal_known_distances(distance):
    for new in (7.0, 13.0):
        assert distance("difference", [0.0, 10.0], [0.1, new], BOTH) == pytest.approx(2)
    assert distance("difference", [0.0, 10.0], [0.1, 10.0], BOTH) == pytest.approx(0.2)
    for old, new in ((1e-9, 1e-7), (1e-7, 1e-9)):
        assert distance("decades", [1e-3, old], [1e-3, new]) == pytest.approx(2)
    assert distance("decades", [1e-3, 0.0, 2e-16], [1e-3, 1e-16, 0.0]) == 0
    assert distance("decades", [1e-3, 0.0], [1e-3, 2.2e-14]) == pytest.approx(2, abs=0.01)
    old = 10.0 ** RANDOM.uniform(-9, -3, size=101)
    assert distance("middle", old, 1000 * old) == distance("middle", 1000 * old, old) == pytest.approx(3)
    assert distance("middle", old, old * 10.0 ** RANDOM.uniform(-1, 1, size=101)) < 0.5


def test_classes_are_compared_by_the_share_of_rows_that_differ_and_by_their_balance(distance):
    old, fewer = np.repeat(["one", "two"], [900, 100]), np.repeat(["one", "two"], [930, 70])
    assert distance("balance", old, fewer) == pytest.approx(30 / np.sqrt(30))
    assert distance("rows", old, fewer) == pytest.approx(0.03)
    moved = np.concatenate([old[-100:], old[:-100]])  # the same number of rows in each class
    assert (distance("balance", old, moved), distance("rows", old, moved)) == (0, pytest.approx(0.2))
    counts, more = np.full(50, 2.0), np.repeat([2.0, 3.0], [44, 6])
    assert distance("balance", counts, more) == distance("balance", more, counts) == pytest.approx(np.sqrt(6))
    assert distance("rows", counts, more + 1e-9) == pytest.approx(6 / 50)


def test_a_balance_has_the_probability_of_a_fair_coin(distance):
    """Of 60 rows that differ, 45 increase. The balance is a normal approximation of the exact binomial test."""
    new = np.repeat([0.0, 1.0, 2.0], [15, 40, 45])
    exact = binomtest(45, 60).pvalue
    assert 2 * norm.sf(distance("balance", np.ones(100), new)) == pytest.approx(exact, rel=0.3)


@pytest.mark.parametrize("number", [1, 4, 5, 7])
def test_a_class_of_more_than_four_rows_that_vanishes_has_the_maximum_distance(distance, number):
    for classes in (np.array(["one", "two"]), np.array([0.0, 0.2])):
        old, new = np.repeat(classes, [900, number]), np.repeat(classes[:1], 900 + number)
        assert (distance("balance", old, new, 99) == MAX_DISTANCE) == (number > 4)


def test_the_balance_detects_a_shift_of_one_series_and_the_middle_a_shift_of_many_short_ones(monkeypatch):
    """The balance is computed for each series, the middle over all rows of a kind."""
    old = join([curve("a", str(number), value=np.arange(1.0, 2.0 + 30 * (number == 0))) for number in range(40)])
    monkeypatch.setitem(KINDS, "kind", {"limits": {"middle": 0.02, "balance": 4}})
    for rows, measure in (old["series"] == "0", "balance"), (old["series"] != "0", "middle"):
        new = old.assign(value=old["value"].where(~rows, 1.1 * old["value"]))
        _, found = table_differences(old, new, COLUMN)
        assert [one["measure"] for one in found if one["distance"] > 1] == [measure]


def test_infinite_values_are_compared_only_in_columns_that_declare_them(monkeypatch):
    monkeypatch.setitem(KINDS, "kind", {"limits": {"difference": {"absolute": 4.0, "relative": 0}}})
    columns = {"value": {"compared": "kind", "infinite": True}}
    old, new, other = (curve("a", "s", value=[x, 4.0, y]) for x, y in ((0.0, np.inf), (1.0, np.inf), (0.0, 4.0)))
    assert table_differences(old, new, columns)[1][0]["distance"] == pytest.approx(0.25)
    assert table_differences(old, other, columns)[1][0]["distance"] == MAX_DISTANCE
    assert table_differences(old, old, COLUMN)[0] == ["value: infinite value"]


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (lambda t: t.rename(columns={"B": "b"}), "columns are panel, series, C, b instead of panel, series, C, B"),
        (lambda t: t.iloc[1:], "SIM, SIM unstable: "),
        (lambda t: t.assign(series=t["series"].replace("B_min", "b")), "SIM, B_min: 0 rows instead of 2"),
        (lambda t: t.iloc[::-1], "SIM, "),
        (lambda t: t.assign(B=t["B"].where(t["C"] > 0)), "B: blank cells differ"),
        (lambda t: t.assign(B=t["B"].where(t["C"] != 1, np.inf)), "B: infinite value"),
        (lambda t: t.sort_values("series", kind="stable"), "the order of the series differs"),
    ],
)
def test_tables_that_cannot_be_compared_fail_with_a_reason(change, expected):
    old, columns = published("fig10_04")
    reasons, _ = table_differences(old, change(old), columns)
    assert any(expected in reason for reason in reasons), reasons


def test_faults_that_both_tables_have_fail():
    table, columns = published("fig10_04")
    for faulty, reason in [
        (table.iloc[:0], "no rows"),
        (table.assign(B=np.nan), "B: all cells are blank"),
        (table.drop(columns=["C", "B"]), "no column that the SPEC compares"),
        (table.assign(new=1.0), "new: the SPEC states no limit for this column"),
    ]:
        assert reason in table_differences(faulty, faulty, columns)[0]


@pytest.mark.parametrize("name", tables_in("figures"))
def test_a_change_of_one_number_by_one_per_cent_fails(name):
    assert unnoticed(name) == []


def test_errors_orders_and_failures_of_accuracy_charts_are_compared_and_run_times_are_not():
    old, columns = published("work_precision")
    slower = {"seconds_per_cycle": 9 * old["seconds_per_cycle"], "steps": old["steps"] + 1}
    slower["reason"] = old["reason"].where(old["reason"].isna() | (old["reason"] == ""), "another")
    assert table_differences(old, old.assign(**slower), columns)[0] == []
    last = old.index == old.index[old["outcome"] == "finished"][-1]
    for name, values in {
        "error_state": old["error_state"].where(~last, 100 * old["error_state"]),
        "error_time": 2 * old["error_time"],
        "order": old["order"] - 0.5,
        "missed": old["missed"] + (old["method"] == "heyoka"),
        "outcome": old["outcome"].where(~last, "unfinished"),
    }.items():
        assert table_differences(old, old.assign(**{name: values}), columns)[0], name


def test_a_change_of_gamma1_by_three_per_mille_fails_in_figure_10_8():
    def tables_of(gamma1_hat):
        system = vi.System(**PARAMETERS | {"gamma1_hat": gamma1_hat}, f10_hat=1.0, f20_hat=1.0)
        tau = (1500 + np.arange(4 * 100 + 1) / 100) * system.period
        run = vi.simulate(system, np.zeros(8), 1504, sample_times=tau)
        samples = curve("", "", tau=tau, X2=run.samples[:, 2], Y2=run.samples[:, 3])
        events = curve("", "", **{name: run.events[name] for name in ("tau", "module", "wall")})
        return fig10_08.compute(system, samples, events.assign(X2=run.events["state"][:, 2]))

    assert table_differences(tables_of(0.2), tables_of(0.2 * 1.003), COLUMNS["fig10_08"])[0]
