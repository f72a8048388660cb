"""How far a table of plotted numbers is from its reference, series by series and column by column."""

from collections import Counter
from dataclasses import dataclass

import numpy as np
import pandas as pd

FLOOR = 1e-17
"""Errors below this are as good as none; so low does a logarithmic axis go."""
OTHERS = "others"
"""Stands for the series that have no kind of their own."""
SAME = 1e-6
"""Share of the axis: an outcome, or a value of a sample, that moves by less is the same."""


@dataclass(frozen=True)
class Rules:
    """How the columns of a table are compared.

    columns: kind of each column that is compared, or its kind in each series (OTHERS: in the rest); every other column
    of text names its row, and must be the same. limits: for each kind one or several of MEASURES, with their limits.
    """

    columns: dict[str, str | dict[str, str]]
    limits: dict[str, dict[str, float]]

    def of(self, part: pd.DataFrame, series) -> dict[str, str]:
        """Kind of each column that a series has, all others left blank."""
        kinds = {name: _kind(compared, series) for name, compared in self.columns.items()}
        return {name: kind for name, kind in kinds.items() if kind and name in part and _given(part[name]).any()}

    def are_of_a_sample(self, kinds: dict[str, str]) -> bool:
        """Whether a series with columns of these kinds is a sample, in which no row has its counterpart."""
        return bool(kinds) and all("distribution" in self.limits[kind] for kind in kinds.values())


def _kind(compared, series) -> str | None:
    return compared if isinstance(compared, str) else compared.get(series, compared.get(OTHERS))


@dataclass(frozen=True)
class Distance:
    """Distance of a column from its reference in the series where it is largest, and the entry that is farthest off.

    kind and limit are None for numbers without a rule. Of a sample the medians stand for the entry.
    """

    column: str
    kind: str | None
    measure: str
    limit: float | None
    distance: float
    row: str
    reference: object
    new: object


def differences_in_structure(reference: pd.DataFrame, new: pd.DataFrame, rules: Rules) -> list[str]:
    """What keeps two tables from being compared: other columns, other rows, other blanks; one line each."""
    if list(reference.columns) != list(new.columns):
        return [f"columns {', '.join(new.columns)} instead of {', '.join(reference.columns)}"]
    old_parts, new_parts, texts = _by_series(reference), _by_series(new), _texts(reference)
    found = []
    for series in old_parts | new_parts:
        old, fresh = (parts.get(series, reference.iloc[:0]) for parts in (old_parts, new_parts))
        kinds, fresh_kinds = (rules.of(part, series[-1]) for part in (old, fresh))
        if not (rules.are_of_a_sample(kinds) and rules.are_of_a_sample(fresh_kinds)):
            found += _differences(old, fresh, [name for name in texts if name not in kinds])
    return found or ["the same series in another order"] * (list(old_parts) != list(new_parts))


def _differences(old, new, texts):
    old_rows, new_rows = _names(old, texts), _names(new, texts)
    counts, new_counts = Counter(old_rows), Counter(new_rows)
    found = [
        f"{name}: {new_counts[name] or 'no'} rows instead of {counts[name] or 'none'}"
        for name in dict.fromkeys([*old_rows, *new_rows])
        if counts[name] != new_counts[name]
    ]
    if not found and old_rows != new_rows:
        found = ["the same rows in another order"]
    if not found:
        blanks = old.isna().to_numpy() != new.isna().to_numpy()
        found = [f"{name}: blank in other rows" for name, other in zip(old, blanks.any(axis=0), strict=True) if other]
    return found


def distances(reference: pd.DataFrame, new: pd.DataFrame, rules: Rules) -> list[Distance]:
    """Distance of each column between tables of the same structure, by the measures of its kind."""
    new_parts, numbers, farthest = _by_series(new), numeric_columns(reference), {}
    scales = {column: _scales(reference, column) for column in reference}
    for series, old in _by_series(reference).items():
        fresh, kinds = new_parts[series], rules.of(old, series[-1])
        unruled = [name for name in numbers if name not in kinds and old[name].notna().any()]
        for column, kind in [*kinds.items(), *((name, None) for name in unruled)]:
            for measure, limit in rules.limits.get(kind, {"largest": None}).items():
                far, row = MEASURES[measure](old[column], fresh[column], scales[column][old.index])
                key = column, kind, measure
                if key not in farthest or far > farthest[key].distance:
                    farthest[key] = Distance(*key, limit, far, *_entry(old, fresh, column, row, series))
    return list(farthest.values())


def lacks(table: pd.DataFrame, columns: dict, infinite=()) -> list[str]:
    """What a table must have to say anything, whatever its reference says: one line each.

    columns: those that are compared, as in `Rules`; where figures share a card, one may lack some. infinite: those in
    which infinity means something.
    """
    if table.empty:
        return ["no rows"]
    parts = dict(iter(table.groupby("series"))) if "series" in table else {}
    there = {name: compared for name, compared in columns.items() if name in table}
    found = [f"no column of those its card declares: {', '.join(columns)}"] if columns and not there else []
    for name, compared in there.items():
        of_series = {} if isinstance(compared, str) else {key: parts[key] for key in compared if key in parts}
        if not _any(table[name]):
            found.append(f"no value of {name}")
        else:
            found += [f"no value of {name} in series {key}" for key, part in of_series.items() if not _any(part[name])]
    numbers = [name for name in numeric_columns(table) if name not in infinite]
    return found + [f"{name} is infinite" for name in numbers if np.isinf(table[name].to_numpy(float)).any()]


