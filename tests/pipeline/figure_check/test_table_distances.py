"""Test distances between tables: each measure on numbers with a known distance, and changed published tables."""

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
VALUE = {"value": {"compared": "kind"}}
BOTH = {"absolute": 0.5, "relative": 0.1}


@pytest.fixture
def apart(monkeypatch):
    """Return a function apart(measure, old, new, limit), the distance of a column between tables with one series."""

    def apart(measure, old, new, limit=1.0):
        monkeypatch.setitem(KINDS, "kind", {"limits": {measure: limit}})
        old, new = (curve("a", "s", value=values) for values in (old, new))
        return {one["measure"]: one["distance"] for one in table_differences(old, new, VALUE)[1]}[measure]

    return apart


def test_measures_against_numbers_known_otherwise(apart):
    for new in (7.0, 13.0):
        assert apart("difference", [0.0, 10.0], [0.1, new], BOTH) == pytest.approx(2)
    assert apart("difference", [0.0, 10.0], [0.1, 10.0], BOTH) == pytest.approx(0.2)
    for old, new in ((1e-9, 1e-7), (1e-7, 1e-9)):
        assert apart("decades", [1e-3, old], [1e-3, new]) == pytest.approx(2)
    assert apart("decades", [1e-3, 0.0], [1e-3, 1e-18]) == 0
    for by in (-0.1, 0.1):
        assert apart("mean", [0.1, 0.3, 0.8], np.array([0.1, 0.3, 0.8]) + by) == pytest.approx(0.25)
    old = 10.0 ** RANDOM.uniform(-9, -3, size=101)
    assert apart("middle", old, 1000 * old) == apart("middle", 1000 * old, old) == pytest.approx(3)
    assert apart("middle", old, old * 10.0 ** RANDOM.uniform(-1, 1, size=101)) < 0.5


def test_classes_are_compared_by_the_rows_that_differ_and_by_the_balance_of_these(apart):
    old, few = np.repeat(["one", "two"], [900, 100]), np.repeat(["one", "two"], [930, 70])
    assert apart("balance", old, few) == pytest.approx(30 / np.sqrt(30))
    assert apart("rows", old, few) == pytest.approx(0.03)
    elsewhere = np.concatenate([old[-100:], old[:-100]])  # moved rows, with equal numbers in each class
    assert (apart("balance", old, elsewhere), apart("rows", old, elsewhere)) == (0, pytest.approx(0.2))
    counts, more = np.full(50, 2.0), np.repeat([2.0, 3.0], [44, 6])
    assert apart("balance", counts, more) == apart("balance", more, counts) == pytest.approx(np.sqrt(6))
    assert apart("rows", counts, more + 1e-9) == pytest.approx(6 / 50)


def test_a_balance_is_as_rare_as_the_same_tosses_of_a_coin(apart):
    """60 rows move, 45 of them up: compare the exact binomial test with the normal approximation."""
    new = np.repeat([0.0, 1.0, 2.0], [15, 40, 45])
    exact = binomtest(45, 60).pvalue
    assert 2 * norm.sf(apart("balance", np.ones(100), new)) == pytest.approx(exact, rel=0.3)


@pytest.mark.parametrize("number", [1, 4, 5, 7])
def test_a_class_that_vanishes_is_never_near_unless_it_is_scarce(apart, number):
    old = np.repeat(["one", "two"], [900, number])
    vanished = number > 4
    assert (apart("balance", old, np.repeat(["one"], 900 + number), 99) == MAX_DISTANCE) == vanished
    assert (
        apart("balance", np.repeat([0.0, 0.2], [900, number]), np.zeros(900 + number), 99) == MAX_DISTANCE
    ) == vanished


