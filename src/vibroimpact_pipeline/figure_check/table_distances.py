"""Compute distances between tables of plotted numbers and their reference tables, for each series and column."""

from pathlib import Path

import numpy as np
import pandas as pd
import yaml

KINDS = {}
"""For each kind of number, the limit of each of its MEASURES, and the reason for these limits."""
for path in (Path(__file__).with_name("tolerances.yaml"), Path(__file__).parents[1] / "studies/tolerances.yaml"):
    if path.is_file():  # the package `studies` may not be installed
        KINDS |= yaml.safe_load(path.read_text(encoding="utf-8"))
OTHER_SERIES = "others"
"""Key in `compared` for all series that the SPEC does not name."""
MAX_DISTANCE = 999.0
"""Distance assigned to changes that no limit allows, such as a value that becomes infinite or a class that vanishes."""
LOG_FLOOR = np.finfo(float).eps
"""Smallest number of which a logarithm is taken; smaller numbers count as this value. They are errors of coordinates of
order one due to rounding, which depends on the processor."""
EQUAL_WITHIN = 1e-6
"""Counts and shares that differ by less than this value are equal."""
RARE_ROWS = 5
"""A class with fewer rows than this may vanish, since in one case rounding changed all rows of a class of three."""
MOVED_BY = 1e-3
"""A number counts as moved if its relative change is larger than this value."""


def table_differences(old: pd.DataFrame, new: pd.DataFrame, columns: dict[str, dict]) -> tuple[list[str], list[dict]]:
    """Return the reasons why a table fails, and the distance of each column from its reference.

    Text columns whose SPEC entry does not contain `compared` must be equal in both tables. The first two of them name
    the series: rows with the same text in these two columns form a series. Each series of `new` is compared, row by
    row, with the same series of `old`.

    Parameters
    ----------
    old
        Reference table.
    new
        Table of the build.
    columns
        Entry of each column in the SPEC (description) of the figure, by name.

    Returns
    -------
    reasons : list of str
        One line for each reason; the list is empty if the table passes.
    distances : list of dict
        One mapping for each column and measure, with these keys:

        - column: name of the column.
        - kind: kind of number in the column, a key of KINDS.
        - measure: name of the measure of the distance, a key of MEASURES.
        - distance: largest distance, in units of the limit.
        - where: text that names the row with the largest distance.
        - reference, new: values of `old` and `new` in this row. If the measure gives one distance for the whole column,
          these values are the medians of the column in `old` and in `new`.
    """
    if list(old) != list(new):
        return [f"columns are {', '.join(new)} instead of {', '.join(old)}"], []
    reasons, parts, farthest = _wrong_in_itself(new, columns), {}, []
    before, after = _by_series(old, columns), _by_series(new, columns)
    for series in before | after:
        a, b = (rows.get(series, old.iloc[:0]) for rows in (before, after))
        given = _given(a)
        kinds = {name: kind for name in old if (kind := _kind(columns, name, series)) and given[name].any()}
        words = [name for name in _words(old) if name not in kinds]
        if not a[words].reset_index(drop=True).equals(b[words].reset_index(drop=True)):
            other = [
                name for name in words if not a[name].reset_index(drop=True).equals(b[name].reset_index(drop=True))
            ]
            differ = (
                f"values differ in {', '.join(other)}" if len(a) == len(b) else f"{len(b)} rows instead of {len(a)}"
            )
            reasons.append(f"{', '.join(series)}: {differ}")
            continue
        others = (given.to_numpy() != _given(b).to_numpy()).any(axis=0)
        for name in (name for name in old if name not in words):
            if others[old.columns.get_loc(name)]:
                reasons.append(f"{name}: blank cells differ ({', '.join(series)})")
            elif name in kinds:
                parts.setdefault((name, kinds[name]), []).append((a, b))
            elif given[name].any():
                reasons.append(f"{name}: the SPEC states no limit for this column")
    for (name, kind), pairs in parts.items():
        whole = [tuple(pd.concat(rows) for rows in zip(*pairs, strict=True))]
        for measure in KINDS[kind]["limits"]:
            each = pairs if measure == "balance" else whole
            found = [_distance(a, b, name, kind, measure) for a, b in each]
            farthest.append(max(found, key=lambda one: one["distance"]))
    reasons += ["the order of the series differs"] * (not reasons and list(before) != list(after))
    for one in (one for one in farthest if one["distance"] > 1):
        far = f"{one['column']} is off by {one['distance']:.2g} times its limit ({one['kind']}, {one['measure']})"
        reasons.append(f"{far}: {one['new']} instead of {one['reference']} ({one['where']})")
    return reasons, farthest


