"""How far tables are apart: each measure on numbers whose distance is known, and the published tables, changed."""

import numpy as np
import pytest
from scipy.stats import ks_2samp

import vibroimpact as vi
from chapter import PARAMETERS
from pipeline_trees import ROOT
from vibroimpact.figures import fig10_08
from vibroimpact.tables import curve, join, read
from vibroimpact_pipeline.figure_check import table_distances
from vibroimpact_pipeline.figure_check.check import compared_files
from vibroimpact_pipeline.figure_check.table_distances import FAR, KINDS, MEASURES, compare
from vibroimpact_pipeline.specs import each, specs

SPECS = specs()
RANDOM = np.random.default_rng(5)
VALUE = {"value": {"compared": "kind"}}
BOTH = {"absolute": 0.5, "relative": 0.1}
TABLES = {
    file.removesuffix(".csv"): each(spec["tables"][name]["columns"])
    for figure, spec in SPECS.items()
    for name, (file, _) in compared_files(figure, spec).items()
    if (ROOT / "figures" / file).is_file()
}
"""Columns by name of each published table."""
DECIDED_BY_ROUNDING = {"rounding", "certificate", "sample", "extremes", "peaks", "free"}


@pytest.fixture
def apart(monkeypatch):
    """apart(measure, old, new, limit): distance of a column between tables of one series."""

    def apart(measure, old, new, limit=1.0):
        sample = {"distribution": 1.0} if measure in ("distribution", "size") else {}  # of which sizes may differ
        monkeypatch.setitem(KINDS, "kind", {"limits": sample | {measure: limit}})
        old, new = (curve("a", "s", value=values) for values in (old, new))
        return {one["measure"]: one["distance"] for one in compare(old, new, VALUE)[1]}[measure]

    return apart


def published(name):
    return read(ROOT / f"figures/{name}.csv"), TABLES[name]


def differs(name, change):
    """True if the check tells a published table from what `change` makes of it, and not from itself."""
    old, columns = published(name)
    assert compare(old, old.copy(), columns)[0] == []
    return compare(old, change(old.copy()), columns)[0] != []


@pytest.mark.parametrize("measure", MEASURES)
def test_the_same_is_no_distance_away(apart, measure):
    limit = BOTH if measure == "difference" else 1.0
    assert apart(measure, [1.0, 2.0, 4.0], [1.0, 2.0, 4.0], limit) == 0


def test_measures_against_numbers_known_otherwise(apart):
    assert apart("difference", [0.0, 10.0], [0.1, 13.0], BOTH) == pytest.approx(2)
    assert apart("difference", [0.0, 10.0], [0.1, 10.0], BOTH) == pytest.approx(0.2)
    assert apart("decades", [1e-3, 1e-9], [1e-3, 1e-7]) == pytest.approx(2)
    assert apart("decades", [1e-3, 0.0], [1e-3, 1e-18]) == 0
    old, new = RANDOM.normal(size=300), RANDOM.normal(0.4, size=250)
    assert apart("distribution", old, new) == pytest.approx(ks_2samp(old, new).statistic * np.sqrt(300 * 250 / 550))
    assert apart("size", RANDOM.normal(size=2000), RANDOM.normal(size=500)) == pytest.approx(1500 / np.sqrt(2500))
    old = 10.0 ** RANDOM.uniform(-9, -3, size=101)
    assert apart("middle", old, 1000 * old) == pytest.approx(3)
    assert apart("middle", old, old * 10.0 ** RANDOM.uniform(-1, 1, size=101)) < 0.5


def test_classes_are_compared_by_their_own_number_and_by_the_rows_that_differ(apart):
    old, few = np.repeat(["one", "two"], [900, 100]), np.repeat(["one", "two"], [930, 70])
    assert apart("classes", old, few) == pytest.approx(30 / np.sqrt(100 + 70))
    assert apart("rows", old, few) == pytest.approx(0.03)
    elsewhere = np.concatenate([old[-100:], old[:-100]])  # as many of each class
    assert (apart("classes", old, elsewhere), apart("rows", old, elsewhere)) == (0, pytest.approx(0.2))
    counts, more = np.full(50, 2.0), np.repeat([2.0, 3.0], [44, 6])
    assert apart("classes", counts, more) == pytest.approx(6 / np.sqrt(100 + 106))
    assert apart("rows", counts, more + 1e-9) == pytest.approx(6 / 50)