def _any(values):
    return _given(values).any()


def _entry(old, new, column, row, series):
    """Where the farthest entry is, and what it was and is."""
    if row is None:
        return ", ".join(series), float(old[column].median()), float(new[column].median())
    (name,) = _names(old.iloc[[row]], _texts(old))
    values = (table[column].iloc[row] for table in (old, new))
    return f"{name}, row {old.index[row] + 1}", *(v if isinstance(v, str) else float(v) for v in values)


def _largest(old, new, scales):
    shares = _shares(old, new, scales)
    return float(shares.max()), int(shares.argmax())


def _decades(old, new, scales):
    return _largest(*(np.log10(values.clip(lower=FLOOR)) for values in (old, new)), 1.0)


def _middle_of_decades(old, new, scales):
    """By how much all values move together, whatever single ones do."""
    old, new = (np.log10(values.dropna().clip(lower=FLOOR)) for values in (old, new))
    return float(abs(new.median() - old.median())), None


def _same(old, new, scales):
    return (_largest if pd.api.types.is_numeric_dtype(old) else _part_of_rows)(old, new, scales)


def _part_of_rows(old, new, scales):
    numbers = pd.api.types.is_numeric_dtype(old)
    differs = _shares(old, new, scales) > SAME if numbers else old.to_numpy() != new.to_numpy()
    return float(differs.mean()), int(differs.argmax())


def _times_chance(old, new, scales):
    """Statistic of Kolmogorov and Smirnov for two samples.

    Values that are the same are not told apart, so that rounding does not count where many values are equal.
    """
    old, new = (np.sort(values.dropna().to_numpy(float)) for values in (old, new))
    slack, n, m = SAME * float(scales.max()), len(old), len(new)
    return float(max(_lead(old, new, slack), _lead(new, old, slack)) * np.sqrt(n * m / (n + m))), None


def _standard_score_of_sizes(old, new, scales):
    """Difference of the sizes of two samples, in units of its standard deviation if single values came by chance."""
    n, m = (int(values.notna().sum()) for values in (old, new))
    return float(abs(n - m) / np.sqrt(n + m)), None


def _standard_errors(old, new, scales):
    """Difference of two means in units of its own standard error."""
    old, new = (values.dropna().to_numpy(float) for values in (old, new))
    error = np.sqrt(sum(values.var(ddof=1) / len(values) if len(values) > 1 else 0.0 for values in (old, new)))
    return float(abs(old.mean() - new.mean()) / (error + SAME * float(scales.max()))), None


def _lead(ahead, behind, slack):
    """By how much the part of one sample below some value exceeds that of another below a bit more, at most."""
    below = np.searchsorted(behind, ahead + slack, side="right") / len(behind)
    return float((np.arange(1, len(ahead) + 1) / len(ahead) - below).max())


MEASURES = {
    "largest": _largest,
    "decades": _decades,
    "middle of decades": _middle_of_decades,
    "part of rows": _part_of_rows,
    "same": _same,
    "distribution": _times_chance,
    "size": _standard_score_of_sizes,
    "mean": _standard_errors,
}
UNITS = {
    "largest": "of its axis",
    "decades": "decades",
    "middle of decades": "decades in the middle",
    "part of rows": "of its rows",
    "same": "of its axis or rows",
    "distribution": "times chance",
    "size": "times chance in number",
    "mean": "standard errors",
}
"""What the distances of each measure count. The axis is the range of the reference's column in its panel; where that
range is zero, and in tables without panels, the reference itself. What is not finite is infinitely far."""


def numeric_columns(table: pd.DataFrame) -> list[str]:
    return list(table.select_dtypes("number").columns)


def _texts(table):
    numbers = set(numeric_columns(table))
    return [name for name in table if name not in numbers]


def _given(values):
    there = values.notna()
    return there if pd.api.types.is_numeric_dtype(values) else there & (values != "")


def _by_series(table):
    """Rows by (panel, series), in their order; all of a table that has none under an empty name."""
    if not {"panel", "series"} <= set(table):
        return {("",): table}
    return dict(iter(table.groupby(["panel", "series"], sort=False)))


def _shares(old, new, scales):
    old, new = (pd.to_numeric(values, errors="coerce").to_numpy(float) for values in (old, new))
    with np.errstate(invalid="ignore"):
        shares = np.abs(new - old) / np.asarray(scales)
    return np.where(np.isnan(old) | (old == new), 0.0, np.where(np.isfinite(shares), shares, np.inf))


def _scales(reference, name):
    """The axis of every row; of a column of text, nothing that is used."""
    if name not in numeric_columns(reference):
        return pd.Series(np.nan, reference.index)
    values = reference[name].replace([np.inf, -np.inf], np.nan)
    sizes = values.abs().where(values != 0, 1.0)
    if "panel" not in reference:
        return sizes
    panels = values.groupby(reference["panel"])
    ranges = panels.transform("max") - panels.transform("min")
    return ranges.where(ranges > 0, sizes)


def _names(table, texts):
    """The text of each row, for example "a1, SIM stable"."""
    return [", ".join(map(str, row)) for row in table[texts].itertuples(index=False, name=None)]
