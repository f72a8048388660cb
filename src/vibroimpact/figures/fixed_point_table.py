"""Fixed points as the pipeline's table holds them: columns label, C1, C2, B1, B2, psi1, psi2, one row per point."""

from dataclasses import dataclass

import numpy as np
import pandas as pd


@dataclass(frozen=True, eq=False)
class LabelledPoint:
    """A fixed point of the slow flow under its label: C, B and psi [rad], each shape (2,)."""

    label: str
    C: np.ndarray
    B: np.ndarray
    psi: np.ndarray


def labelled_points(table: pd.DataFrame) -> list[LabelledPoint]:
    """The points of a table, in its order."""
    return [
        LabelledPoint(row["label"], *(row[[f"{name}1", f"{name}2"]].to_numpy(float) for name in ("C", "B", "psi")))
        for _, row in table.iterrows()
    ]


def labelled_point(table: pd.DataFrame, label: str) -> LabelledPoint:
    """The point of a table that bears a label.

    Raises:
        ValueError: the table has no such point.
    """
    points = {point.label: point for point in labelled_points(table)}
    if label not in points:
        raise ValueError(f"fixed_point: {label!r} is not among the fixed points of this case ({', '.join(points) or 'none'})")
    return points[label]
