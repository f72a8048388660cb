"""Distances of tables of plotted numbers from their references, by series and column."""

from pathlib import Path

import numpy as np
import pandas as pd
import yaml
from scipy.stats import ks_2samp

KINDS = yaml.safe_load(Path(__file__).with_name("tolerances.yaml").read_text(encoding="utf-8"))
"""Kinds of numbers: the limit of each of the MEASURES that compare them, and the reason."""
OTHERS = "others"
"""Stands for the series that have no kind of their own."""
FAR = 999.0
"""Distance of what no limit allows: a value that is not finite, a class that vanishes."""
SMALLEST = 1e-17
"""Errors below this are as good as none; so low does a logarithmic axis go."""
SAME = 1e-6
"""Counts and shares that differ by less are the same."""
DIGITS = 6
"""Decimals of the values of a sample, so that those equal but for rounding are ties."""


def compare(old: pd.DataFrame, new: pd.DataFrame, columns: dict[str, dict]) -> tuple[list[str], list[dict]]:
    """Return the reasons why a table fails, one line each, and the distance of each column from its reference.

    Rows whose first two words, of those that are not compared, are equal are a series. In a series rows correspond one
    by one, unless its numbers are samples.

    Args:
        columns: entries of a SPEC. A column of words that is not compared must be the same.

    Returns as distances: column, kind, measure, distance (1 is the limit), where the largest is, and there the value of
    the reference and the new one (of a whole series the medians).
    """
    if list(old) != list(new):
        return [f"columns {', '.join(new)} instead of {', '.join(old)}"], []
    reasons, farthest = _wrong_in_itself(new, columns), {}
    before, after = _by_series(old, columns), _by_series(new, columns)
    for series in before | after:
        a, b = (parts.get(series, old.iloc[:0]) for parts in (before, after))
        kinds = {name: kind for name in old if (kind := _kind(columns, name, series)) and _given(a[name]).any()}
        words = [name for name in _words(old) if name not in kinds]
        sample = bool(kinds) and all("distribution" in KINDS[kind]["limits"] for kind in kinds.values())
        if a.empty or b.empty or not (sample or _same(a[words], b[words])):
            reasons.append(f"{', '.join(series)}: other rows, {len(b)} instead of {len(a)}")
            continue
        for name in (name for name in old if name not in words):
            if not sample and (_given(a[name]).to_numpy() != _given(b[name]).to_numpy()).any():
                reasons.append(f"{name}: blank in other rows ({', '.join(series)})")
            elif name in kinds:
                for found in _distances(a, b, name, kinds[name]):
                    key = name, found["kind"], found["measure"]
                    farthest[key] = max(farthest.get(key, found), found, key=lambda one: one["distance"])
            elif _given(a[name]).any():
                reasons.append(f"no limit is stated for column {name}")
    reasons += ["the same series in another order"] * (not reasons and list(before) != list(after))
    for one in (one for one in farthest.values() if one["distance"] > 1):
        far = f"{one['column']} is off by {one['distance']:.2g} times its limit ({one['kind']}, {one['measure']})"
        reasons.append(f"{far}: {one['new']} instead of {one['reference']} ({one['where']})")
    return reasons, list(farthest.values())


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


def _distances(old, new, name, kind):
    """Yield the largest distance of a column in a series by each measure of its kind."""
    before, after = (part[name].to_numpy() for part in (old, new))
    for measure, limit in KINDS[kind]["limits"].items():
        with np.errstate(all="ignore"):
            far = np.nan_to_num(MEASURES[measure](before, after, limit), nan=FAR)
        if np.ndim(far):
            far = np.where((before == after) | pd.isna(before), 0.0, far)
            row = int(far.argmax())
            far, values, place = far[row], (before[row], after[row]), f"row {old.index[row] + 1}"
        else:
            row, values, place = 0, (np.nanmedian(before), np.nanmedian(after)), "in the middle"
        where = ", ".join([*map(str, old[_words(old)].iloc[row].dropna()), place])
        old_value, new_value = (value if isinstance(value, str) else f"{value:.9g}" for value in values)
        found = {"column": name, "kind": kind, "measure": measure, "distance": min(float(far), FAR), "where": where}
        yield found | {"reference": old_value, "new": new_value}


# Measures of two columns, arrays (n,): the distance of each row, or one of all rows, of which 1 is the limit.


def _difference(old, new, limit):
    """Compare numbers by their difference; the limit has an absolute part and one relative to the reference."""
    return np.abs(new - old) / (limit["absolute"] + limit["relative"] * np.abs(old))


def _decades(old, new, limit):
    """Compare numbers by their logarithms."""
    return np.abs(_shifts(old, new)) / limit


def _middle(old, new, limit):
    """Compare numbers by the median shift of their logarithms, whatever single ones do."""
    return np.abs(np.nanmedian(_shifts(old, new))) / limit


def _shifts(old, new):
    return np.log10(np.maximum(new, SMALLEST)) - np.log10(np.maximum(old, SMALLEST))


def _rows(old, new, limit):
    """Compare classes, or counts, by the share of rows in which they differ."""
    differ = old != new if old.dtype == object else np.abs(new - old) > SAME
    return differ * differ.mean() / limit


def _classes(old, new, limit):
    """Compare numbers of rows in each class, or sums of counts, in standard deviations of Poisson counts.

    A class that vanishes is never near.
    """
    far = np.zeros(len(old))
    for label in {*old, *new} if old.dtype == object else [None]:
        before, after = (np.nan_to_num((x if label is None else x == label).astype(float)) for x in (old, new))
        n, m = before.sum(), after.sum()
        distance = FAR if n and not m else abs(n - m) / np.sqrt(n + m) / limit
        far = np.maximum(far, np.where(before != after, distance, 0.0))
    return far


def _distribution(old, new, limit):
    """Compare samples by the two-sample Kolmogorov-Smirnov statistic, times the root of their size."""
    old, new = (np.round(values[~np.isnan(values)], DIGITS) for values in (old, new))
    n, m = len(old), len(new)
    return ks_2samp(old, new, method="asymp").statistic * np.sqrt(n * m / (n + m)) / limit


def _size(old, new, limit):
    """Compare sizes of samples, in standard deviations of Poisson counts."""
    n, m = (np.count_nonzero(~np.isnan(values)) for values in (old, new))
    return abs(n - m) / np.sqrt(n + m) / limit


MEASURES = {
    "difference": _difference,
    "decades": _decades,
    "middle": _middle,
    "rows": _rows,
    "classes": _classes,
    "distribution": _distribution,
    "size": _size,
}
