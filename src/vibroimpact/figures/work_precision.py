"""Compute and draw work-precision data: error against time per cycle, one panel per problem, one curve per method."""

from string import ascii_lowercase

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from vibroimpact.accuracy.work_precision import Problem, measure
from vibroimpact.figures.plotting.methods import HOLLOW, LOOKS, draw_method, mark
from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.figures.plotting.style import BLACK, DOUBLE_COLUMN, GREY, LIGHT_GREY, heading, new_figure, styled
from vibroimpact.integrators import TIMED
from vibroimpact.system import System

SPEC = {
    "title": "Error against run time of every method",
    "caption": "Error of the final state and time per forcing cycle of eight methods, each with one or more settings, "
        "on three test problems. The errors are measured against an independent reference of extended precision. "
        "Methods nearer to the lower left are better. Dotted: errors of :math:`10^{-6}` and :math:`10^{-12}`. Hollow "
        "marks: missed or spurious impacts. Grey lane: runs without a result; the table gives the reasons.",
    "alt": "A panel per test problem with the error of the final state against the time per forcing cycle, both on "
        "logarithmic axes, and a named line per method. Only the line of this engine is in the lower left corner.",
    "method": "error against a reference of extended precision, run time as measured",
    "file": "results/accuracy/work_precision.csv",
    "columns": {
        "problem": {"meaning": "test problem in `accuracy.problems` of the config", "unit": "text"},
        "method, family, setting": {},
        "error_state, error_time": {"compared": "measured error", "infinite": True},
        "missed, spurious": {"compared": "impacts"},
        "seconds_per_cycle": {"meaning": "run time per forcing cycle, the shortest of several runs", "unit": "seconds",
            "compared": "of the machine"},
        "steps": {"compared": "of the machine"},
        "evaluations": {"meaning": "evaluations of the right-hand side, 0 if the method does not count them",
            "unit": "number", "compared": "of the machine"},
        "outcome": {"meaning": "finished; refused: stopped with an error; unfinished: step limit reached; unavailable",
            "unit": "text",
            "values": ["finished", "refused", "unfinished", "unavailable"]},
        "reason": {"meaning": "why the run has no result, or why the method reports it as undecidable", "unit": "text",
            "compared": "of the machine"},
        "order": {"meaning": "order of convergence: slope of log error over log step, for methods that have one",
            "unit": "dimensionless", "compared": "order"},
    },
}  # fmt: skip

SMALLEST, LARGEST = 1e-16, 30.0
NO_RESULT, END = 1e3, 3e4
"""Errors are clipped to SMALLEST .. LARGEST. Failed runs are drawn beyond them, at NO_RESULT; the axis ends at END."""
GOALS = 1e-12, 1e-6
GUIDE = {"color": GREY, "linestyle": ":", "linewidth": 0.9, "zorder": 0}


def compute(problems: dict, seconds: float, short: bool) -> pd.DataFrame:
    """Return one row per problem, method and setting, computed by `accuracy.work_precision.measure`.

    Parameters
    ----------
    problems : dict
        One dict per problem, keyed by the name of the problem. The dict of a problem has the keys `system` (parameters
        by name), `initial_state` and `cycles`.
    seconds : float
        Time [s] for which the run with each setting is repeated.
    short : bool
        True to skip every second setting of a method.
    """
    starts = (
        Problem(name, System(**problem["system"]), tuple(problem["initial_state"]), problem["cycles"])
        for name, problem in problems.items()
    )
    return pd.DataFrame([row for start in starts for row in measure(start, TIMED, seconds, short)])


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`, with hollow markers for runs with missed or spurious impacts."""
    figure = new_figure(DOUBLE_COLUMN, 100.0)
    problems = list(dict.fromkeys(table["problem"]))
    panels = figure.subplots(1, len(problems), sharex=True, sharey=True, squeeze=False)[0]
    drawn = table[table["method"].isin(list(LOOKS))]
    curves = {}
    for axes, problem, letter in zip(panels, problems, ascii_lowercase, strict=False):
        axes.set(xscale="log", yscale="log", xlim=(SMALLEST / 3, END), xlabel="error of the final state")
        axes.axvspan(LARGEST * 2, END, color=LIGHT_GREY, linewidth=0, zorder=0)
        axes.axvline(LARGEST * 2, color=LIGHT_GREY)  # names of curves avoid this line, the edge of the shading
        axes.vlines(GOALS, 0, 1, transform=axes.get_xaxis_transform(), **GUIDE)
        measured = drawn[(drawn["problem"] == problem) & drawn["seconds_per_cycle"].notna()]
        by_method = measured.groupby("method", sort=False)
        # `name_curves` writes names in this order. Methods without a result come first. All their markers lie in the
        # narrow grey strip, where there is little space for names.
        by_room = sorted(by_method, key=lambda one: one[1]["outcome"].eq("finished").any())
        curves[axes] = [(method, lines) for method, rows in by_room for lines in _method(axes, method, rows)]
        axes.set_xticks(10.0 ** np.arange(-15, 1, 3))
        axes.minorticks_off()
        axes.margins(y=0.08)
        heading(axes, letter, problem)
    panels[0].set_ylabel("time per cycle [s]")
    panels[0].set_title(r"better $\swarrow$", loc="right", pad=4)
    absent = ", ".join(dict.fromkeys(drawn["method"][drawn["outcome"] == "unavailable"]))
    handles = [
        Line2D([], [], linestyle="none", color=BLACK, marker="o", markerfacecolor="white", label=HOLLOW),
        Line2D([], [], **GUIDE, label="errors of $10^{-12}$ and $10^{-6}$"),
        Patch(facecolor=LIGHT_GREY, label="no result" + f" (not installed: {absent})" * bool(absent)),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), fontsize=9)
    name_curves(figure, curves, fontsize=8)
    return figure


def _method(axes, method, rows):
    failed = rows["outcome"] != "finished"
    good = rows[~failed]
    x, wrong = good["error_state"].clip(SMALLEST, LARGEST), good["missed"] + good["spurious"] > 0
    lane = axes.plot(np.full(failed.sum(), NO_RESULT), rows["seconds_per_cycle"][failed], **mark(method))
    curve = draw_method(axes, method, x, good["seconds_per_cycle"], wrong)
    return lane, curve  # `name_curves` writes the name twice: at the markers of failed runs and at the curve
