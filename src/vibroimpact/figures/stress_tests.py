"""Compute the results of the stress tests, and draw them as a table of methods (columns) and groups of tests (rows)."""

import numpy as np
import pandas as pd
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from vibroimpact.accuracy.stress_tests import judge, stress_tests
from vibroimpact.figures.plotting.style import DOUBLE_COLUMN, new_figure, styled
from vibroimpact.integrators import METHODS

SPEC = {
    "title": "Results of every method in the stress tests",
    "caption": "Where methods fail: each cell gives the number of stress tests of the group that the method solves "
        "correctly, and their total. Mark and colour show the worst verdict; the more tests fail, the deeper the "
        "colour.",
    "alt": "Table of marks with methods across and groups of stress tests down. A check mark means that all results "
        "are right. Other marks show the worst verdict: a question mark reported undecidable, an exclamation mark "
        "refused, an infinity sign did not finish, a cross silently wrong.",
    "method": "error against a reference of extended precision",
    "file": "results/accuracy/stress_tests.csv",
    "columns": {
        "group": {"meaning": "difficulty that the tests of the group share", "unit": "text"},
        "test": {"meaning": "name of the test problem", "unit": "text"}, "method, family, setting": {},
        "steps": {"compared": "of the machine"},
        "verdict": {"meaning": "right: the error of the final state is at most 0.01, and no impact is missed or "
            "spurious; silently wrong: neither right nor reported undecidable", "unit": "text", "values": ["right",
            "reported undecidable", "refused with an error", "did not finish", "silently wrong", "unavailable"]},
        "error_state, error_time": {"compared": "measured error", "infinite": True},
        "missed, spurious": {"compared": "impacts"},
        "reason": {"meaning": "why the run has no result, or why the method reports it as undecidable", "unit": "text",
            "compared": "of the machine"},
    },
}  # fmt: skip

VERDICTS = {  # verdicts in order of increasing severity
    "unavailable": ("–", "#DDDDDD"),
    "right": ("✓", "#D9EFE3"),
    "reported undecidable": ("?", "#74AEDF"),
    "refused with an error": ("!", "#DDBB3D"),
    "did not finish": ("∞", "#A68FC4"),
    "silently wrong": ("×", "#DB5A45"),
}
"""Mark and colour of each verdict; the mark alone or the colour alone identifies the verdict. In a cell, the colour of
a failure is paler the smaller the share of tests that failed."""
PALEST = 0.3
"""Share of the full colour in a cell where almost no test fails."""
ROW, HEAD, FOOT = 7.4, 18.0, 9.0
"""Heights in mm of a row of cells, of the names of methods above, and of the legend below."""
LEFT, RIGHT = 27.0, 11.0
"""Widths in mm of the margins: left for the names of groups, right for the overhang of the last method's name."""


def compute(full: bool) -> pd.DataFrame:
    """Return one row per stress test and method, computed by `accuracy.stress_tests.judge`.

    full: True for all tests, False for the quick tests only.
    """
    chosen = [test for test in stress_tests() if full or test.quick]
    return pd.DataFrame([row for test in chosen for row in judge(test, METHODS)])


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the verdicts of `compute` as a table with a column per method and a row per group of tests."""
    groups, methods = table["group"].unique().tolist(), table["method"].unique().tolist()
    height = HEAD + FOOT + ROW * len(groups)
    figure = new_figure(DOUBLE_COLUMN, height, layout=None)
    width = 1 - (LEFT + RIGHT) / DOUBLE_COLUMN
    axes = figure.add_axes((LEFT / DOUBLE_COLUMN, FOOT / height, width, 1 - (HEAD + FOOT) / height))
    axes.set(xlim=(0, len(methods)), ylim=(len(groups), 0))
    axes.set_axis_off()
    for (group, method), rows in table.groupby(["group", "method"], sort=False):
        worst = max(rows["verdict"], key=list(VERDICTS).index)
        x, y, right = methods.index(method), groups.index(group), (rows["verdict"] == "right").sum()
        share = 1.0 if worst == "right" else PALEST + (1.0 - PALEST) * (1.0 - right / len(rows))
        colour = 1.0 - share * (1.0 - np.array(to_rgb(VERDICTS[worst][1])))
        axes.add_patch(Rectangle((x, y), 1, 1, facecolor=colour, edgecolor="white", linewidth=1.0))
        axes.text(x + 0.08, y + 0.5, VERDICTS[worst][0], fontsize=7.5, va="center", family="DejaVu Sans")
        axes.text(x + 0.93, y + 0.52, f"{right}/{len(rows)}", fontsize=8.5, va="center", ha="right")
    for x, method in enumerate(methods):
        axes.text(x + 0.4, -0.15, method, rotation=35, rotation_mode="anchor", ha="left", va="bottom", fontsize=8.5)
    for y, group in enumerate(groups):
        axes.text(-0.1, y + 0.52, group, ha="right", va="center", fontsize=8.5)
    shown = [verdict for verdict in VERDICTS if (table["verdict"] == verdict).any()]
    handles = [Patch(facecolor=VERDICTS[v][1], label=f"{VERDICTS[v][0]}  {v}") for v in shown]
    legend = figure.legend(handles=handles, loc="lower center", ncols=len(handles), fontsize=7.5, columnspacing=0.9)
    for text in legend.get_texts():
        text.set_family(["STIXGeneral", "DejaVu Sans"])
    return figure
