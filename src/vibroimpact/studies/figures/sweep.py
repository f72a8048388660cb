"""Draw the results of a sweep: curves if one parameter varies, maps if two parameters vary."""

from itertools import cycle

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from vibroimpact.figures.plotting.style import DOUBLE_COLUMN, hatch_gaps, new_figure, side_by_side, styled
from vibroimpact.studies.figures.plotting.regime_colours import COLOURS
from vibroimpact.studies.regimes.classification import REGIMES
from vibroimpact.studies.sweeps.grid import LINEAR, LOGARITHMIC
from vibroimpact.tables import curve, join

SYMBOLS = {
    "epsilon": r"$\varepsilon$",
    "kappa": r"$\kappa$",
    "alpha12_hat": r"$\hat\alpha_{12}$",
    "gamma1_hat": r"$\hat\gamma_1$",
    "gamma2_hat": r"$\hat\gamma_2$",
    "gamma12_hat": r"$\hat\gamma_{12}$",
    "sigma20_hat": r"$\hat\sigma_{20}$",
    "sigma_e_hat": r"$\hat\sigma_e$",
    "f10_hat": r"$\hat f_{10}$",
    "f20_hat": r"$\hat f_{20}$",
}
PANELS = {
    "share of starts": {name: name for name in REGIMES},
    "largest $|X_i|$": {"largest_X1": "box 1", "largest_X2": "box 2"},
    "root mean square of $X_i$": {"rms_X1": "box 1", "rms_X2": "box 2"},
    "along the band": {"peak": "largest $|X_i|$", "peak_rms": "root mean square"},
    "share of the work": {"impact_share": "impacts"},
    "mean ball speed": {"ball_speed_1": "ball 1", "ball_speed_2": "ball 2"},
    "fixed points": {"fixed_points": "all", "stable_points": "stable"},
}
"""Panel -> column of the table -> name in the legend. In maps each column has its own panel."""
MARKERS, SHADES = "osD^vPX<>d", ("black", "0.45", "0.7")
"""Markers and grey levels of the curves, in order; curves of regimes have the colours of the regimes."""
HEIGHT = 48.0
"""Height of a panel, in mm."""


def compute(table: pd.DataFrame, axes: list[dict]) -> pd.DataFrame:
    """Return the drawn columns of a sweep's table in long form, one row per value.

    Parameters
    ----------
    axes : list of dict
        For each axis, `along` (names of the parameters that vary together) and optionally `scale`.

    Returns
    -------
    DataFrame
        The columns are "panel", "series", one column for the first parameter of each axis, "value", "along" and
        "scale". The columns "along" and "scale" contain the settings of all axes, separated by "; ".
    """
    moved = [axis["along"][0] for axis in axes]
    curves = [
        curve(panel, series, **{name: table[name] for name in moved}, value=table[column])
        for panel, columns in PANELS.items()
        for column, series in columns.items()
        if column in table and (column not in REGIMES or table[column].any())
    ]
    along, scale = ([" ".join(axis["along"]) for axis in axes], [axis.get("scale", LINEAR) for axis in axes])
    return join(curves).assign(along="; ".join(along), scale="; ".join(scale))


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`."""
    along, scale = (table[name].iloc[0].split("; ") for name in ("along", "scale"))
    axes = [{"along": names.split(), "scale": name} for names, name in zip(along, scale, strict=True)]
    names = ["panel"] if len(axes) == 1 else ["panel", "series"]
    panels = list(table.groupby(names, sort=False))
    columns, rows = side_by_side(len(panels), most=2 if len(axes) == 1 else 3)
    figure = new_figure(DOUBLE_COLUMN, HEIGHT * rows)
    grid = figure.subplots(rows, columns, squeeze=False)
    for place, (names, part) in zip(grid.flat, panels, strict=False):
        (_curves if len(axes) == 1 else _map)(place, names, part, axes)
        for axis, side in zip(axes, "xy", strict=False):
            place.set(**{f"{side}label": ", ".join(SYMBOLS[name] for name in axis["along"])})
            if axis["scale"] == LOGARITHMIC:
                place.set(**{f"{side}scale": "log"})
    for place in grid.flat[len(panels) :]:
        place.set_axis_off()
    return figure


def _curves(place, names, part, axes):
    x = axes[0]["along"][0]
    lines = part["series"].unique()
    for series, marker, colour in zip(lines, cycle(MARKERS), cycle(SHADES)):
        line = part[part["series"] == series].sort_values(x)
        colour = COLOURS.get(series, colour)
        place.plot(line[x], line["value"], label=series, markersize=3.0, marker=marker, color=colour)
    place.set_ylabel(names[0])
    place.set_ylim(bottom=0)
    place.legend(fontsize=7.5, loc="best")


def _map(place, names, part, axes):
    x, y = (axis["along"][0] for axis in axes)
    square = part.pivot(index=y, columns=x, values="value")
    borders = [edges(values, axis) for values, axis in zip((square.columns, square.index), axes, strict=True)]
    most = 1.0 if names[1] in REGIMES else max(part["value"].max(), 1e-12)
    hatch_gaps(place)
    mesh = place.pcolormesh(*borders, square, cmap="Greys", vmin=0.0, vmax=most, rasterized=True)
    bar = place.figure.colorbar(mesh, ax=place)
    bar.locator = MaxNLocator(4)
    bar.ax.tick_params(labelsize=7.5)
    panel, series = names
    place.set_title(series if series in REGIMES else f"{panel}, {series}", fontsize=8.5, pad=3)


def edges(values, axis):
    """Return cell borders around ascending values, half-way between neighbours on the scale of the axis."""
    to_scale, from_scale = (np.log, np.exp) if axis["scale"] == LOGARITHMIC else (np.asarray, np.asarray)
    at = to_scale(np.asarray(values, dtype=float))
    middles = 0.5 * (at[1:] + at[:-1])
    return from_scale(np.concatenate([[2 * at[0] - middles[0]], middles, [2 * at[-1] - middles[-1]]]))
