"""Distances of tables of plotted numbers from their references, by series and column."""

import math
from collections import Counter
from pathlib import Path

import numpy as np
import pandas as pd
import yaml

FLOOR = 1e-17
"""Errors below this are as good as none; so low does a logarithmic axis go."""
SAME = 1e-6
"""Share of the axis: an outcome, or a value of a sample, that moves by less is the same."""
KEYS = ("panel", "series"), ("quantity",)
"""Columns that part the rows of a table into series."""
OTHERS = "others"
"""Stands for the series that have no kind of their own."""
KINDS = yaml.safe_load(Path(__file__).with_name("tolerances.yaml").read_text(encoding="utf-8"))
"""Kinds of numbers: the MEASURES they are compared by, each with its limit, and the reason."""


def compare(old: pd.DataFrame, new: pd.DataFrame, columns: dict[str, dict]) -> tuple[list[str], list[dict]]:
    """Return the reasons why a table fails, one line each, and the distance of each column from its reference.

    Args:
        columns: entries of a SPEC. A column of text that is not compared names its row, and must be the same.

    Returns as distances: column, kind, measure, limit, distance, where it is (the row that is farthest off), reference
    and new (the values there; of a sample the medians).
    """
    reasons = _structure(old, new, columns) or _lacks(new, columns)
    found = [] if reasons else list(_distances(old, new, columns).values())
    for one in found:
        if one["kind"] is None:
            reasons.append(f"no limit is stated for column {one['column']}")
        elif not one["distance"] <= one["limit"]:
            before, after = (v if isinstance(v, str) else f"{v:.9g}" for v in (one["reference"], one["new"]))
            far = f"{one['column']} is off by {one['distance']:.2g} {UNITS[one['measure']]}, limit {one['limit']:g}"
            reasons.append(f"{far} ({one['where']}: {after} instead of {before})")
    return reasons, [{key: _plain(value) for key, value in one.items()} for one in found]


def _plain(value):
    """Return a value that JSON can hold: no NumPy scalar, None for a number that is not finite."""
    value = value.item() if hasattr(value, "item") else value
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _structure(old, new, columns):
    """Return reasons why two tables cannot be compared: different columns, rows or blanks."""
    if list(old) != list(new):
        return [f"columns {', '.join(new)} instead of {', '.join(old)}"]
    found, texts = [], _texts(old)
    before, after = _by_series(old), _by_series(new)
    for series in before | after:
        parts = [table.get(series, old.iloc[:0]) for table in (before, after)]
        kinds = [_kinds(part, series, columns) for part in parts]
        if not all(map(_is_sample, kinds)):
            found += _rows_that_differ(*parts, [name for name in texts if name not in kinds[0]])
    return found or ["the same series in another order"] * (list(before) != list(after))


def _rows_that_differ(old, new, texts):
    names, new_names = _names(old, texts), _names(new, texts)
    counts, new_counts = Counter(names), Counter(new_names)
    if counts != new_counts:
        differ = [name for name in counts | new_counts if counts[name] != new_counts[name]]
        return [f"{name}: {new_counts[name] or 'no'} rows instead of {counts[name] or 'none'}" for name in differ]
    if names != new_names:
        return ["the same rows in another order"]
    blanks = old.isna().to_numpy() != new.isna().to_numpy()
    return [f"{name}: blank in other rows" for name, other in zip(old, blanks.any(axis=0), strict=True) if other]


def _lacks(table, columns):
    """Return what a table lacks: rows, declared columns, values, finite numbers; its reference may lack the same."""
    compared = {name: entry["compared"] for name, entry in columns.items() if "compared" in entry and name in table}
    if table.empty or not compared:
        return ["no rows" if table.empty else "none of the columns that its SPEC declares"]
    found = []
    for name, kinds in compared.items():
        key = "series" if "series" in table else "quantity"
        parts = {} if isinstance(kinds, str) else {s: table[table[key] == s] for s in kinds if s != OTHERS}
        lacking = [f" in series {s}" for s, part in parts.items() if len(part) and not _given(part[name]).any()]
        found += [f"no value of {name}{where}" for where in ([] if _given(table[name]).any() else [""]) or lacking]
    finite = [name for name in table.select_dtypes("number") if not columns.get(name, {}).get("infinite")]
    return found + [f"{name} is infinite" for name in finite if np.isinf(table[name].to_numpy(float)).any()]


def _distances(old, new, columns):
    """Return by column, kind and measure the entry with the largest distance over all series."""
    new_parts, farthest = _by_series(new), {}
    numbers, texts = old.select_dtypes("number").columns, _texts(old)
    for series, part in _by_series(old).items():
        fresh, kinds = new_parts[series], _kinds(part, series, columns)
        unruled = {name: None for name in numbers if name not in kinds and part[name].notna().any()}
        for column, kind in (kinds | unruled).items():
            scales = _scales(old, column)[part.index]
            for measure, limit in (KINDS[kind]["limits"] if kind else {"largest": None}).items():
                far, row = MEASURES[measure][0](part[column], fresh[column], scales)
                if far > farthest.get((column, kind, measure), {"distance": -1})["distance"]:
                    place = {"where": ", ".join(series)} | {
                        name: float(values[column].median()) if row is None else values[column].iloc[row]
                        for name, values in (("reference", part), ("new", fresh))
                    }
                    if row is not None:
                        place["where"] = f"{_names(part.iloc[[row]], texts)[0]}, row {part.index[row] + 1}"
                    rule = {"column": column, "kind": kind, "measure": measure, "limit": limit}
                    farthest[column, kind, measure] = rule | {"distance": float(far)} | place
    return farthest


