"""Published tables, and the figure check on changed copies."""

import numpy as np

from pipeline_trees import ROOT
from vibroimpact.tables import read
from vibroimpact_pipeline.figure_check.check import compared_files
from vibroimpact_pipeline.figure_check.table_distances import KINDS, OTHER_SERIES, table_differences
from vibroimpact_pipeline.specs import each, specs

FOLDERS = {path.name.removesuffix(".csv"): path.parent for path in sorted((ROOT / "figures").rglob("*.csv"))}
"""Folder of the reference set of each table, by the name of the table."""
COLUMNS = {
    file.removesuffix(".csv"): each(spec["tables"][name]["columns"])
    for figure, spec in specs().items()
    for name, (file, _) in compared_files(figure, spec).items()
    if file.removesuffix(".csv") in FOLDERS
}
"""Columns of each published table, by the name of the table."""
DECIDED_BY_ROUNDING = {"rounding", "certificate", "amplitudes", "extremes", "peaks", "spreads"}
DECIDED_BY_ROUNDING |= {"measured error", "order", "of the machine"}


def tables_in(folder: str) -> list[str]:
    """Return the names of the tables in a reference set."""
    return [name for name in COLUMNS if FOLDERS[name] == ROOT / folder]


def published(name):
    return read(FOLDERS[name] / f"{name}.csv"), COLUMNS[name]


def by_kind(name):
    """Yield (column, kind, rows that are not blank) for each column and kind in a published table."""
    table, columns = published(name)
    for column, entry in columns.items():
        kinds = entry.get("compared", ())
        series = kinds if isinstance(kinds, dict) else {OTHER_SERIES: kinds} if kinds else {}
        words = list(table.iloc[:, :2].itertuples(index=False, name=None))
        assert {*series} - {OTHER_SERIES} <= {word for row in words for word in row}, f"{column}: an unknown series"
        own = [series.get(next((word for word in row if word in series), OTHER_SERIES)) for row in words]
        for kind in dict.fromkeys(series.values()):
            rows = table.index[[one == kind for one in own]]
            rows = rows[table.loc[rows, column].notna() & (table.loc[rows, column] != "")]
            if len(rows):
                yield column, kind, rows


def unnoticed(name, without=()):
    """Return (column, row) of numbers that may be wrong by 1 %; in each column, largest and middle number are tried.

    Numbers that depend on rounding are left out.
    """
    old, columns = published(name)
    assert table_differences(old, old.copy(), columns)[0] == []
    found = []
    for column, kind, rows in by_kind(name):
        if kind in DECIDED_BY_ROUNDING or "rows" in KINDS[kind]["limits"] or column in without:
            continue
        sizes = old.loc[rows, column].abs().replace([0, np.inf], np.nan).dropna().sort_values()
        for row in {sizes.index[-1], sizes.index[len(sizes) // 2]} if len(sizes) else ():
            new = old.astype({column: float})
            new.loc[row, column] *= 1.01
            if table_differences(old, new, columns)[0] == []:
                found.append((column, row))
    return found
