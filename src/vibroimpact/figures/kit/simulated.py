"""The simulated motion of the second module as figures 10.8 and 10.11 show it: X_2 above W_2."""

import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.kit.style import BLACK, SINGLE_COLUMN, letter_panel, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join, select

PANELS = {"a": "X_2", "b": "W_2"}
LONG_WINDOW = 300.0
"""A longer window (about 50 cycles) is drawn in thin lines, because neighbouring cycles nearly touch."""


def compute(samples: pd.DataFrame, events: pd.DataFrame) -> pd.DataFrame:
    """X_2 and W_2 = X_2 - Y_2 over tau, as simulated.

    Args:
        samples: columns tau, X2, Y2 (others are ignored), ascending in tau.
        events: impacts, sticks and releases, columns tau, module, wall, X2 (others are ignored).

    Returns columns panel ("a", "b"), series ("X_2", "W_2"), tau, value. The second module's events between the
    first and the last sample are among the points: there W_2 is exactly at a wall and has its corners.
    """
    inside = (events["module"] == 2) & events["tau"].between(samples["tau"].min(), samples["tau"].max())
    corners = events.loc[inside, ["tau", "X2"]].assign(W2=events.loc[inside, "wall"].astype(float))
    between = samples[["tau", "X2"]].assign(W2=samples["X2"] - samples["Y2"])
    motion = pd.concat([corners, between]).drop_duplicates("tau").sort_values("tau", ignore_index=True)
    return join(
        curve(panel, series, tau=motion["tau"], value=motion[series.replace("_", "")])
        for panel, series in PANELS.items()
    )


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: a X_2 above b W_2, the walls W_2 = 1 and W_2 = -1 as thin lines."""
    figure = new_figure(SINGLE_COLUMN, 80.0)
    grid = figure.subplots(len(PANELS), 1, sharex=True)
    linewidth = 0.35 if table["tau"].max() - table["tau"].min() > LONG_WINDOW else 1.1
    for axes, (panel, series) in zip(grid, PANELS.items(), strict=True):
        line = select(table, panel, series)
        axes.plot(line["tau"], line["value"], color=BLACK, linewidth=linewidth)
        reach = 1.1 * line["value"].abs().max()
        axes.set(xlim=(line["tau"].min(), line["tau"].max()), ylim=(-reach, reach), ylabel=f"${series}$")
        letter_panel(axes, panel)
    for wall in (-1.0, 1.0):
        grid[-1].axhline(wall, color=BLACK, linewidth=0.4, zorder=0)
    grid[-1].set_xlabel(r"$\tau$")
    figure.align_ylabels()
    return figure
