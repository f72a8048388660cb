"""Companion: which regimes starts end in over both forcing amplitudes, with the theory's predictions drawn over it."""

import numpy as np
import pandas as pd
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from vibroimpact.figures.kit.style import BLACK, DOUBLE_COLUMN, hatch_gaps, letter_panel, new_figure, styled
from vibroimpact.regimes.classification import REGIMES
from vibroimpact.sweeps.observations import FROM_REST

LINES = {
    "fixed points": {"linestyles": (0, (1, 1)), "linewidths": 0.9},
    "stable points": {"linestyles": "solid", "linewidths": 1.2},
}
_CASES = {"linestyle": "none", "marker": "x", "color": BLACK, "markersize": 4.0, "markeredgewidth": 0.9}
COLUMNS = 4
DARKEST = 1.7
"""Share that would be black: all starts are a grey on which black lines are seen."""
TICKS = 4
"""At most so many intervals between ticks: left to itself, the number would depend on the last digit of the limits."""


def compute(table: pd.DataFrame, systems: dict) -> dict:
    """The map from the table of a sweep over f10_hat, then f20_hat, both evenly spaced.

    Args:
        systems: case -> system, whose forcing amplitudes are marked.

    Returns "csv": columns panel, series ("cell" or "case"), label (regime from rest or name of the case), f10_hat,
    f20_hat, the share of each regime, fixed_points, stable_points.
    """
    cells = table.rename(columns={FROM_REST: "label"}).assign(series="cell")
    marks = pd.DataFrame({"label": case, "f10_hat": s.f10_hat, "f20_hat": s.f20_hat} for case, s in systems.items())
    table = pd.concat([cells, marks.assign(series="case")], ignore_index=True).assign(panel="map")
    return {"csv": table[["panel", "series", "label", "f10_hat", "f20_hat", *REGIMES, "fixed_points", "stable_points"]]}


@styled
def draw(tables: dict) -> Figure:
    """Draw the table of `compute`: a panel per regime, the share of starts in grey; lines where theory changes."""
    table = tables["csv"]
    cells, cases = (table[table["series"] == name] for name in ("cell", "case"))
    f10, f20 = np.unique(cells["f10_hat"]), np.unique(cells["f20_hat"])
    figure = new_figure(DOUBLE_COLUMN, 138.0)
    grid = figure.subplots(-(-len(REGIMES) // COLUMNS), COLUMNS, sharex=True, sharey=True)
    empty = grid.flat[len(REGIMES) :]
    for axes in empty:
        axes.set_axis_off()
    for axes, regime, letter in zip(grid.flat, REGIMES, "abcdefghijklmnop", strict=False):
        mesh = axes.pcolormesh(f10, f20, _square(cells, regime), cmap="Greys", vmin=0, vmax=DARKEST, rasterized=True)
        if cells[regime].isna().any():
            hatch_gaps(axes)
        for column, style in LINES.items():
            borders = _borders(f10, f20, _square(cells, column.replace(" ", "_")))
            axes.add_collection(LineCollection(borders, colors=BLACK, **style))
        axes.plot(cases["f10_hat"], cases["f20_hat"], **_CASES)
        letter_panel(axes, letter)
        axes.set_title(regime, loc="right", pad=3)
        axes.set(aspect="equal", xlim=_ends(f10), ylim=_ends(f20))
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(MaxNLocator(TICKS))
    for axes in grid.flat[len(REGIMES) - COLUMNS : len(REGIMES)]:
        axes.set_xlabel(r"$\hat f_{10}$")
        axes.tick_params(labelbottom=True)
    for axes in grid[:, 0]:
        axes.set_ylabel(r"$\hat f_{20}$")
    bar = figure.colorbar(
        mesh, ax=grid, label="share of starts", shrink=0.6, pad=0.02, boundaries=np.linspace(0, 1, 101)
    )
    bar.set_ticks(np.linspace(0, 1, 6))
    legend = empty[0].legend(handles=_legend(), loc="center left", fontsize=8.5, frameon=False)
    legend.set_in_layout(False)
    return figure


def _ends(centres):
    """Outer edges of a row of cells, free of the rounding that decides whether a tick at the end is seen."""
    half = 0.5 * (centres[1] - centres[0])
    return np.round([centres[0] - half, centres[-1] + half], 12)


def _square(cells, column):
    """Values on the grid, f20_hat along the first axis."""
    return cells.pivot(index="f20_hat", columns="f10_hat", values=column).to_numpy(dtype=float)


def _borders(x, y, counts):
    """Edges (m, 2, 2) between neighbouring cells with different counts (len(y), len(x))."""
    h, v = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    upright = [[(x[j] + h, y[i] - v), (x[j] + h, y[i] + v)] for i, j in np.argwhere(np.diff(counts, axis=1))]
    level = [[(x[j] - h, y[i] + v), (x[j] + h, y[i] + v)] for i, j in np.argwhere(np.diff(counts, axis=0))]
    return np.array(upright + level).reshape(-1, 2, 2)


def _legend():
    lines = {
        "number of fixed points changes": LINES["fixed points"],
        "number of stable fixed points changes": LINES["stable points"],
    }
    made = [
        Line2D([], [], color=BLACK, linestyle=style["linestyles"], linewidth=style["linewidths"], label=label)
        for label, style in lines.items()
    ]
    return [*made, Line2D([], [], label="cases", **_CASES)]
