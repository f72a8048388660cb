"""Write fixed points to tables with one row per point and the columns COLUMNS, and read fixed points from tables."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.system.extras import need
from vibroimpact.system.verdict import all_stable
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points
from vibroimpact.theory.manifold import C_min, overshoot, rho
from vibroimpact.theory.masri import printed_limit

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the dependency check)

COLUMNS = ["case", "label", "C1", "C2", "B1", "B2", "psi1", "psi2", "multiple"]


@dataclass(frozen=True, eq=False)
class LabelledPoint:
    """A labelled fixed point of the slow flow; the data are read from a table.

    - label: label of the fixed point, such as "a".
    - C: amplitudes of the saw-tooth, shape (2,).
    - B: amplitudes of U, shape (2,).
    - psi: phases [rad], shape (2,).
    - multiple: True if several fixed points may coincide within rounding.
    """

    label: str
    C: np.ndarray
    B: np.ndarray
    psi: np.ndarray
    multiple: bool


def fixed_point_table(case: str, system) -> pd.DataFrame:
    """Return a table with the columns COLUMNS and one row for each fixed point of a system, sorted by label."""
    rows = [[case, p.label, *p.C, *p.B, *p.psi, p.multiple] for p in fixed_points(system)]
    return pd.DataFrame(rows, columns=COLUMNS).sort_values("label", ignore_index=True)


def labelled_points(table: pd.DataFrame) -> list[LabelledPoint]:
    """Return the fixed points in a table, in the order of its rows."""
    return [
        LabelledPoint(
            row["label"],
            *(row[[f"{name}1", f"{name}2"]].to_numpy(float) for name in ("C", "B", "psi")),
            bool(row.get("multiple", False)),
        )
        for _, row in table.iterrows()
    ]


def labelled_point(table: pd.DataFrame, label: str) -> LabelledPoint:
    """Return the fixed point with a given label from a table.

    Raises
    ------
    ValueError
        If the table has no such point.
    """
    points = {point.label: point for point in labelled_points(table)}
    if label not in points:
        case = f" {table['case'].iloc[0]!r}" if "case" in table and len(table) else ""
        known = ", ".join(points) or "none"
        raise ValueError(f"fixed_point: the case{case} has no fixed point {label!r}; its labels are: {known}")
    return points[label]


def place_on_manifold(system, table: pd.DataFrame) -> pd.DataFrame:
    """Return the position of each fixed point on the manifold, one row per point and active module.

    The columns have the following contents:

    - C, B: amplitudes of the saw-tooth and of U,
    - arm: "left" if C is at most C_min, (10.25), else "right",
    - branch: "stable" if C is above the limit of (10.26), else "unstable",
    - overshoot: largest |W_0| - 1 in a cycle, or 0 if the ball stays between the walls.
    """
    r = rho(system.kappa)
    rows = [
        {
            "label": point.label,
            "module": module,
            "C": C,
            "B": B,
            "arm": "right" if C_min(r) < C else "left",
            "branch": "stable" if printed_limit(r) < C else "unstable",
            "overshoot": float(overshoot(C, r)),
        }
        for point in labelled_points(table)
        for module, C, B in zip((1, 2), point.C, point.B, strict=True)
        if module in system.modules
    ]
    return pd.DataFrame(rows, columns=["label", "module", "C", "B", "arm", "branch", "overshoot"])


def verdicts(places: pd.DataFrame) -> pd.Series:
    """Return the verdict on each fixed point, indexed by the labels of the points.

    `places` is a table from `place_on_manifold`. The verdict is "stable" if the branch is "stable" in every row of the
    point, and else "unstable".
    """
    return places.groupby("label")["branch"].agg(all_stable).rename("verdict")
