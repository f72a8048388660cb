"""The tables of the reference sets, and the columns that SPECs declare for them."""

from pipeline_trees import ROOT
from vibroimpact.tables import read
from vibroimpact_pipeline.figure_check.check import compared_files
from vibroimpact_pipeline.figure_check.table_distances import OTHERS
from vibroimpact_pipeline.specs import each, specs

SPECS = specs()
TABLES = {
    path.stem: (path, each(spec["tables"][name]["columns"]))
    for figure, spec in SPECS.items()
    for name, (file, _) in compared_files(figure, spec).items()
    for folder in ("figures", "figures/studies")
    if (path := ROOT / folder / file).is_file()
}
"""Path and columns of each, by name."""


def published(name):
    path, columns = TABLES[name]
    return read(path), columns


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
