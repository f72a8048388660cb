"""Provide the fixed points that a notebook shows: compute them, or read them from files of a build.

The files must belong to the parameters of the notebook.
"""

import numpy as np
import pandas as pd

from vibroimpact import tables
from vibroimpact.accuracy.verdict_table import NO_ORBIT, fixed_point_rows, orbit_rows
from vibroimpact.exact.orbits.search import search
from vibroimpact.figures.plotting.markdown import EXACTLY, plain
from vibroimpact.theory.fixed_points.table import fixed_point_table, labelled_points

AGREES = 1e-8
"""Two tables contain the same fixed points if all coordinates differ by less than this. The limit is small because the
same code computes both."""
COORDINATES = ["C1", "C2", "B1", "B2", "psi1", "psi2"]
HINT = "set inputs = {} to compute from the parameters of the notebook"


def fixed_points(case: str, system, inputs: dict) -> pd.DataFrame:
    """Return the fixed points of a case.

    Read the points from the file inputs["points"]. If `inputs` is empty, compute the points. Raise ValueError if the
    file contains another case, or points that are not the fixed points of the system.
    """
    computed = fixed_point_table(case, system)
    if not inputs:
        return computed
    given = tables.read(inputs["points"])
    _expect_same_points(given, computed, inputs["points"])
    return given[computed.columns.intersection(given.columns)]


def verdicts(case: str, system, points: pd.DataFrame, inputs: dict) -> pd.DataFrame:
    """Return the verdicts of all criteria on each fixed point.

    Read the verdicts from the files inputs["points"] and inputs["orbits"]. If `inputs` is empty, compute the verdicts.

    The table has the columns of `fixed_point_rows` and the column "largest multiplier". This column contains the
    largest modulus of the Floquet multipliers of the exact orbit next to the fixed point.

    Raise ValueError if the file inputs["points"] contains another case or other points.
    """
    if inputs:
        orbits, given = tables.read(inputs["orbits"]), tables.read(inputs["points"])
        _expect_same_points(given, points, inputs["points"])
    else:
        orbits = orbit_rows(case, search(system).orbits)
        given = fixed_point_rows(case, system, labelled_points(points), orbits)
    largest = orbits.set_index("label")["modulus_1"].astype(float)
    return given.assign(**{"largest multiplier": given["orbit"].map(largest)})


WHY = {
    "label": "fixed point",
    "printed_10_26": "printed_10_26: impacts, by (10.26)",
    "fast": "fast: impacts, as derived",
    "slow": "slow: slow flow",
    "orbit": "exact orbit",
    "largest multiplier": "its largest multiplier",
    "exact": "exact: its multipliers",
}
"""Columns of the table that explains the verdicts, with their headings."""


def why(verdicts: pd.DataFrame) -> pd.DataFrame:
    """Return the table that explains the verdicts: one row per fixed point, with the columns in WHY."""
    shown = verdicts[[*WHY]].round({"largest multiplier": 4}).rename(columns=WHY).set_index("fixed point")
    return shown.astype(object).where(shown.notna() & (shown != ""), "–")


def exact(verdicts: pd.DataFrame) -> str:
    """Return a sentence in Markdown with the verdict of the Floquet multipliers on each fixed point.

    The function uses the columns label, orbit and exact of `verdicts`.
    """
    if verdicts.empty:
        return f"{EXACTLY} the theory has no fixed point here that it could confirm or refute."
    said = []
    for verdict, rows in verdicts.groupby("exact", sort=False):
        names = [f"**{plain(label)}**" for label in rows["label"]]
        if verdict == NO_ORBIT:
            said.append(f"{', '.join(names)}: **no orbit**")
        else:
            with_orbits = (f"{name} (orbit {plain(orbit)})" for name, orbit in zip(names, rows["orbit"], strict=True))
            said.append(f"{', '.join(with_orbits)}: **{verdict}** by Floquet multipliers")
    return f"{EXACTLY} {'; '.join(said)}."


def _expect_same_points(given, expected, path):
    if list(given["case"]) + list(given["label"]) != list(expected["case"]) + list(expected["label"]):
        raise ValueError(f"inputs: {path} contains {_named(given)}, but the parameters give {_named(expected)}; {HINT}")
    apart = np.abs(given[COORDINATES].to_numpy(float) - expected[COORDINATES].to_numpy(float)).max(initial=0.0)
    if not apart < AGREES:
        raise ValueError(
            f"inputs: {path} contains fixed points of other parameters: a coordinate differs by {apart:.2g}; {HINT}"
        )


def _named(points):
    of = f" of case {', '.join(dict.fromkeys(points['case']))}" if len(points) else ""
    return f"the fixed points {', '.join(points['label']) or '(none)'}{of}"