@pytest.mark.parametrize("number", [1, 2, 7])
def test_a_class_that_vanishes_is_never_near(apart, number):
    old = np.repeat(["one", "two"], [900, number])
    assert apart("classes", old, np.repeat(["one"], 900 + number), 99) == FAR
    assert apart("classes", np.repeat([0.0, 0.2], [900, number]), np.zeros(900 + number), 99) == FAR


def test_samples_of_one_distribution_are_near_and_rounding_of_equal_values_is_nothing(apart):
    random = np.random.default_rng(3)
    assert max(apart("distribution", *random.exponential(size=(2, 400))) for _ in range(50)) < 2.2
    equal = np.append(np.ones(40), 5.0)
    assert apart("distribution", equal, equal + random.normal(0, 1e-12, 41)) == 0


@pytest.mark.filterwarnings("ignore:One or more sample arguments", "ignore:All-NaN slice")
def test_a_sample_without_values_is_never_near(apart):
    assert apart("distribution", [1.0, 2.0, 3.0], [np.nan] * 3) == FAR


def test_infinity_is_a_place_where_it_is_declared(monkeypatch):
    monkeypatch.setitem(KINDS, "kind", {"limits": {"difference": {"absolute": 4.0, "relative": 0}}})
    columns = {"value": {"compared": "kind", "infinite": True}}
    old, new, other = (curve("a", "s", value=[x, 4.0, y]) for x, y in ((0.0, np.inf), (1.0, np.inf), (0.0, 4.0)))
    assert compare(old, new, columns)[1][0]["distance"] == pytest.approx(0.25)
    assert compare(old, other, columns)[1][0]["distance"] == FAR
    assert compare(old, old, VALUE)[0] == ["value is infinite"]


def test_classes_are_words_that_may_differ_and_others_may_not(monkeypatch):
    monkeypatch.setitem(KINDS, "outcome", {"limits": {"rows": 0.3}})
    monkeypatch.setitem(KINDS, "kind", {"limits": {"decades": 1.0}})
    old = join([curve("a", "s", label=["one", "two", "two", "two"], value=np.arange(1.0, 5.0))])
    new = old.assign(label=["one", "one", "two", "two"])
    reasons, found = compare(old, new, VALUE | {"label": {"compared": "outcome"}})
    assert reasons == []
    assert [(one["reference"], one["new"]) for one in found if one["column"] == "label"] == [("two", "one")]
    assert compare(old, new, VALUE)[0] == ["a, s: other rows, 4 instead of 4"]


def test_classes_after_a_sample_of_another_size_are_compared(monkeypatch):
    monkeypatch.setitem(KINDS, "outcome", {"limits": {"rows": 0.3}})
    monkeypatch.setitem(KINDS, "some", {"limits": {"distribution": 9.0}})
    columns = {"value": {"compared": {"dots": "some"}}, "label": {"compared": {"ends": "outcome"}}}
    old, new = (
        join([curve("a", "dots", value=np.arange(size)), curve("a", "ends", label=["one", "two", "two", last])])
        for size, last in ((3.0, "two"), (5.0, "one"))
    )
    reasons, found = compare(old, new, columns)
    assert reasons == []
    assert [one["distance"] > 0 for one in found if one["column"] == "label"] == [True]


