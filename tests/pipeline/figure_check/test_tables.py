"""How far tables are apart: each measure on numbers whose distance is known, and the published tables, changed."""

import numpy as np
import pytest
from scipy.stats import ks_2samp, ttest_ind

import vibroimpact as vi
from chapter import PARAMETERS
from pipeline_trees import ROOT
from vibroimpact.figures import fig10_08
from vibroimpact.figures.kit.tables import curve, join, read
from vibroimpact_pipeline.figure_check import tables
from vibroimpact_pipeline.figure_check.tables import MEASURES, compare
from vibroimpact_pipeline.specs import each, specs

SPECS = specs()
RANDOM = np.random.default_rng(5)
VALUE = {"value": {"compared": "kind"}}


@pytest.fixture
def apart(monkeypatch):
    """apart(measure, old, new): distance of a column between tables of one series."""

    def apart(measure, old, new):
        sample = {"distribution": 1.0} if measure in ("distribution", "size") else {}  # of which sizes may differ
        monkeypatch.setitem(tables.KINDS, "kind", {"limits": sample | {measure: 1.0}})
        old, new = (curve("a", "s", value=values) for values in (old, new))
        return {one["measure"]: one["distance"] for one in compare(old, new, VALUE)[1]}[measure]

    return apart


@pytest.mark.parametrize("measure", MEASURES)
def test_the_same_is_no_distance_away(apart, measure):
    assert apart(measure, [1.0, 2.0, 4.0], [1.0, 2.0, 4.0]) == 0


def test_measures_against_numbers_known_otherwise(apart):
    assert apart("largest", [0.0, 2.0, 4.0], [0.0, 2.5, 4.1]) == pytest.approx(0.125)
    assert apart("decades", [1e-3, 1e-9], [1e-3, 1e-7]) == pytest.approx(2)
    assert apart("decades", [1e-3, 0.0], [1e-3, 1e-18]) == 0
    assert apart("part of rows", [0.0, 1.0, 2.0, 3.0], [0.0, 1.0 + 1e-9, 5.0, 3.5]) == 0.5
    old, new = RANDOM.normal(size=300), RANDOM.normal(0.4, size=250)
    assert apart("distribution", old, new) == pytest.approx(ks_2samp(old, new).statistic * np.sqrt(300 * 250 / 550))
    assert apart("size", RANDOM.normal(size=2000), RANDOM.normal(size=500)) == pytest.approx(1500 / np.sqrt(2500))
    old, new = RANDOM.normal(size=17), RANDOM.normal(0.5, size=17)
    assert apart("mean", old, new) == pytest.approx(abs(ttest_ind(old, new, equal_var=False).statistic), rel=1e-4)
    old = 10.0 ** RANDOM.uniform(-9, -3, size=101)
    assert apart("middle of decades", old, 1000 * old) == pytest.approx(3)
    assert apart("middle of decades", old, old * 10.0 ** RANDOM.uniform(-1, 1, size=101)) < 0.5


def test_samples_of_one_distribution_are_near_and_rounding_of_equal_values_is_nothing(apart):
    random = np.random.default_rng(3)
    assert max(apart("distribution", *random.exponential(size=(2, 400))) for _ in range(50)) < 2.2
    equal = np.append(np.ones(40), 5.0)
    assert apart("distribution", equal, equal + random.normal(0, 1e-12, 41)) == 0


def test_infinity_is_a_place_and_no_axis_where_it_is_declared(monkeypatch):
    monkeypatch.setitem(tables.KINDS, "kind", {"limits": {"largest": 1.0}})
    columns = {"value": {"compared": "kind", "infinite": True}}
    old, new, other = (curve("a", "s", value=[x, 4.0, y]) for x, y in ((0.0, np.inf), (1.0, np.inf), (0.0, 4.0)))
    assert compare(old, new, columns)[1][0]["distance"] == pytest.approx(0.25)
    assert compare(old, other, columns)[1][0]["distance"] is None
    assert compare(old, other, columns)[0] != []
    assert compare(old, old, VALUE)[0] == ["value is infinite"]


def test_outcomes_are_texts_that_may_differ_and_others_may_not(monkeypatch):
    monkeypatch.setitem(tables.KINDS, "outcome", {"limits": {"part of rows": 0.3}})
    monkeypatch.setitem(tables.KINDS, "kind", {"limits": {"largest": 1.0}})
    old = join([curve("a", "s", label=["one", "two", "two", "two"], value=np.arange(4.0))])
    new = old.assign(label=["one", "one", "two", "two"])
    reasons, found = compare(old, new, VALUE | {"label": {"compared": "outcome"}})
    assert reasons == []
    assert [(one["distance"], one["reference"], one["new"]) for one in found if one["column"] == "label"] == [
        (0.25, "two", "one")
    ]
    assert compare(old, new, VALUE)[0] == ["a, s, one: 2 rows instead of 1", "a, s, two: 2 rows instead of 3"]


def test_outcomes_after_a_sample_of_another_size_are_compared(monkeypatch):
    monkeypatch.setitem(tables.KINDS, "outcome", {"limits": {"part of rows": 0.3}})
    monkeypatch.setitem(tables.KINDS, "some", {"limits": {"distribution": 9.0}})
    columns = {"value": {"compared": {"dots": "some"}}, "label": {"compared": {"ends": "outcome"}}}
    old, new = (
        join([curve("a", "dots", value=np.arange(size)), curve("a", "ends", label=["one", "two", "two", last])])
        for size, last in ((3.0, "two"), (5.0, "one"))
    )
    reasons, found = compare(old, new, columns)
    assert reasons == []
    assert [one["distance"] for one in found if one["column"] == "label"] == [0.25]


