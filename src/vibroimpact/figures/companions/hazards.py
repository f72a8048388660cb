"""The table of hazards as a picture: methods across, hazards down, a mark and the number behind it in each cell."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from vibroimpact.figures.kit.style import DOUBLE_COLUMN, GREY, new_figure, styled

VERDICTS = {
    "right": ("✓", "#D9EFE3"),
    "reported undecidable": ("?", "#CFE3F5"),
    "refused with an error": ("!", "#F6ECC4"),
    "did not finish": ("∞", "#E6E0EE"),
    "silently wrong": ("×", "#E8A090"),
    "unavailable": ("–", "#EEEEEE"),
}
"""Mark and colour of each verdict: the mark says the same as the colour."""
ROW, HEAD, FOOT = 5.2, 20.0, 16.0
"""Heights in mm."""


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the rows of accuracy.hazards.judge: columns group, hazard, method, verdict,
    error_state, missed, spurious."""
    hazards = list(dict.fromkeys(zip(table["group"], table["hazard"], strict=True)))
    methods = list(dict.fromkeys(table["method"]))
    height = HEAD + FOOT + ROW * len(hazards)
    figure = new_figure(DOUBLE_COLUMN, height, layout=None)
    axes = figure.add_axes((0.275, FOOT / height, 0.675, 1 - (HEAD + FOOT) / height))
    axes.set(xlim=(0, len(methods)), ylim=(len(hazards), 0))
    axes.set_axis_off()
    for row in table.itertuples():
        mark, colour = VERDICTS[row.verdict]
        x, y = methods.index(row.method), hazards.index((row.group, row.hazard))
        axes.add_patch(Rectangle((x, y), 1, 1, facecolor=colour, edgecolor="white", linewidth=1.0))
        axes.text(x + 0.04, y + 0.5, mark, fontsize=7, va="center", family="DejaVu Sans")
        number = _number(row)
        size = 5.2 * min(1.0, 11 / max(len(number), 1))  # so that the longest stays clear of the mark
        axes.text(x + 0.95, y + 0.5, number, fontsize=size, va="center", ha="right", color="0.25")
    for x, method in enumerate(methods):
        axes.text(x + 0.4, -0.3, method, rotation=35, rotation_mode="anchor", ha="left", va="bottom", fontsize=8)
    for y, (group, hazard) in enumerate(hazards):
        axes.text(-0.1, y + 0.5, hazard, ha="right", va="center", fontsize=7.5)
        if y == 0 or hazards[y - 1][0] != group:
            axes.text(-3.6, y + 0.5, group, ha="left", va="center", fontsize=7.5, weight="bold")
            axes.plot([-3.6, len(methods)], [y, y], color=GREY, linewidth=0.4, clip_on=False)
    shown = [verdict for verdict in VERDICTS if (table["verdict"] == verdict).any()]
    handles = [Patch(facecolor=VERDICTS[v][1], label=f"{VERDICTS[v][0]}  {v}") for v in shown]
    legend = figure.legend(handles=handles, loc="lower center", ncols=len(handles), fontsize=7, columnspacing=0.9)
    for text in legend.get_texts():
        text.set_family(["STIXGeneral", "DejaVu Sans"])
    caption = "numbers: error of the final state; −n impacts missed, +n spurious"
    figure.text(0.5, 7.5 / height, caption, ha="center", fontsize=7, color="0.25")
    return figure


def _number(row):
    """The measured number behind a verdict, as short as it can be."""
    if not np.isfinite(row.error_state):
        return ""
    lost = f" −{row.missed:.0f}" if row.missed else ""
    extra = f" +{row.spurious:.0f}" if row.spurious else ""
    mantissa, exponent = f"{row.error_state:.0e}".split("e")
    return f"{mantissa}e{int(exponent)}{lost}{extra}"