def test_a_series_has_a_kind_of_its_own(monkeypatch):
    monkeypatch.setitem(KINDS, "some", {"limits": {"distribution": 1.0}})
    monkeypatch.setitem(KINDS, "kind", {"limits": {"decades": 1.0}})
    columns = {"value": {"compared": {"dots": "some", "others": "kind"}}}
    old = join([curve("a", "line", value=[0.0, 1.0]), curve("a", "dots", value=[0.2, 0.4, 0.6])])
    new = join([curve("a", "line", value=[0.0, 1.0]), curve("a", "dots", value=[0.3, 0.5])])
    reasons, found = compare(old, new, columns)
    assert (reasons, {one["kind"]: one["distance"] == 0 for one in found}) == ([], {"kind": True, "some": False})
    assert compare(old, new[new["series"] == "line"], columns)[0] == ["a, dots: other rows, 0 instead of 3"]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda t: t.rename(columns={"B": "b"}), "columns panel, series, C, b instead of panel, series, C, B"),
        (lambda t: t.iloc[1:], "SIM, SIM unstable: "),
        (lambda t: t.assign(series=t["series"].replace("B_min", "b")), "SIM, B_min: other rows, 0 instead of 2"),
        (lambda t: t.iloc[::-1], "SIM, "),
        (lambda t: t.assign(B=t["B"].where(t["C"] > 0)), "B: blank in other rows"),
        (lambda t: t.assign(B=t["B"].where(t["C"] > 0, np.nan).where(t["C"] > 9)), "B: blank in other rows"),
        (lambda t: t.assign(B=t["B"].where(t["C"] != 1, np.inf)), "B is infinite"),
        (lambda t: t.sort_values("series", kind="stable"), "the same series in another order"),
    ],
)
def test_what_cannot_be_compared_is_said(change, said):
    old, columns = published("fig10_04")
    reasons, _ = compare(old, change(old), columns)
    assert any(said in reason for reason in reasons), reasons


def test_what_is_wrong_in_both_fails():
    table, columns = published("fig10_04")
    for spoilt, said in [
        (table.iloc[:0], "no rows"),
        (table.assign(B=np.nan), "no value of B"),
        (table.drop(columns=["C", "B"]), "none of the columns that its SPEC declares"),
        (table.assign(new=1.0), "no limit is stated for column new"),
    ]:
        assert said in compare(spoilt, spoilt, columns)[0]


# The published tables


def numbers(name):
    """(column, rows) of the numbers of a published table that rounding does not decide."""
    table, columns = published(name)
    for column, entry in columns.items():
        kinds = entry.get("compared", ())
        for series, kind in (kinds if isinstance(kinds, dict) else {None: kinds} if kinds else {}).items():
            words = table.iloc[:, :2].itertuples(index=False, name=None)
            named = kinds if isinstance(kinds, dict) else ()
            first = [next((word for word in row if word in named), "others") for row in words]
            rows = table.index if series is None else table.index[[word == series for word in first]]
            rows = rows[table.loc[rows, column].notna()]
            if kind not in DECIDED_BY_ROUNDING and "rows" not in KINDS[kind]["limits"] and len(rows):
                yield column, rows


STANDARD_ERRORS = ("companion_epsilon.orders", "uncertainty")
"""Of fits to errors: their digits are those of rounding."""


