"""Animate the motion of both modules: frames of the animation, and a still picture of several instants."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from vibroimpact.figures.plotting.style import BLACK, DOUBLE_COLUMN, GREY, LIGHT_GREY, new_figure, styled

SPEC = {
    "title": "Motion of case {case}",
    "caption": r"Motion of case *{case}*, :math:`\hat f_{10} = {f10_hat}`, :math:`\hat f_{20} = {f20_hat}`. A picture "
        "of one cycle shows six instants; :math:`T` is the forcing period, and a star marks a wall that is hit before "
        "the next instant. A picture of several cycles shows the displacements of both boxes (grey) and their "
        "envelopes (black).",
    "alt": "For one cycle of case {case}: six small pictures of two boxes on springs with a ball in each, at "
        "successive instants. For several cycles: the displacement of each box within its envelope.",
    "method": "frames of the simulated window",
}  # fmt: skip

REST_POSITIONS = {1: -3.0, 2: 3.0}
"""Rest positions of the boxes in units of L, far enough apart for every motion of the chapter."""
BALL, WALL, HALF_HEIGHT, EDGE = 0.28, 0.12, 0.62, 6.2
"""Ball radius, wall thickness, half the box height, and distance of each support from the middle, in units of L."""
INSTANTS, ROW = 6, 15.0
"""Number of instants in the still picture, and height of the row of each instant in mm."""
COORDINATES = ["X1", "Y1", "X2", "Y2"]


def compute(samples: pd.DataFrame, events: pd.DataFrame, system, cycles: int) -> dict[str, pd.DataFrame]:
    """Return the first `cycles` forcing cycles of a simulated window.

    Parameters
    ----------
    samples : DataFrame
        Columns tau, X1, Y1, X2, Y2 (others are ignored), ascending in tau.
    events : DataFrame
        Impacts, sticks and releases; columns tau, module, wall, kind, X1, Y1, X2, Y2.

    Returns two tables. "motion" has columns t (forcing periods from the start), X1, Y1, X2, Y2 and a row per sample and
    event, so that straight lines between rows keep the corners at impacts. "impacts" has columns t, module, wall.

    Raises
    ------
    ValueError
        If the window has fewer than `cycles` cycles.
    """
    start, period = samples["tau"].iloc[0], system.period
    end = start + cycles * period
    if samples["tau"].iloc[-1] < end - 1e-6 * period:
        window = (samples["tau"].iloc[-1] - start) / period
        raise ValueError(f"cycles: {cycles} exceeds the window of the simulation, {window:g} forcing cycles")
    inside = pd.concat([samples, events])[["tau", *COORDINATES]]
    inside = inside[inside["tau"].between(start, end + 1e-6 * period)].drop_duplicates("tau").sort_values("tau")
    impacts = events[(events["kind"] == "impact") & events["tau"].between(start, end)]
    return {
        "motion": _timed(inside, start, period)[["t", *COORDINATES]],
        "impacts": _timed(impacts, start, period)[["t", "module", "wall"]],
    }


def _timed(table, start, period):
    return table.assign(t=(table["tau"] - start) / period).reset_index(drop=True)


def page_data(tables: dict[str, pd.DataFrame], cycles: int) -> dict:
    """Return the frames for the animation in the report, rounded to 0.001 L, which is less than a pixel."""
    motion = tables["motion"].round({"t": 4} | dict.fromkeys(COORDINATES, 3))
    impacts = tables["impacts"].round({"t": 4}).to_numpy().tolist()
    return {
        "cycles": cycles,
        "places": list(REST_POSITIONS.values()),
        "motion": motion.to_dict("list"),
        "impacts": impacts,
    }


@styled
def draw(tables: dict[str, pd.DataFrame]) -> Figure:
    """Draw instants of the first cycle with impacts, one row per instant, and mark the impacts.

    If the motion lasts more than one cycle, draw the displacement of each box over time with its envelope instead.
    """
    if round(tables["motion"]["t"].iloc[-1]) > 1:
        return _envelopes(tables["motion"])
    first = tables["impacts"]["t"].min() if len(tables["impacts"]) else 0.0
    start = np.floor(first)
    figure = new_figure(DOUBLE_COLUMN, ROW * INSTANTS + 4.0)
    grid = figure.subplots(INSTANTS, 1, sharex=True, squeeze=False)[:, 0]
    for axes, t in zip(grid, start + np.arange(INSTANTS) / INSTANTS, strict=True):
        axes.set(xlim=(-EDGE, EDGE), ylim=(-0.95, 0.75), aspect="equal")
        axes.set_axis_off()
        axes.text(-EDGE, 0.35, f"t = {t:.2f} T", fontsize=8)
        _instant(axes, tables, t)
    return figure


def _envelopes(motion):
    """Draw the displacement of both boxes over time, with its largest and smallest value in each cycle."""
    figure = new_figure(DOUBLE_COLUMN, ROW * INSTANTS)
    cycle = np.minimum(motion["t"].astype(int), round(motion["t"].iloc[-1]) - 1)
    for axes, module in zip(figure.subplots(2, 1, sharex=True, sharey=True), REST_POSITIONS, strict=True):
        X = motion[f"X{module}"]
        axes.plot(motion["t"], X, color=GREY, linewidth=0.5)
        for extreme in (X.groupby(cycle).max(), X.groupby(cycle).min()):
            axes.plot(extreme.index + 0.5, extreme, color=BLACK, linewidth=1.4)
        axes.set(xlim=(0.0, motion["t"].iloc[-1]), ylabel=f"$X_{module}$")
    axes.set_xlabel("forcing cycle")
    return figure


def _instant(axes, tables, t):
    motion = tables["motion"]
    at = {name: float(np.interp(t, motion["t"], motion[name])) for name in COORDINATES}
    boxes = {module: REST_POSITIONS[module] + at[f"X{module}"] for module in REST_POSITIONS}
    side = 1.0 + BALL + WALL
    ends = [-EDGE, boxes[1] - side, boxes[1] + side, boxes[2] - side, boxes[2] + side, EDGE]
    for left, right in zip(ends[::2], ends[1::2], strict=True):
        axes.plot(*_spring(left, right), color=GREY, linewidth=0.7)
    for module, centre in boxes.items():
        axes.add_patch(Rectangle((centre - side, -HALF_HEIGHT), 2 * side, 2 * HALF_HEIGHT, facecolor=LIGHT_GREY))
        cavity = (centre - side + WALL, -HALF_HEIGHT + WALL)
        axes.add_patch(Rectangle(cavity, 2 * (side - WALL), 2 * (HALF_HEIGHT - WALL), facecolor="white"))
        axes.add_patch(Circle((REST_POSITIONS[module] + at[f"Y{module}"], 0.0), BALL, facecolor=BLACK))
        axes.plot([REST_POSITIONS[module]] * 2, [-0.78, -0.68], color=BLACK, linewidth=0.7)
    near = tables["impacts"][(tables["impacts"]["t"] - t).between(0.0, 1.0 / INSTANTS, inclusive="left")]
    for hit in near.itertuples():
        # W = X - Y = 1 means that the ball is at the left wall of its cavity.
        place = boxes[hit.module] - hit.wall * (side - 0.5 * WALL)
        axes.plot(place, -0.86, marker="*", color=BLACK, markersize=6, markeredgewidth=0)


def _spring(left: float, right: float):
    """Return the coordinates x and y of a zigzag line with seven turns between two positions."""
    lead = 0.15 * (right - left)
    inner = np.linspace(left + lead, right - lead, 15)
    x = np.concatenate([[left], inner, [right]])
    y = np.concatenate([[0.0], 0.13 * np.resize([0.0, 1.0, 0.0, -1.0], 15), [0.0]])
    return x, y