def _wrong_in_itself(table, columns):
    """Return the errors of a table that can be detected without the reference table."""
    compared = [name for name, entry in columns.items() if "compared" in entry and name in table]
    if table.empty or not compared:
        return ["no rows" if table.empty else "no column that the SPEC compares"]
    finite = [name for name in table.select_dtypes("number") if not columns.get(name, {}).get("infinite")]
    required = [name for name in compared if columns[name]["compared"] != "of the machine"]
    lacking = [f"{name}: all cells are blank" for name in required if not _given(table[name]).any()]
    return lacking + [f"{name}: infinite value" for name in finite if np.isinf(table[name]).any()]


def _by_series(table, columns):
    """Return a mapping from the name of each series to its rows, in the order in which the series begin.

    The name of a series is a tuple of texts from the table. If no column contains names of series, all rows form one
    series with the name ("",).
    """
    texts = [name for name in _words(table) if not pd.api.types.is_bool_dtype(table[name])]
    words = [name for name in texts if "compared" not in columns.get(name, {})][:2]
    return dict(iter(table.groupby(words, sort=False))) if words else {("",): table}


def _kind(columns, name, series):
    """Return the key of KINDS that applies to a column in one series, or None if the column is not compared."""
    kinds = columns.get(name, {}).get("compared")
    if not isinstance(kinds, dict):
        return kinds
    return next((kinds[word] for word in series if word in kinds), kinds.get(OTHER_SERIES))


def _words(table):
    return list(table.select_dtypes(exclude="number"))


def _given(values):
    return values.notna() & (values != "")


def _distance(old, new, name, kind, measure):
    """Return the largest distance that one measure gives for a column.

    The result has the form of an entry of `distances`, the list that `table_differences` returns.
    """
    before, after = (part[name].to_numpy() for part in (old, new))
    with np.errstate(all="ignore"):
        far = np.nan_to_num(MEASURES[measure](before, after, KINDS[kind]["limits"][measure]), nan=MAX_DISTANCE)
    if np.ndim(far):
        far = np.where((before == after) | pd.isna(before), 0.0, far)
        row = int(far.argmax())
        far, values, place = far[row], (before[row], after[row]), f"row {old.index[row] + 1}"
    else:
        row, values, place = 0, (np.nanmedian(before), np.nanmedian(after)), "median"
    where = ", ".join([*map(str, old[_words(old)].iloc[row].dropna()), place])
    old_value, new_value = (value if isinstance(value, str) else f"{value:.9g}" for value in values)
    found = {"column": name, "kind": kind, "measure": measure, "distance": min(float(far), MAX_DISTANCE)}
    return found | {"where": where, "reference": old_value, "new": new_value}


