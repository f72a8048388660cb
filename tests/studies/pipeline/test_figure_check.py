"""Test which changes of the tables of the studies fail the figure check, and that rounding errors pass."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from pandas.api.types import is_numeric_dtype

from published_tables import by_kind, published, tables_in, unnoticed
from vibroimpact_pipeline.figure_check.table_distances import KINDS, table_differences
from vibroimpact_pipeline.specs import each, specs

STUDIES = tables_in("figures/studies")
REBUILDS = pd.read_csv(Path(__file__).with_name("rebuilds.csv.gz"), dtype=str)
"""Cells of chaotic tables in which builds with other rounding errors differ from the reference: build, table, row,
column, and value with six digits. The build `engine` used another engine; the others used parameters changed by 1 to 4
units in the last place."""
CHAOTIC = sorted(set(REBUILDS["table"]))
VANISHING = ["symmetric", "hopping", "quasi-periodic", "unsettled", "no impacts"]
UNCERTAINTIES = {"spreads", "exponent"}
"""Kinds of columns with standard errors or deviations of few values, which are random themselves."""
STANDARD_ERRORS = {"companion_epsilon.orders": ["uncertainty"]}
"""Columns with standard errors of fits, which depend on rounding."""


def built(build, name):
    """Return a chaotic table of one of the builds."""
    table, _ = published(name)
    for column, cells in REBUILDS[(REBUILDS["build"] == build) & (REBUILDS["table"] == name)].groupby("column"):
        if is_numeric_dtype(table[column]):
            table[column] = table[column].astype(float)
        table.loc[cells["row"].astype(int), column] = cells["value"].astype(table[column].dtype).to_numpy()
    return table


def differs(name, change):
    """Return True if a change of a published table fails the figure check."""
    old, columns = published(name)
    return table_differences(old, change(old.copy()), columns)[0] != []


@pytest.mark.parametrize("name", CHAOTIC)
def test_builds_with_other_rounding_errors_pass(name):
    """Each pair of builds is compared, with one of them as the reference."""
    _, columns = published(name)
    builds = sorted(set(REBUILDS["build"][REBUILDS["table"] == name]))
    tables = {build: built(build, name) for build in ("reference", *builds)}
    for before, after in combinations(tables, 2):
        assert table_differences(tables[before], tables[after], columns)[0] == [], (before, after)


@pytest.mark.parametrize("name", STUDIES)
def test_a_change_of_one_number_by_one_per_cent_fails(name):
    assert unnoticed(name, STANDARD_ERRORS.get(name, ())) == []


def test_every_kind_of_comparison_is_used():
    tables = [table for spec in specs().values() for table in spec["tables"].values()]
    kinds = [entry["compared"] for table in tables for entry in each(table["columns"]).values() if "compared" in entry]
    assert {name for kind in kinds for name in (kind.values() if isinstance(kind, dict) else [kind])} == set(KINDS)


@pytest.mark.parametrize("name", STUDIES)
def test_a_change_of_a_column_by_a_tenth_fails(name):
    old, columns = published(name)
    for column, kind, rows in by_kind(name):
        words = not is_numeric_dtype(old[column])
        if kind in UNCERTAINTIES or (words and len(rows) < 30) or (not words and not old.loc[rows, column].any()):
            continue
        new = old.copy() if words else old.astype({column: float})
        if words:  # the first rows with the commonest word, a tenth of all rows, get the second commonest
            common, other = new.loc[rows, column].value_counts().index[:2]
            new.loc[rows[new.loc[rows, column] == common][: int(np.ceil(0.1 * len(rows)))], column] = other
        else:  # rounding errors change by a tenth of the 16 decades of their axis
            new.loc[rows, column] *= 10**1.6 if kind == "rounding" else 1.1
        assert table_differences(old, new, columns)[0] != [], (column, kind)


def contiguous(column, before, after, cells):
    """Return a function that changes a value of a column from `before` to `after` in consecutive cells."""

    def change(table):
        rows = table.index[table[column] == before][100 : 100 + cells]
        return table.assign(**{column: table[column].where(~table.index.isin(rows), after)})

    return change


def exchanged(table):
    """Exchange two regimes in 20 cells each, so that the number of cells of each regime is the same."""
    first, second = (table.index[table["regime"] == name][:20] for name in ("strongly modulated", "asymmetric"))
    table.loc[first, "regime"], table.loc[second, "regime"] = "asymmetric", "strongly modulated"
    return table


@pytest.mark.parametrize(
    ("name", "change", "fails"),
    [
        ("companion_regime_map", contiguous("regime", "strongly modulated", "asymmetric", 40), True),
        ("companion_regime_map", exchanged, True),
        ("companion_basins", contiguous("label", "strongly modulated", "asymmetric", 35), True),
        ("companion_basins", lambda table: table.assign(label=["symmetric", *table["label"][1:]]), False),
        ("companion_absorber", lambda table: table.assign(ratio=1.1 * table["ratio"]), True),
        ("companion_branches.attractors", lambda table: table.assign(C2=0.8 * table["C2"]), True),
        ("companion_branches.attractors", lambda table: table.assign(C2=1.0005 * table["C2"]), False),
        ("companion_horizon", lambda t: t.assign(error=np.where(t["series"] == "measured", 30, 1) * t["error"]), True),
    ],
)
def test_changes_of_chaotic_tables_fail_if_rounding_cannot_cause_them(name, change, fails):
    assert differs(name, change) == fails


@pytest.mark.parametrize("regimes", [*([one] for one in VANISHING), VANISHING], ids="-".join)
def test_a_regime_that_vanishes_from_the_map_fails(regimes):
    assert differs("companion_regime_map", lambda table: table.assign(**dict.fromkeys(regimes, 0.0)))
    if regimes not in (["symmetric"], ["no impacts"]):  # these regimes have few cells, or few starts per cell
        words = dict.fromkeys(regimes, "chaotic")
        assert differs("companion_regime_map", lambda table: table.assign(regime=table["regime"].replace(words)))


@pytest.mark.parametrize(("by", "fails"), [(3.8e-16, False), (1e-6, True)])
def test_a_value_near_zero_may_change_by_an_absolute_limit(by, fails):
    def changed(table):
        row = table["C1"].abs().idxmin()
        assert abs(table.loc[row, "C1"]) < 1e-15
        table.loc[row, "C1"] += by
        return table

    assert differs("companion_branches.special_points", changed) == fails


@pytest.mark.parametrize(("decades", "fails"), [(0.00094, False), (0.05, True)])
def test_an_error_of_some_billionths_may_change_by_rounding_of_roots(decades, fails):
    def changed(table):
        row = (table["error"] - 4.6e-9).abs().idxmin()
        assert table.loc[row, "error"] == pytest.approx(4.6e-9, rel=0.01)
        table.loc[row, "error"] *= 10**decades
        return table

    assert differs("companion_epsilon", changed) == fails
