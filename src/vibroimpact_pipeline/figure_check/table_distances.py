"""Distances of tables of plotted numbers from their references, by series and column."""

from pathlib import Path

import numpy as np
import pandas as pd
import yaml

KINDS = {}
"""Kinds of numbers: the limit of each of the MEASURES that compare them, and the reason."""
for path in (Path(__file__).with_name("tolerances.yaml"), Path(__file__).parents[1] / "studies/tolerances.yaml"):
    if path.is_file():  # a checkout may lack the second
        KINDS |= yaml.safe_load(path.read_text(encoding="utf-8"))
OTHERS = "others"
"""Stands for the series that have no kind of their own."""
FAR = 999.0
"""Distance of what no limit allows: a value that is not finite, a class that vanishes."""
SMALLEST = 1e-17
"""Errors below this are as good as none; so low does a logarithmic axis go."""
SAME = 1e-6
"""Counts and shares that differ by less are the same."""
SCARCE = 5
"""Rows below which a class may vanish: rounding was seen to move all of three."""
STILL = 1e-3
"""Part of a number by which it has to move to count as moved."""


def compare(old: pd.DataFrame, new: pd.DataFrame, columns: dict[str, dict]) -> tuple[list[str], list[dict]]:
    """Return the reasons why a table fails, one line each, and the distance of each column from its reference.

    Rows whose first two words, of those that are not compared, are equal are a series. In a series rows correspond one
    by one.

    Args:
        columns: entries of a SPEC. A column of words that is not compared must be the same.

    Returns as distances: column, kind, measure, distance (1 is the limit), where the largest is, and there the value of
    the reference and the new one (of a whole column the medians).
    """
    if list(old) != list(new):
        return [f"columns {', '.join(new)} instead of {', '.join(old)}"], []
    reasons, parts, farthest = _wrong_in_itself(new, columns), {}, []
    before, after = _by_series(old, columns), _by_series(new, columns)
    for series in before | after:
        a, b = (rows.get(series, old.iloc[:0]) for rows in (before, after))
        given = _given(a)
        kinds = {name: kind for name in old if (kind := _kind(columns, name, series)) and given[name].any()}
        words = [name for name in _words(old) if name not in kinds]
        if not _same(a[words], b[words]):
            reasons.append(f"{', '.join(series)}: other rows, {len(b)} instead of {len(a)}")
            continue
        others = (given.to_numpy() != _given(b).to_numpy()).any(axis=0)
        for name in (name for name in old if name not in words):
            if others[old.columns.get_loc(name)]:
                reasons.append(f"{name}: blank in other rows ({', '.join(series)})")
            elif name in kinds:
                parts.setdefault((name, kinds[name]), []).append((a, b))
            elif given[name].any():
                reasons.append(f"no limit is stated for column {name}")
    for (name, kind), pairs in parts.items():
        whole = [tuple(pd.concat(rows) for rows in zip(*pairs, strict=True))]
        for measure in KINDS[kind]["limits"]:
            each = pairs if measure == "balance" else whole
            found = [_distance(a, b, name, kind, measure) for a, b in each]
            farthest.append(max(found, key=lambda one: one["distance"]))
    reasons += ["the same series in another order"] * (not reasons and list(before) != list(after))
    for one in (one for one in farthest if one["distance"] > 1):
        far = f"{one['column']} is off by {one['distance']:.2g} times its limit ({one['kind']}, {one['measure']})"
        reasons.append(f"{far}: {one['new']} instead of {one['reference']} ({one['where']})")
    return reasons, farthest


def _wrong_in_itself(table, columns):
    """Return errors of a table by itself, though its reference may have the same."""
    compared = [name for name, entry in columns.items() if "compared" in entry and name in table]
    if table.empty or not compared:
        return ["no rows" if table.empty else "none of the columns that its SPEC declares"]
    finite = [name for name in table.select_dtypes("number") if not columns.get(name, {}).get("infinite")]
    lacking = [f"no value of {name}" for name in compared if not _given(table[name]).any()]
    return lacking + [f"{name} is infinite" for name in finite if np.isinf(table[name]).any()]


def _by_series(table, columns):
    """Return the rows of each series, in order; a table without such words is one, ("",)."""
    texts = [name for name in _words(table) if not pd.api.types.is_bool_dtype(table[name])]
    words = [name for name in texts if "compared" not in columns.get(name, {})][:2]
    return dict(iter(table.groupby(words, sort=False))) if words else {("",): table}


def _kind(columns, name, series):
    """Return the kind of a column in a series, None if it is not compared."""
    kinds = columns.get(name, {}).get("compared")
    if not isinstance(kinds, dict):
        return kinds
    return next((kinds[word] for word in series if word in kinds), kinds.get(OTHERS))


def _words(table):
    return list(table.select_dtypes(exclude="number"))


def _same(old, new):
    return old.reset_index(drop=True).equals(new.reset_index(drop=True))


def _given(values):
    return values.notna() & (values != "")