def printed_distances(points: pd.DataFrame, table: pd.DataFrame) -> tuple[list[str], list[dict]]:
    """Compare points that were read from the printed book with the curves in a table.

    Return the reasons for failure, and a list that contains only the largest distance. Both lists have the form that
    `table_differences` returns.

    Parameters
    ----------
    points
        One row for each point, with some columns of `table` and the column `tolerance`. The rows of `table` with the
        same text cells as the point form the curve of the point. The tolerance is the largest allowed distance between
        the point and the curve. Before the distance is computed, each coordinate is divided by its range in the panel.
    table
        Plotted table of the build.
    """
    if unknown := set(points) - {*table, "tolerance"}:
        return [f"unknown columns {', '.join(sorted(unknown))}; expected any of {', '.join(table)}, tolerance"], []
    reasons, found = [], []
    for number, point in points.iterrows():
        point = point[_given(point)]
        words = [name for name in _words(table) if name in point]
        axes = [name for name in table if name in point and name not in words]
        where = ", ".join([*map(str, point[words]), f"row {number + 1}"])
        curve = table.loc[(table[words] == point[words]).all(axis=1), axes].dropna()
        if curve.empty or "panel" not in point or not point.get("tolerance", 0) > 0:
            reasons.append(f"the point should name a panel, an existing curve and a tolerance above 0 ({where})")
            continue
        panel = table.loc[table["panel"] == point["panel"], axes]
        extent = (panel.max() - panel.min()).replace(0.0, 1.0)
        printed = point[axes].to_numpy(float) / extent
        nearest = _nearest(printed.to_numpy(), (curve / extent).to_numpy())
        far = np.linalg.norm(nearest - printed) / point["tolerance"]
        old, new = (", ".join(f"{value:.9g}" for value in place * extent) for place in (printed, nearest))
        one = {"column": ", ".join(axes), "kind": "printed", "measure": "nearest", "distance": min(far, MAX_DISTANCE)}
        found.append(one | {"where": where, "reference": old, "new": new})
        if far > 1:
            reasons.append(f"{one['column']} is off by {far:.2g} times its tolerance: {new} instead of {old} ({where})")
    return reasons, sorted(found, key=lambda one: one["distance"])[-1:]


def _nearest(point, curve):
    """Return the point on a polyline that is nearest to `point`, as an array of shape (d,).

    The array `point` has shape (d,). The rows of `curve`, an array of shape (n, d), are the corners of the polyline.
    """
    step = np.diff(curve, axis=0, append=curve[-1:])
    part = ((point - curve) * step).sum(axis=1) / np.maximum((step**2).sum(axis=1), np.finfo(float).tiny)
    places = curve + np.clip(part, 0.0, 1.0)[:, None] * step
    return places[np.linalg.norm(places - point, axis=1).argmin()]


# The following functions are the measures. A measure compares the columns `old` and `new` of shape (n,). It returns one
# distance for each row, or one distance for all rows, in units of `limit`.


def _difference(old, new, limit):
    """Compare numbers by their difference; the limit is the sum of an absolute and a relative part."""
    return np.abs(new - old) / (limit["absolute"] + limit["relative"] * np.abs(old))


def _decades(old, new, limit):
    """Compare numbers by the difference of their decimal logarithms."""
    return np.abs(_shifts(old, new)) / limit


def _middle(old, new, limit):
    """Compare numbers by the difference of their decimal logarithms, and take the median of all rows."""
    return np.abs(np.nanmedian(_shifts(old, new))) / limit


def _shifts(old, new):
    return np.log10(np.maximum(new, LOG_FLOOR)) - np.log10(np.maximum(old, LOG_FLOOR))


def _rows(old, new, limit):
    """Compare classes or numbers by the share of rows that differ."""
    differ = old != new if old.dtype == object else np.abs(new - old) > EQUAL_WITHIN
    return differ * differ.mean() / limit


def _balance(old, new, limit):
    """Compare the number of rows that enter a class with the number of rows that leave this class (sign test).

    For a column of numbers, compare the number of increases with the number of decreases. Rounding errors cause both
    changes equally often. Let n_1 and n_2 be the two numbers that are compared. The distance of a class or a column is
    |n_1 - n_2| / sqrt(n_1 + n_2). For rounding errors, the denominator is the standard deviation of n_1 - n_2.
    """
    far = np.zeros(len(old))
    for label in {*old, *new} if old.dtype == object else [None]:
        before, after = (np.nan_to_num(x if label is None else (x == label).astype(float)) for x in (old, new))
        moved = np.where(np.abs(after - before) > MOVED_BY * np.abs(before), np.sign(after - before), 0.0)
        vanished = np.count_nonzero(before) >= RARE_ROWS and not after.any()
        distance = MAX_DISTANCE if vanished else abs(moved.sum()) / np.sqrt(max(np.count_nonzero(moved), 1)) / limit
        far = np.maximum(far, np.where(moved != 0, distance, 0.0))
    return far


MEASURES = {
    "difference": _difference,
    "decades": _decades,
    "middle": _middle,
    "rows": _rows,
    "balance": _balance,
}
