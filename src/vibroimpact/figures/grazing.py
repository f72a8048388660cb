"""Compute and draw the error of each method against the depth of a grazing impact, to show where methods fail."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from vibroimpact.accuracy.stress_tests import CHAPTER, grazing, judge
from vibroimpact.figures.plotting.methods import HOLLOW, LOOKS, draw_method
from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.figures.plotting.style import BLACK, SINGLE_COLUMN, new_figure, styled
from vibroimpact.integrators import METHODS
from vibroimpact.system import System

SPEC = {
    "title": "Error of each method against the depth of a grazing impact",
    "caption": "Error of each method against the depth of a grazing impact, in units of half the gap: without the "
        "wall, the ball would move beyond it by this depth. The error of a missed impact is "
        "proportional to the square root of the depth, until other errors of the method exceed it.",
    "alt": "Error of the final state against the depth of an impact from 0.01 to 1e-14, on logarithmic axes, with a "
        "named line per method. One after the other, some methods leave the lower part for a common line with hollow "
        "marks, the line of a missed impact.",
    "method": "error against a reference of extended precision",
    "file": "results/accuracy/grazing.csv",
    "columns": {
        "method": {},
        "digits": {"meaning": "minus the decimal logarithm of the depth", "unit": "number",
            "compared": "algebra"},
        "verdict": {"meaning": "as in `stress_tests.csv`", "unit": "text"},
        "error_state": {"compared": "measured error", "infinite": True},
        "missed, spurious": {"compared": "impacts"},
    },
}  # fmt: skip

DIGITS = range(2, 15)
"""Decimal exponents of the depths of the grazing impacts, without their minus sign."""


def compute() -> pd.DataFrame:
    """Return one row for each method in LOOKS and each depth of the grazing impact, with the columns in SPEC.

    The errors in a row are computed by `stress_tests.judge`.
    """
    system, methods = System(**CHAPTER), [method for method in METHODS if method.name in LOOKS]
    rows = [{"digits": digits} | row for digits in DIGITS for row in judge(grazing(system, -1, digits), methods)]
    table = pd.DataFrame(rows)[[name for names in SPEC["columns"] for name in names.split(", ")]]
    return table.sort_values("method", kind="stable", key=lambda names: names.map(list(LOOKS).index), ignore_index=True)


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`, with hollow markers for runs with missed or spurious impacts."""
    figure = new_figure(SINGLE_COLUMN, 90.0)
    axes = figure.add_subplot()
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="depth of the impact (shallower to the right)",
        ylabel="error of the final state",
    )
    shown = table[np.isfinite(table["error_state"])].assign(depth=10.0 ** -table["digits"])
    lines = [
        (method, draw_method(axes, method, rows["depth"], rows["error_state"], rows["missed"] + rows["spurious"] > 0))
        for method, rows in shown.groupby("method", sort=False)
    ]
    axes.set_xticks(10.0 ** -np.arange(2, 15, 3))
    axes.minorticks_off()
    axes.margins(0.06)
    axes.invert_xaxis()
    hollow = Line2D([], [], linestyle="none", color=BLACK, marker="o", markerfacecolor="white", label=HOLLOW)
    figure.legend(handles=[hollow], loc="outside lower center", fontsize=9)
    axes.text(3e-9, 6e-3, "impact missed", rotation=-24, ha="center", va="center")
    name_curves(figure, {axes: lines}, fontsize=8)
    return figure