def _kinds(part, series, columns):
    """Return the kind of each column that has values in a series."""
    found = {}
    for name in part:
        kind = columns.get(name, {}).get("compared")
        kind = kind.get(series[-1], kind.get(OTHERS)) if isinstance(kind, dict) else kind
        if kind and _given(part[name]).any():
            found[name] = kind
    return found


def _is_sample(kinds):
    """True if a series with columns of these kinds is a sample, in which no row has its counterpart."""
    return bool(kinds) and all("distribution" in KINDS[kind]["limits"] for kind in kinds.values())


def _largest(old, new, scales):
    shares = _shares(old, new, scales)
    return shares.max(), int(shares.argmax())


def _decades(old, new, scales):
    return _largest(*(np.log10(values.clip(lower=FLOOR)) for values in (old, new)), 1.0)


def _middle_of_decades(old, new, scales):
    """Return the shift of the median of log10, whatever single values do."""
    old, new = (np.log10(values.dropna().clip(lower=FLOOR)) for values in (old, new))
    return abs(new.median() - old.median()), None


def _part_of_rows(old, new, scales):
    numbers = pd.api.types.is_numeric_dtype(old)
    # Texts as arrays: rows after a sample of another size have other numbers.
    before, after = (None, None) if numbers else (values.fillna("").to_numpy() for values in (old, new))
    differs = _shares(old, new, scales) > SAME if numbers else before != after
    return differs.mean(), int(differs.argmax())


def _times_chance(old, new, scales):
    """Return the two-sample Kolmogorov-Smirnov statistic; values equal to rounding count as ties."""
    old, new = (np.sort(values.dropna().to_numpy(float)) for values in (old, new))
    slack, n, m = SAME * float(scales.max()), len(old), len(new)
    return max(_lead(old, new, slack), _lead(new, old, slack)) * np.sqrt(n * m / (n + m)), None


def _lead(ahead, behind, slack):
    """Return the largest excess of one empirical distribution over another that is shifted by the slack."""
    below = np.searchsorted(behind, ahead + slack, side="right") / len(behind)
    return (np.arange(1, len(ahead) + 1) / len(ahead) - below).max()


def _standard_score_of_sizes(old, new, scales):
    """Return the difference of two sample sizes in standard deviations of Poisson counts."""
    n, m = (int(values.notna().sum()) for values in (old, new))
    return abs(n - m) / np.sqrt(n + m), None


def _standard_errors(old, new, scales):
    """Return the difference of two means in standard errors."""
    old, new = (values.dropna().to_numpy(float) for values in (old, new))
    error = np.sqrt(sum(values.var(ddof=1) / len(values) if len(values) > 1 else 0.0 for values in (old, new)))
    return abs(old.mean() - new.mean()) / (error + SAME * float(scales.max())), None


MEASURES = {
    "largest": (_largest, "of its axis"),
    "decades": (_decades, "decades"),
    "middle of decades": (_middle_of_decades, "decades in the middle"),
    "part of rows": (_part_of_rows, "of its rows"),
    "distribution": (_times_chance, "times chance"),
    "size": (_standard_score_of_sizes, "times chance in number"),
    "mean": (_standard_errors, "standard errors"),
}
UNITS = {measure: unit for measure, (_, unit) in MEASURES.items()}
"""Units of the distances. The axis is the range of the reference's column in its panel; if that range is zero, and in
tables without panels, the reference itself. The distance of values that are not finite is infinite."""


def _shares(old, new, scales):
    old, new = (pd.to_numeric(values, errors="coerce").to_numpy(float) for values in (old, new))
    with np.errstate(invalid="ignore"):
        shares = np.abs(new - old) / np.asarray(scales)
    return np.where(np.isnan(old) | (old == new), 0.0, np.where(np.isfinite(shares), shares, np.inf))


def _scales(table, name):
    """Return the length of the axis for every row; NaN for a column of text."""
    if name in _texts(table):
        return pd.Series(np.nan, table.index)
    values = table[name].replace([np.inf, -np.inf], np.nan)
    sizes = values.abs().where(values != 0, 1.0)
    if "panel" not in table:
        return sizes
    panels = values.groupby(table["panel"])
    ranges = panels.transform("max") - panels.transform("min")
    return ranges.where(ranges > 0, sizes)


def _texts(table):
    return list(table.select_dtypes(exclude="number"))


def _given(values):
    return values.notna() & (values != "")


def _by_series(table):
    """Return rows by (panel, series) or by (quantity,), in order; a table without these columns as one group, ("",)."""
    keys = next((keys for keys in KEYS if {*keys} <= {*table}), None)
    return dict(iter(table.groupby(list(keys), sort=False))) if keys else {("",): table}


def _names(table, texts):
    """Return the text columns of each row, joined: "a1, SIM stable"."""
    return [", ".join(map(str, row)) for row in table[texts].itertuples(index=False, name=None)]