def test_a_shift_of_one_series_and_of_many_short_ones(monkeypatch):
    """The balance is taken for each series, the middle over all rows of a kind."""
    old = join([curve("a", str(number), value=np.arange(1.0, 2.0 + 30 * (number == 0))) for number in range(40)])
    monkeypatch.setitem(KINDS, "kind", {"limits": {"middle": 0.02, "balance": 4}})
    for series, measure in ([old["series"] == "0"], "balance"), ([old["series"] != "0"], "middle"):
        new = old.assign(value=old["value"].where(~series[0], 1.1 * old["value"]))
        _, found = table_differences(old, new, VALUE)
        assert [one["measure"] for one in found if one["distance"] > 1] == [measure]


def test_infinity_is_a_place_where_it_is_declared(monkeypatch):
    monkeypatch.setitem(KINDS, "kind", {"limits": {"difference": {"absolute": 4.0, "relative": 0}}})
    columns = {"value": {"compared": "kind", "infinite": True}}
    old, new, other = (curve("a", "s", value=[x, 4.0, y]) for x, y in ((0.0, np.inf), (1.0, np.inf), (0.0, 4.0)))
    assert table_differences(old, new, columns)[1][0]["distance"] == pytest.approx(0.25)
    assert table_differences(old, other, columns)[1][0]["distance"] == MAX_DISTANCE
    assert table_differences(old, old, VALUE)[0] == ["value: infinite value"]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda t: t.rename(columns={"B": "b"}), "columns are panel, series, C, b instead of panel, series, C, B"),
        (lambda t: t.iloc[1:], "SIM, SIM unstable: "),
        (lambda t: t.assign(series=t["series"].replace("B_min", "b")), "SIM, B_min: 0 rows instead of 2"),
        (lambda t: t.iloc[::-1], "SIM, "),
        (lambda t: t.assign(B=t["B"].where(t["C"] > 0)), "B: blank cells differ"),
        (lambda t: t.assign(B=t["B"].where(t["C"] > 0, np.nan).where(t["C"] > 9)), "B: blank cells differ"),
        (lambda t: t.assign(B=t["B"].where(t["C"] != 1, np.inf)), "B: infinite value"),
        (lambda t: t.sort_values("series", kind="stable"), "the order of the series differs"),
    ],
)
def test_what_cannot_be_compared_is_said(change, said):
    old, columns = published("fig10_04")
    reasons, _ = table_differences(old, change(old), columns)
    assert any(said in reason for reason in reasons), reasons


def test_what_is_wrong_in_both_fails():
    table, columns = published("fig10_04")
    for spoilt, said in [
        (table.iloc[:0], "no rows"),
        (table.assign(B=np.nan), "B: all cells are blank"),
        (table.drop(columns=["C", "B"]), "no column that the SPEC compares"),
        (table.assign(new=1.0), "new: the SPEC states no limit for this column"),
    ]:
        assert said in table_differences(spoilt, spoilt, columns)[0]


@pytest.mark.parametrize("name", tables_in("figures"))
def test_one_number_off_by_a_per_cent_fails(name):
    assert unnoticed(name) == []


def test_of_the_accuracy_charts_errors_orders_and_failures_are_compared_and_seconds_are_not():
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


def test_gamma1_off_by_three_per_mille_moves_figure_10_8_by_more_than_its_limit():
    def settled(gamma1_hat):
        system = vi.System(**PARAMETERS | {"gamma1_hat": gamma1_hat}, f10_hat=1.0, f20_hat=1.0)
        tau = (1500 + np.arange(4 * 100 + 1) / 100) * system.period
        run = vi.simulate(system, np.zeros(8), 1504, sample_times=tau)
        samples = curve("", "", tau=tau, X2=run.samples[:, 2], Y2=run.samples[:, 3])
        events = curve("", "", **{name: run.events[name] for name in ("tau", "module", "wall")})
        return fig10_08.compute(system, samples, events.assign(X2=run.events["state"][:, 2]))

    assert table_differences(settled(0.2), settled(0.2 * 1.003), COLUMNS["fig10_08"])[0]
