"""What the figure check notices in the tables of the studies, and what rounding may move there."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from pandas.api.types import is_numeric_dtype

from published_tables import by_kind, published, tables_in
from vibroimpact_pipeline.figure_check.table_distances import table_differences

STUDIES = tables_in("figures/studies")
REBUILDS = pd.read_csv(Path(__file__).with_name("rebuilds.csv.gz"), dtype=str)
"""Cells that differ from the reference in the chaotic tables of builds that were rounded otherwise: build, table, row,
column, value. `engine` is a build of another engine; in the others each parameter was moved by 1 to 4 units in the last
place. Six digits."""
CHAOTIC = sorted(set(REBUILDS["table"]))
VANISHING = ["symmetric", "hopping", "quasi-periodic", "unsettled", "no impacts"]
OF_CHANCE = {"spreads", "exponent"}
"""Standard errors and deviations of few values, whose own digits are chance."""


def built(build, name):
    """A chaotic table as a build made it."""
    table, _ = published(name)
    for column, cells in REBUILDS[(REBUILDS["build"] == build) & (REBUILDS["table"] == name)].groupby("column"):
        if is_numeric_dtype(table[column]):
            table[column] = table[column].astype(float)
        table.loc[cells["row"].astype(int), column] = cells["value"].astype(table[column].dtype).to_numpy()
    return table


def differs(name, change):
    """True if the check tells a published table from what `change` makes of it."""
    old, columns = published(name)
    return table_differences(old, change(old.copy()), columns)[0] != []


@pytest.mark.parametrize("name", CHAOTIC)
def test_a_build_that_is_rounded_otherwise_passes(name):
    """Whichever of two builds is the reference."""
    _, columns = published(name)
    builds = sorted(set(REBUILDS["build"][REBUILDS["table"] == name]))
    tables = {build: built(build, name) for build in ("reference", *builds)}
    for before, after in combinations(tables, 2):
        assert table_differences(tables[before], tables[after], columns)[0] == [], (before, after)


@pytest.mark.parametrize("name", STUDIES)
def test_a_shift_of_a_column_by_a_tenth_fails(name):
    old, columns = published(name)
    for column, kind, rows in by_kind(name):
        words = not is_numeric_dtype(old[column])
        if kind in OF_CHANCE or (words and len(rows) < 30) or (not words and not old.loc[rows, column].any()):
            continue
        new = old.copy() if words else old.astype({column: float})
        if words:  # a tenth of the rows, one after the other of the commonest word, become the next commonest
            common, other = new.loc[rows, column].value_counts().index[:2]
            new.loc[rows[new.loc[rows, column] == common][: int(np.ceil(0.1 * len(rows)))], column] = other
        else:  # errors that are rounding itself move by a tenth of the 16 decades of their axis
            new.loc[rows, column] *= 10**1.6 if kind == "rounding" else 1.1
        assert table_differences(old, new, columns)[0] != [], (column, kind)


def contiguous(column, before, after, cells):
    def change(table):
        rows = table.index[table[column] == before][100 : 100 + cells]
        return table.assign(**{column: table[column].where(~table.index.isin(rows), after)})

    return change


def exchanged(table):
    """Move cells of a regime to another place: numbers of cells are the same."""
    first, second = (table.index[table["regime"] == one][:20] for one in ("strongly modulated", "asymmetric"))
    table.loc[first, "regime"], table.loc[second, "regime"] = "asymmetric", "strongly modulated"
    return table


@pytest.mark.parametrize(
    ("name", "change", "caught"),
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
def test_chaotic_numbers_are_held_to_what_rounding_may_move(name, change, caught):
    assert differs(name, change) == caught


@pytest.mark.parametrize("regimes", [*([one] for one in VANISHING), VANISHING], ids="-".join)
def test_a_regime_that_vanishes_from_the_map_fails(regimes):
    assert differs("companion_regime_map", lambda table: table.assign(**dict.fromkeys(regimes, 0.0)))
    if regimes not in (["symmetric"], ["no impacts"]):  # few cells, or those of few starts
        words = dict.fromkeys(regimes, "chaotic")
        assert differs("companion_regime_map", lambda table: table.assign(regime=table["regime"].replace(words)))


@pytest.mark.parametrize(("by", "caught"), [(3.8e-16, False), (1e-6, True)])
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
