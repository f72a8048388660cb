"""Companion on stability: verdicts by four criteria on every fixed point of each case."""

import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.plotting.style import BLACK, GREY, SINGLE_COLUMN, new_figure, styled
from vibroimpact.system.verdict import STABLE, UNSTABLE

SPEC = {
    "title": "Four criteria side by side",
    "caption": "Verdicts of four criteria on the fixed points of all cases: (10.26) as printed, Masri's analysis as "
        "derived, the slow flow, and the multipliers of the exact orbit next to the point. Filled: stable; hollow: "
        "unstable.",
    "alt": "A matrix of dots with a row per fixed point and a column per criterion, filled if the verdict is stable. "
        "The last column, for the exact orbits, is hollow throughout.",
    "method": "computed verdicts",
    "columns": {
        "panel": {"meaning": "case"}, "label": {"meaning": "label of the fixed point", "unit": "text"},
        "C1, C2": {"compared": "roots"}, "printed_10_26, fast, slow, exact": {},
    },
}  # fmt: skip

CRITERIA = {
    "printed_10_26": "(10.26)",
    "fast": "impacts,\nas derived",
    "slow": "slow flow",
    "exact": "exact\norbit",
}
"""Columns of the table of fixed points, and their names in the figure."""
FACES = {STABLE: BLACK, UNSTABLE: "white"}
ROW, HEAD = 6.0, 22.0
"""Height of a row and of the head of the figure, in mm."""


def compute(points: pd.DataFrame) -> pd.DataFrame:
    """Return the verdicts on all fixed points.

    Columns: panel (the case), label, C1, C2, one per criterion.

    points: table with columns case, label, C1, C2 and one per criterion, as in `fixed_points.csv`.
    """
    return points.rename(columns={"case": "panel"})[["panel", "label", "C1", "C2", *CRITERIA]]


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: a row of dots per fixed point, filled where the verdict is stable."""
    figure = new_figure(SINGLE_COLUMN, HEAD + ROW * max(len(table), 1))
    axes = figure.add_subplot()
    for x, criterion in enumerate(CRITERIA):
        for y, verdict in enumerate(table[criterion]):
            axes.plot(x, y, "o", color=BLACK, markersize=7, markerfacecolor=FACES.get(verdict, GREY))
    axes.set_yticks(
        range(len(table)), [f"{case} ({label})" for case, label in zip(table["panel"], table["label"], strict=True)]
    )
    axes.set_xticks(range(len(CRITERIA)), CRITERIA.values())
    axes.tick_params(length=0, labeltop=True, labelbottom=False, labelsize=9)
    axes.set(xlim=(-0.5, len(CRITERIA) - 0.5), ylim=(max(len(table), 1) - 0.5, -0.5))
    figure.suptitle("filled: stable, hollow: unstable", fontsize=9)
    return figure
