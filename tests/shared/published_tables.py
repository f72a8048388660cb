"""The published tables, and the figure check on changes of them."""

import numpy as np

from pipeline_trees import ROOT
from vibroimpact.tables import read
from vibroimpact_pipeline.figure_check.check import compared_files
from vibroimpact_pipeline.figure_check.table_distances import KINDS, OTHERS, table_differences
from vibroimpact_pipeline.specs import each, specs

FOLDERS = {path.name.removesuffix(".csv"): path.parent for path in sorted((ROOT / "figures").rglob("*.csv"))}
"""Folders of the reference sets by table."""
COLUMNS = {
    file.removesuffix(".csv"): each(spec["tables"][name]["columns"])
    for figure, spec in specs().items()
    for name, (file, _) in compared_files(figure, spec).items()
    if file.removesuffix(".csv") in FOLDERS
}
"""Columns by name of each published table."""
DECIDED_BY_ROUNDING = {"rounding", "certificate", "amplitudes", "extremes", "peaks", "shares", "spreads"}
DECIDED_BY_ROUNDING |= {"measured error", "order", "of the machine"}


def tables_in(folder: str) -> list[str]:
    """The tables of a reference set."""
    return [name for name in COLUMNS if FOLDERS[name] == ROOT / folder]


def published(name):
    return read(FOLDERS[name] / f"{name}.csv"), COLUMNS[name]


def differs(name, change):
    """True if the check tells a published table from what `change` makes of it, and not from itself."""
    old, columns = published(name)
    assert table_differences(old, old.copy(), columns)[0] == []
    return table_differences(old, change(old.copy()), columns)[0] != []


def by_kind(name):
    """(column, kind, rows) of a published table, rows that are not blank."""
    table, columns = published(name)
    for column, entry in columns.items():
        kinds = entry.get("compared", ())
        series = kinds if isinstance(kinds, dict) else {OTHERS: kinds} if kinds else {}
        words = table.iloc[:, :2].itertuples(index=False, name=None)
        own = [series.get(next((word for word in row if word in series), OTHERS)) for row in words]
        for kind in dict.fromkeys(series.values()):
            rows = table.index[[one == kind for one in own]]
            rows = rows[table.loc[rows, column].notna() & (table.loc[rows, column] != "")]
            if len(rows):
                yield column, kind, rows


def numbers(name):
    """(column, rows) of the numbers of a published table that rounding does not decide."""
    for column, kind, rows in by_kind(name):
        if kind not in DECIDED_BY_ROUNDING and "rows" not in KINDS[kind]["limits"]:
            yield column, rows


def unnoticed(name, without=()):
    """The numbers of a published table, of the largest and the middle one of each column, that may be 1 % off."""
    old, columns = published(name)
    assert table_differences(old, old.copy(), columns)[0] == []
    found = []
    for column, rows in numbers(name):
        sizes = old.loc[rows, column].abs().replace([0, np.inf], np.nan).dropna().sort_values()
        for row in {sizes.index[-1], sizes.index[len(sizes) // 2]} if len(sizes) and column not in without else ():
            new = old.astype({column: float})
            new.loc[row, column] *= 1.01
            if table_differences(old, new, columns)[0] == []:
                found.append((column, row))
    return found


def kinds_used() -> set[str]:
    """The kinds of comparison that SPECs name."""
    used = set()
    for spec in specs().values():
        for table in spec["tables"].values():
            for column in each(table["columns"]).values():
                kinds = column.get("compared", ())
                used |= set(kinds.values()) if isinstance(kinds, dict) else {kinds} if kinds else set()
    return used
