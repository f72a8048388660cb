"""The table of hazards as a picture: methods across, hazards down, a mark and the number behind it in each cell."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from vibroimpact.figures.kit.style import DOUBLE_COLUMN, GREY, new_figure, styled

SPEC = {
    "title": "Every method in every hazard",
    "caption": "Where methods fail: the verdict on every method in every hazard, with the measured numbers behind it: "
        "the error of the final state, and below it impacts missed (−) and spurious (+).",
    "alt": "Table of marks: methods across, hazards down. A check mark means right, a question mark reported "
        "undecidable, an exclamation mark refused, an infinity sign did not finish, a cross silently wrong.",
    "method": "error against a reference of extended precision",
    "made_by": "hazards",
    "file": "results/accuracy/hazards.csv",
    "columns": {
        "group": {"meaning": "what is hard", "unit": "text"},
        "hazard": {"meaning": "name of the test problem", "unit": "text"}, "method, family, setting, steps": {},
        "verdict": {"meaning": "right: the error of the final state is at most 0.01, and no impact is missed or "
            "spurious; silently wrong: neither right nor reported undecidable", "unit": "text", "values": ["right",
            "reported undecidable", "refused with an error", "did not finish", "silently wrong", "unavailable"]},
        "error_state, error_time, missed, spurious": {},
        "says": {"meaning": "what the method says of its failure or of its doubt", "unit": "text"},
    },
}  # fmt: skip

VERDICTS = {
    "right": ("✓", "#D9EFE3"),
    "reported undecidable": ("?", "#CFE3F5"),
    "refused with an error": ("!", "#F6ECC4"),
    "did not finish": ("∞", "#E6E0EE"),
    "silently wrong": ("×", "#E8A090"),
    "unavailable": ("–", "#EEEEEE"),
}
"""Mark and colour of each verdict: the mark says the same as the colour."""
ROW, HEAD, FOOT = 6.4, 20.0, 16.0
"""Heights in mm."""
LEFT, RIGHT = 42.0, 9.0
"""Widths in mm beside the marks: names of the hazards, and what the last name of a method hangs over."""


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the rows of accuracy.hazards.judge: columns group, hazard, method, verdict,
    error_state, missed, spurious."""
    hazards = list(dict.fromkeys(zip(table["group"], table["hazard"], strict=True)))
    methods = list(dict.fromkeys(table["method"]))
    height = HEAD + FOOT + ROW * len(hazards)
    figure = new_figure(DOUBLE_COLUMN, height, layout=None)
    width = 1 - (LEFT + RIGHT) / DOUBLE_COLUMN
    axes = figure.add_axes((LEFT / DOUBLE_COLUMN, FOOT / height, width, 1 - (HEAD + FOOT) / height))
    edge = -LEFT * len(methods) / (width * DOUBLE_COLUMN)  # of the figure, in columns
    axes.set(xlim=(0, len(methods)), ylim=(len(hazards), 0))
    axes.set_axis_off()
    for row in table.itertuples():
        mark, colour = VERDICTS[row.verdict]
        x, y = methods.index(row.method), hazards.index((row.group, row.hazard))
        axes.add_patch(Rectangle((x, y), 1, 1, facecolor=colour, edgecolor="white", linewidth=1.0))
        number = _number(row)
        first = y + (0.3 if "\n" in number else 0.5)
        axes.text(x + 0.05, first, mark, fontsize=6.5, va="center", family="DejaVu Sans")
        axes.text(
            x + 0.94, y + 0.5, number, fontsize=6.5, va="center", ha="right", ma="right", linespacing=1.1, color="0.25"
        )
    for x, method in enumerate(methods):
        axes.text(x + 0.5, -0.2, method, rotation=35, rotation_mode="anchor", ha="left", va="bottom", fontsize=8)
    for y, (group, hazard) in enumerate(hazards):
        axes.text(-0.1, y + 0.5, hazard, ha="right", va="center", fontsize=7.5)
        if y == 0 or hazards[y - 1][0] != group:
            axes.text(edge + 0.1, y + 0.5, group, ha="left", va="center", fontsize=7.5, weight="bold")
            axes.plot([edge + 0.1, len(methods)], [y, y], color=GREY, linewidth=0.4, clip_on=False)
    shown = [verdict for verdict in VERDICTS if (table["verdict"] == verdict).any()]
    handles = [Patch(facecolor=VERDICTS[v][1], label=f"{VERDICTS[v][0]}  {v}") for v in shown]
    legend = figure.legend(handles=handles, loc="lower center", ncols=len(handles), fontsize=7, columnspacing=0.9)
    for text in legend.get_texts():
        text.set_family(["STIXGeneral", "DejaVu Sans"])
    caption = "numbers: error of the final state, the smaller the better; below −n impacts missed, +n spurious"
    figure.text(0.5, 7.5 / height, caption, ha="center", fontsize=7, color="0.25")
    return figure


def _number(row):
    """The measured numbers behind a verdict, as short as they can be, in one line or two."""
    if not np.isfinite(row.error_state):
        return ""
    impacts = [f"{sign}{count:.0f}" for sign, count in (("−", row.missed), ("+", row.spurious)) if count]
    mantissa, exponent = f"{row.error_state:.0e}".split("e")
    return "\n".join([f"{mantissa}e{int(exponent)}", *filter(None, ["".join(impacts)])])