def test_a_series_has_a_kind_of_its_own(monkeypatch):
    monkeypatch.setitem(tables.KINDS, "some", {"limits": {"distribution": 1.0}})
    monkeypatch.setitem(tables.KINDS, "kind", {"limits": {"largest": 1.0}})
    columns = {"value": {"compared": {"dots": "some", "others": "kind"}}}
    old = join([curve("a", "line", value=[0.0, 1.0]), curve("a", "dots", value=[0.2, 0.4, 0.6])])
    new = join([curve("a", "line", value=[0.0, 1.0]), curve("a", "dots", value=[0.3, 0.5])])
    reasons, found = compare(old, new, columns)
    assert (reasons, {one["kind"]: one["distance"] == 0 for one in found}) == ([], {"kind": True, "some": False})
    assert compare(old, new[new["series"] == "line"], columns)[0] == ["a, dots: no rows instead of 3"]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda t: t.rename(columns={"B": "b"}), "columns panel, series, C, b instead of panel, series, C, B"),
        (lambda t: t.iloc[1:], "SIM, SIM unstable: "),
        (lambda t: t.assign(series=t["series"].replace("B_min", "b")), "SIM, B_min: no rows instead of 2"),
        (lambda t: t.iloc[::-1], "the same series in another order"),
        (lambda t: t.assign(B=t["B"].where(t["C"] > 0)), "B: blank in other rows"),
        (lambda t: t.assign(B=t["B"].where(t["C"] > 0, np.nan).where(t["C"] > 9)), "B: blank in other rows"),
        (lambda t: t.assign(B=t["B"].where(t["C"] != 1, np.inf)), "B is infinite"),
    ],
)
def test_what_cannot_be_compared_is_said(change, said):
    old, columns = read(ROOT / "figures/fig10_04.csv"), each(SPECS["fig10_04"]["tables"]["csv"]["columns"])
    reasons, _ = compare(old, change(old), columns)
    assert any(reason.startswith(said) for reason in reasons), reasons


def test_what_is_wrong_in_both_fails():
    columns = each(SPECS["fig10_04"]["tables"]["csv"]["columns"])
    table = read(ROOT / "figures/fig10_04.csv")
    for spoilt, said in [
        (table.iloc[:0], "no rows"),
        (table.assign(B=np.nan), "no value of B"),
        (table.drop(columns=["C", "B"]), "none of the columns that its SPEC declares"),
        (table.assign(new=1.0), "no limit is stated for column new"),
    ]:
        assert said in compare(spoilt, spoilt, columns)[0]


# The published tables


def worse_arithmetic(table):
    return table.assign(error=table["error"].where(table["series"] != "measured", 30 * table["error"]))


def lost_bursts(table):
    """Three of ten, wherever they are."""
    bursts = table.index[table["panel"] == "bursts"]
    return table.drop(np.random.default_rng(1).choice(bursts, 3 * len(bursts) // 10, replace=False))


def longer_bursts(table):
    return table.assign(length=table["length"].where(table["series"] == "window", 1.02 * table["length"]))


def other_ends(cells):
    def change(table):
        chosen = table.index[table["series"] == "start"][:cells]
        return table.assign(label=table["label"].where(~table.index.isin(chosen), "symmetric"))

    return change


@pytest.mark.parametrize(
    ("name", "change", "caught"),
    [
        ("companion_horizon", worse_arithmetic, True),
        ("companion_modulation", lost_bursts, True),
        ("companion_modulation", longer_bursts, False),  # not told from another rounding
        ("companion_basins", other_ends(1), False),
        ("companion_basins", other_ends(60), True),
    ],
)
def test_chaotic_numbers_are_held_to_what_rounding_may_move(name, change, caught):
    old, columns = read(ROOT / f"figures/{name}.csv"), each(SPECS[name]["tables"]["csv"]["columns"])
    assert compare(old, old, columns)[0] == []
    assert bool(compare(old, change(old), columns)[0]) == caught


@pytest.mark.parametrize(("gamma1_hat", "caught"), [(0.2, False), (0.2 * 1.003, True)])
def test_gamma1_off_by_three_per_mille_moves_figure_10_8_by_more_than_its_limit(gamma1_hat, caught):
    def settled(gamma1_hat):
        system = vi.System(**PARAMETERS | {"gamma1_hat": gamma1_hat}, f10_hat=1.0, f20_hat=1.0)
        tau = (1500 + np.arange(4 * 100 + 1) / 100) * system.period
        run = vi.simulate(system, np.zeros(8), 1504, sample_times=tau)
        samples = curve("", "", tau=tau, X2=run.samples[:, 2], Y2=run.samples[:, 3])
        events = curve("", "", **{name: run.events[name] for name in ("tau", "module", "wall")})
        return fig10_08.compute(samples, events.assign(X2=run.events["state"][:, 2]))

    columns = each(SPECS["fig10_08"]["tables"]["csv"]["columns"])
    assert bool(compare(settled(0.2), settled(gamma1_hat), columns)[0]) == caught


def test_every_kind_is_used_and_every_column_of_numbers_has_one_that_there_is():
    used = set()
    for spec in SPECS.values():
        for table in spec["tables"].values():
            for column in each(table["columns"]).values():
                kinds = column.get("compared", ())
                used |= set(kinds.values()) if isinstance(kinds, dict) else {kinds} if kinds else set()
    assert used == set(tables.KINDS)
