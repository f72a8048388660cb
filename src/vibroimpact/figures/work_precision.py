"""The work-precision chart: error against time per forcing cycle, one column per problem, one curve per method."""

from string import ascii_lowercase

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from vibroimpact.figures.plotting.style import BLACK, DOUBLE_COLUMN, GREY, HALO, LIGHT_GREY, heading, new_figure, styled

SPEC = {
    "title": "Error against time, method by method",
    "caption": "Accuracy against speed: error against an independent reference of extended precision, and time per "
        "forcing cycle, for every method and setting on three test problems: the nearer to the lower left, the better. "
        "Methods of a kind share colour and mark; their names stand where they are most exact; the key has the kinds "
        "of several methods or without names. Hollow marks: impacts missed or spurious. In the lane at the right: runs "
        "that failed, with their reason.",
    "alt": "A panel per test problem with the error of the final state against the time per forcing cycle, both on "
        "logarithmic axes, a line per method with the colour and mark of its kind. Runs that failed stand in a lane "
        "at the right, numbered. This engine stands alone in the lower left corner.",
    "method": "error against a reference of extended precision, run time as measured",
    "file": "results/accuracy/work_precision.csv",
    "columns": {
        "problem": {"meaning": "the test problem, one of `accuracy.problems` in the config", "unit": "text"},
        "method, family, setting, error_state, error_time, missed, spurious": {},
        "seconds_per_cycle": {"meaning": "run time per forcing cycle, the shortest of several runs", "unit": "seconds"},
        "steps": {},
        "evaluations": {"meaning": "evaluations of the right-hand side, 0 where the method does not count them",
            "unit": "number"},
        "outcome": {"meaning": "finished; refused: an error; unfinished: out of steps; unavailable", "unit": "text",
            "values": ["finished", "refused", "unfinished", "unavailable"]},
        "reason": {"meaning": "why there is no result, or what the method itself calls undecidable", "unit": "text"},
        "order": {"meaning": "order of convergence: slope of log error over log step, for methods that have one",
            "unit": "dimensionless"},
    },
}  # fmt: skip

KINDS = {
    "exact flow": (BLACK, "*", 6.0),
    "Taylor": ("#0072B2", "s", 3.6),
    "Runge-Kutta": ("#D55E00", "D", 3.2),
    "solve_ivp": ("#E69F00", "o", 3.4),
    "compliant contact": ("#882255", "v", 3.6),
    "time-stepping": ("#009E73", "^", 3.6),
    "transformed coordinates": ("#CC79A7", "P", 4.0),
    "multiple scales": ("0.5", "X", 4.0),
}
"""Colour, mark and its size of each kind of method, its `family`; the colours of Okabe and Ito, of safe contrast."""
CROWDED = "compliant contact", "multiple scales"
"""Kinds whose methods are not named."""
CLOSE = "RK45", "LSODA"
"""Methods not named, either: between others of their kind, whose names they would cover."""
SMALLEST, LARGEST = 1e-16, 30.0
LANE, LANE_STEP, END = 1.4e3, 8.0, 5e4
"""Errors are drawn between SMALLEST and LARGEST; beyond, around LANE, are the runs that failed."""


@styled
def draw(table: pd.DataFrame, footer: str) -> Figure:
    """Draw the rows of accuracy.work_precision.measure.

    Filled markers: the impacts are those of the reference; hollow: some are missed or spurious. In the lane at the
    right, at their cost: runs that gave no result, each with a number that the list below the panels explains.

    Args:
        table: columns problem, method, family, setting, error_state, error_time, missed, spurious, seconds_per_cycle,
            outcome, reason, order.
        footer: versions, printed below.
    """
    figure = new_figure(DOUBLE_COLUMN, 114.0)
    problems = list(dict.fromkeys(table["problem"]))
    failures = table[(table["outcome"] != "finished") & table["seconds_per_cycle"].notna()]
    numbers = {key: n for n, key in enumerate(dict.fromkeys(map(_failure, failures.itertuples())), start=1)}
    upper, lower = figure.subfigures(2, 1, height_ratios=(1, 0.275))
    panels = upper.subplots(1, len(problems), sharex=True, sharey=True, squeeze=False)[0]
    for axes, problem, letter in zip(panels, problems, ascii_lowercase, strict=False):
        here = table[table["problem"] == problem]
        for method, rows in here.groupby("method", sort=False):
            _method(axes, method, rows)
        _lane(axes, here, numbers)
        axes.set(xscale="log", yscale="log", xlim=(SMALLEST / 3, END), xlabel="error of the final state")
        axes.set_xticks(10.0 ** np.arange(-16, 2, 4))
        axes.minorticks_off()
        axes.margins(y=0.08)
        _better(axes)
        heading(axes, letter, problem)
    panels[0].set_ylabel("time per cycle [s]")
    handles = {kind: Line2D([], [], linewidth=0.8, **_look(kind)) for kind in _in_key(table)}
    handles["hollow: other impacts"] = Line2D([], [], linestyle="", color=GREY, marker="o", markerfacecolor="white")
    lower.legend(handles.values(), handles, loc="upper center", ncols=3, fontsize=9)
    _notes(lower, numbers, table, footer)
    return figure


