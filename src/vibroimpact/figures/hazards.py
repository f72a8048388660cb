"""The stress tests as a picture: methods across, groups of tests down, how many a method gets right in each cell."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from vibroimpact.figures.plotting.style import DOUBLE_COLUMN, new_figure, styled

SPEC = {
    "title": "Every method in every stress test",
    "caption": "Where methods fail. In each cell: how many of the group's stress tests the method gets right, of how "
        "many; the mark and the colour are those of its worst verdict.",
    "alt": "Table of marks: methods across, groups of stress tests down. A check mark means all right; else the worst "
        "verdict: a question mark reported undecidable, an exclamation mark refused, an infinity sign did not finish, "
        "a cross silently wrong.",
    "method": "error against a reference of extended precision",
    "file": "results/accuracy/hazards.csv",
    "columns": {
        "group": {"meaning": "what is hard", "unit": "text"},
        "test": {"meaning": "name of the test problem", "unit": "text"}, "method, family, setting, steps": {},
        "verdict": {"meaning": "right: the error of the final state is at most 0.01, and no impact is missed or "
            "spurious; silently wrong: neither right nor reported undecidable", "unit": "text", "values": ["right",
            "reported undecidable", "refused with an error", "did not finish", "silently wrong", "unavailable"]},
        "error_state, error_time, missed, spurious": {},
        "reason": {"meaning": "what the method says of its failure or of its doubt", "unit": "text"},
        "hazard": {"meaning": "former name of `test`, until the next release", "unit": "text"},
        "says": {"meaning": "former name of `reason`, until the next release", "unit": "text"},
    },
}  # fmt: skip

VERDICTS = {  # the worse, the further down
    "unavailable": ("–", "#EEEEEE"),
    "right": ("✓", "#D9EFE3"),
    "reported undecidable": ("?", "#CFE3F5"),
    "refused with an error": ("!", "#F6ECC4"),
    "did not finish": ("∞", "#E6E0EE"),
    "silently wrong": ("×", "#E8A090"),
}
"""Mark and colour of each verdict: the mark says the same as the colour."""
ROW, HEAD, FOOT = 7.4, 18.0, 9.0
"""Heights in mm."""
LEFT, RIGHT = 27.0, 11.0
"""Widths in mm beside the marks: names of the groups, and what the last name of a method hangs over."""


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the rows of accuracy.stress_tests: columns group, method, verdict."""
    groups, methods = table["group"].unique().tolist(), table["method"].unique().tolist()
    height = HEAD + FOOT + ROW * len(groups)
    figure = new_figure(DOUBLE_COLUMN, height, layout=None)
    width = 1 - (LEFT + RIGHT) / DOUBLE_COLUMN
    axes = figure.add_axes((LEFT / DOUBLE_COLUMN, FOOT / height, width, 1 - (HEAD + FOOT) / height))
    axes.set(xlim=(0, len(methods)), ylim=(len(groups), 0))
    axes.set_axis_off()
    for (group, method), rows in table.groupby(["group", "method"], sort=False):
        worst = max(rows["verdict"], key=list(VERDICTS).index)
        mark, colour = VERDICTS[worst]
        x, y = methods.index(method), groups.index(group)
        axes.add_patch(Rectangle((x, y), 1, 1, facecolor=colour, edgecolor="white", linewidth=1.0))
        axes.text(x + 0.08, y + 0.5, mark, fontsize=7.5, va="center", family="DejaVu Sans")
        right = f"{(rows['verdict'] == 'right').sum()}/{len(rows)}"
        axes.text(x + 0.93, y + 0.52, right, fontsize=8.5, va="center", ha="right")
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


def cell(row) -> str:
    """The mark of a verdict, and behind it the error of the final state, impacts missed (-) and spurious (+)."""
    mark = VERDICTS[row.verdict][0]
    if not np.isfinite(row.error_state):
        return mark
    impacts = "".join(f"{sign}{count:.0f}" for sign, count in (("−", row.missed), ("+", row.spurious)) if count)
    mantissa, exponent = f"{row.error_state:.0e}".split("e")
    number = f"{mantissa}e{int(exponent)}".replace("-", "−")
    return "\N{NO-BREAK SPACE}".join(filter(None, [mark, number, impacts]))