def _distance(old, new, name, kind, measure):
    """Return the largest distance of a column by a measure of its kind."""
    before, after = (part[name].to_numpy() for part in (old, new))
    with np.errstate(all="ignore"):
        far = np.nan_to_num(MEASURES[measure](before, after, KINDS[kind]["limits"][measure]), nan=FAR)
    if np.ndim(far):
        far = np.where((before == after) | pd.isna(before), 0.0, far)
        row = int(far.argmax())
        far, values, place = far[row], (before[row], after[row]), f"row {old.index[row] + 1}"
    else:
        row, values, place = 0, (np.nanmedian(before), np.nanmedian(after)), "in the middle"
    where = ", ".join([*map(str, old[_words(old)].iloc[row].dropna()), place])
    old_value, new_value = (value if isinstance(value, str) else f"{value:.9g}" for value in values)
    found = {"column": name, "kind": kind, "measure": measure, "distance": min(float(far), FAR), "where": where}
    return found | {"reference": old_value, "new": new_value}


def printed_distances(points: pd.DataFrame, table: pd.DataFrame) -> tuple[list[str], list[dict]]:
    """Return the reasons why a table fails, and the largest distance of a point of the printed book, as `compare`.

    Args:
        points: rows with columns of `table`, and the tolerance as a part of the extent of each axis. The words of a
            point name its curve, which joins the rows of `table` with these words. A blank cell does not count.
    """
    if unknown := set(points) - {*table, "tolerance"}:
        return [f"columns that the figure does not have: {', '.join(sorted(unknown))}"], []
    reasons, found = [], []
    for number, point in points.iterrows():
        point = point[_given(point)]
        words = [name for name in _words(table) if name in point]
        axes = [name for name in table if name in point and name not in words]
        where = ", ".join([*map(str, point[words]), f"row {number + 1}"])
        curve = table.loc[(table[words] == point[words]).all(axis=1), axes].dropna()
        if curve.empty or "panel" not in point or not point.get("tolerance", 0) > 0:
            reasons.append(f"no such curve, no panel or no tolerance above 0 ({where})")
            continue
        panel = table.loc[table["panel"] == point["panel"], axes]
        extent = (panel.max() - panel.min()).replace(0.0, 1.0)
        printed = point[axes].to_numpy(float) / extent
        nearest = _nearest(printed.to_numpy(), (curve / extent).to_numpy())
        far = np.linalg.norm(nearest - printed) / point["tolerance"]
        old, new = (", ".join(f"{value:.9g}" for value in place * extent) for place in (printed, nearest))
        one = {"column": ", ".join(axes), "kind": "printed", "measure": "nearest", "distance": min(far, FAR)}
        found.append(one | {"where": where, "reference": old, "new": new})
        if far > 1:
            reasons.append(f"{one['column']} is off by {far:.2g} times its tolerance: {new} instead of {old} ({where})")
    return reasons, sorted(found, key=lambda one: one["distance"])[-1:]


def _nearest(point, curve):
    """Return the place nearest to a point (d,) on the polyline through the rows of `curve`, (n, d)."""
    step = np.diff(curve, axis=0, append=curve[-1:])
    part = ((point - curve) * step).sum(axis=1) / np.maximum((step**2).sum(axis=1), np.finfo(float).tiny)
    places = curve + np.clip(part, 0.0, 1.0)[:, None] * step
    return places[np.linalg.norm(places - point, axis=1).argmin()]


# Measures of two columns, arrays (n,): the distance of each row, or one of all rows, of which 1 is the limit.


def _difference(old, new, limit):
    """Compare numbers by their difference; the limit has an absolute part and one relative to the reference."""
    return np.abs(new - old) / (limit["absolute"] + limit["relative"] * np.abs(old))


def _decades(old, new, limit):
    """Compare numbers by their logarithms."""
    return np.abs(_shifts(old, new)) / limit


def _middle(old, new, limit):
    """Compare a column by the median shift of its logarithms, whatever single rows do."""
    return np.abs(np.nanmedian(_shifts(old, new))) / limit


def _shifts(old, new):
    return np.log10(np.maximum(new, SMALLEST)) - np.log10(np.maximum(old, SMALLEST))


def _mean(old, new, limit):
    """Compare a column by its mean, relative to the reference, whatever single rows do."""
    return np.abs(np.nanmean(new) / np.nanmean(old) - 1) / limit


def _rows(old, new, limit):
    """Compare classes, or numbers, by the share of rows in which they differ."""
    differ = old != new if old.dtype == object else np.abs(new - old) > SAME
    return differ * differ.mean() / limit


def _balance(old, new, limit):
    """Compare rows that join a class with rows that leave it, or numbers that rise with numbers that fall.

    Rounding moves as many one way as the other: their difference is measured in standard deviations of tosses of a
    coin, one for each row that moved. A class that vanishes is never near, unless it is scarce.
    """
    far = np.zeros(len(old))
    for label in {*old, *new} if old.dtype == object else [None]:
        before, after = (np.nan_to_num(x if label is None else (x == label).astype(float)) for x in (old, new))
        moved = np.where(np.abs(after - before) > STILL * np.abs(before), np.sign(after - before), 0.0)
        vanished = np.count_nonzero(before) >= SCARCE and not after.any()
        distance = FAR if vanished else abs(moved.sum()) / np.sqrt(max(np.count_nonzero(moved), 1)) / limit
        far = np.maximum(far, np.where(moved != 0, distance, 0.0))
    return far


MEASURES = {
    "difference": _difference,
    "decades": _decades,
    "middle": _middle,
    "mean": _mean,
    "rows": _rows,
    "balance": _balance,
}