def _in_key(table):
    """Kinds with several methods, or whose methods are not named; of the others the name of the method says enough."""
    methods = table.groupby("family")["method"].nunique()
    return [kind for kind in KINDS if methods.get(kind, 0) > (0 if kind in CROWDED else 1)]


def _look(kind):
    colour, marker, size = KINDS[kind]
    return {"color": colour, "marker": marker, "markersize": size, "markeredgewidth": 0.7}


def _method(axes, method, rows):
    """The line of a method, with its name where it is most exact."""
    kind = rows["family"].iloc[0]
    look = _look(kind)
    rows = rows[np.isfinite(rows["error_state"]) & (rows["outcome"] == "finished")]
    x, y = rows["error_state"].clip(SMALLEST, LARGEST), rows["seconds_per_cycle"]
    axes.plot(x, y, linewidth=0.8, **look | {"marker": ""})
    whole = (rows["missed"] + rows["spurious"]) == 0
    for chosen, fill in ((whole, look["color"]), (~whole, "white")):
        axes.plot(x[chosen], y[chosen], linestyle="", markerfacecolor=fill, **look)
    if len(rows) and kind not in CROWDED and method not in CLOSE:
        first, offset = x.argmin(), (6, -6) if kind == "exact flow" else (-2, 5)
        axes.annotate(method, (x.iloc[first], y.iloc[first]), offset, textcoords="offset points", fontsize=7, **HALO)


def _better(axes):
    """An arrow towards less error for less time, where no method is."""
    arrow = {"arrowstyle": "->", "color": GREY, "linewidth": 0.8}
    place = {"xycoords": "axes fraction", "textcoords": "axes fraction", "fontsize": 7, "color": GREY}
    axes.annotate("better", (0.05, 0.38), (0.14, 0.5), arrowprops=arrow, **place)


def _lane(axes, here, numbers):
    """The margin for runs without a result."""
    axes.axvspan(LARGEST * 2, END, color=LIGHT_GREY, linewidth=0, zorder=0)
    failed = here[(here["outcome"] != "finished") & here["seconds_per_cycle"].notna()]
    labelled = set()
    for row in failed.sort_values("seconds_per_cycle", ascending=False).itertuples():  # labels above
        number = numbers[_failure(row)]
        x = LANE * LANE_STEP ** (number % 3 - 1)  # side by side, so that equal costs do not cover each other
        axes.plot(x, row.seconds_per_cycle, **_look(row.family))
        if number not in labelled:
            place = {"xytext": (0, 5), "textcoords": "offset points", "ha": "center"}
            axes.annotate(number, (x, row.seconds_per_cycle), fontsize=7, **place)
            labelled.add(number)


def _notes(figure, numbers, table, footer):
    absent = table[table["outcome"] == "unavailable"]
    lines = [f"{n}  {method}: {reason}" for (method, reason), n in numbers.items()]
    for row in absent.drop_duplicates("method").itertuples():
        lines.append(f"{row.method}: unavailable ({row.reason})")
    title = ["grey lane: no result"] if lines else []
    figure.text(0.02, 0.68, "\n".join([*title, *lines]), fontsize=7, va="top", linespacing=1.25)
    figure.text(0.02, 0.02, footer, fontsize=7, color=GREY, va="bottom")


def _failure(row):
    """Return the label of a failed run: method and reason without numbers."""
    return row.method, row.reason.split(" at tau")[0].split(" reach ")[0]