@pytest.mark.parametrize("name", TABLES)
def test_one_number_off_by_a_per_cent_fails(name):
    """The largest of a column, and the one in the middle."""
    old, columns = published(name)
    assert compare(old, old.copy(), columns)[0] == []
    for column, rows in numbers(name):
        sizes = old.loc[rows, column].abs().replace([0, np.inf], np.nan).dropna().sort_values()
        if sizes.empty or (name, column) == STANDARD_ERRORS:
            continue
        for row in {sizes.index[-1], sizes.index[len(sizes) // 2]}:
            new = old.astype({column: float})
            new.loc[row, column] *= 1.01
            assert compare(old, new, columns)[0] != [], (column, row)


@pytest.mark.parametrize(
    "regimes",
    [[one] for one in ("symmetric", "hopping", "quasi-periodic", "unsettled", "no impacts")]
    + [["symmetric", "hopping", "quasi-periodic", "unsettled", "no impacts"]],
)
def test_a_regime_that_vanishes_from_the_map_fails(regimes):
    assert differs("companion_regime_map", lambda table: table.assign(**dict.fromkeys(regimes, 0.0)))
    if regimes[0] != "no impacts":
        words = dict.fromkeys(regimes, "chaotic")
        assert differs("companion_regime_map", lambda table: table.assign(regime=table["regime"].replace(words)))


@pytest.mark.parametrize("factor", [1.19, 1 / 1.19])
@pytest.mark.parametrize("name", ["companion_absorber", "companion_absorber.summary", "companion_response"])
def test_balls_that_are_a_fifth_worse_or_better_fail(name, factor):
    column = "value" if name.endswith("summary") else "ratio"

    def changed(table):
        balls = table.iloc[:, :2].isin(["balls", "lowest peak"]).any(axis=1) | (column == "ratio")
        table.loc[balls, column] *= factor
        return table

    assert differs(name, changed)


@pytest.mark.parametrize(("by", "caught"), [(1e-16, False), (3.8e-16, False), (1e-6, True)])
def test_a_value_next_to_zero_is_held_to_an_absolute_floor(by, caught):
    def changed(table):
        row = table["C1"].abs().idxmin()
        assert abs(table.loc[row, "C1"]) < 1e-15
        table.loc[row, "C1"] += by
        return table

    assert differs("companion_branches.special_points", changed) == caught


@pytest.mark.parametrize(("decades", "caught"), [(0.00094, False), (0.05, True)])
def test_an_error_of_a_few_billionths_moves_by_what_roots_are_rounded_to(decades, caught):
    def changed(table):
        row = (table["error"] - 4.6e-9).abs().idxmin()
        assert table.loc[row, "error"] == pytest.approx(4.6e-9, rel=0.01)
        table.loc[row, "error"] *= 10**decades
        return table

    assert differs("companion_epsilon", changed) == caught


def worse_arithmetic(table):
    return table.assign(error=table["error"].where(table["series"] != "measured", 30 * table["error"]))


def moved_attractors(table):
    return table.assign(C2=0.8 * table["C2"])


def nearly_same_attractors(table):
    return table.assign(C2=1.0005 * table["C2"])


def other_ends(cells):
    def change(table):
        chosen = table.index[:cells]
        return table.assign(label=table["label"].where(~table.index.isin(chosen), "symmetric"))

    return change


@pytest.mark.parametrize(
    ("name", "change", "caught"),
    [
        ("companion_horizon", worse_arithmetic, True),
        ("companion_branches.attractors", moved_attractors, True),
        ("companion_branches.attractors", nearly_same_attractors, False),  # not told from another rounding
        ("companion_basins", other_ends(1), False),
        ("companion_basins", other_ends(60), True),
    ],
)
def test_chaotic_numbers_are_held_to_what_rounding_may_move(name, change, caught):
    assert differs(name, change) == caught


@pytest.mark.parametrize(("gamma1_hat", "caught"), [(0.2, False), (0.2 * 1.003, True)])
def test_gamma1_off_by_three_per_mille_moves_figure_10_8_by_more_than_its_limit(gamma1_hat, caught):
    def settled(gamma1_hat):
        system = vi.System(**PARAMETERS | {"gamma1_hat": gamma1_hat}, f10_hat=1.0, f20_hat=1.0)
        tau = (1500 + np.arange(4 * 100 + 1) / 100) * system.period
        run = vi.simulate(system, np.zeros(8), 1504, sample_times=tau)
        samples = curve("", "", tau=tau, X2=run.samples[:, 2], Y2=run.samples[:, 3])
        events = curve("", "", **{name: run.events[name] for name in ("tau", "module", "wall")})
        return fig10_08.compute(system, samples, events.assign(X2=run.events["state"][:, 2]))

    assert bool(compare(settled(0.2), settled(gamma1_hat), TABLES["fig10_08"])[0]) == caught


def test_every_kind_is_used_and_every_column_of_numbers_has_one_that_there_is():
    used = set()
    for spec in SPECS.values():
        for table in spec["tables"].values():
            for column in each(table["columns"]).values():
                kinds = column.get("compared", ())
                used |= set(kinds.values()) if isinstance(kinds, dict) else {kinds} if kinds else set()
    assert used == set(table_distances.KINDS)
