"""Compute and draw the simulated motion of the second module, X_2 above W_2, for figures 10.8 and 10.11."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from vibroimpact.exact.measures import modulation
from vibroimpact.exact.measures.periodicity import samples_per_cycle
from vibroimpact.figures.plotting.names import name_walls
from vibroimpact.figures.plotting.style import BLACK, LIGHT_GREY, SINGLE_COLUMN, heading, new_figure, styled, time_plot
from vibroimpact.tables import curve, join, select

PANELS = {"a": "X_2", "b": "W_2"}
WORDS = {"X_2": "second box, simulated", "W_2": "its ball, relative to the box, simulated"}
LONG_WINDOW = 300.0
"""Length [tau] (about 50 cycles) above which a window has thin lines, because neighbouring cycles nearly touch."""


def compute(system, samples: pd.DataFrame, events: pd.DataFrame) -> pd.DataFrame:
    """Return the simulated X_2 and W_2 = X_2 - Y_2 as functions of tau.

    Parameters
    ----------
    samples : DataFrame
        Columns tau, X2, Y2, ascending in tau.
    events : DataFrame
        Impacts, beginnings and ends of sticking phases; columns tau, module, wall, X2.

    Returns columns panel ("a", "b"), series ("X_2", "W_2"), tau, cycle (tau in forcing periods), value. The points
    include the events of module 2, where W_2 is exactly at a wall.
    """
    inside = (events["module"] == 2) & events["tau"].between(samples["tau"].min(), samples["tau"].max())
    corners = events.loc[inside, ["tau", "X2"]].assign(W2=events.loc[inside, "wall"].astype(float))
    between = samples[["tau", "X2"]].assign(W2=samples["X2"] - samples["Y2"])
    motion = pd.concat([corners, between]).drop_duplicates("tau").sort_values("tau", ignore_index=True)
    return join(
        curve(
            panel, series, tau=motion["tau"], cycle=motion["tau"] / system.period, value=motion[series.replace("_", "")]
        )
        for panel, series in PANELS.items()
    )


def statistics(system, samples: pd.DataFrame) -> pd.DataFrame:
    """Return statistics of the amplitudes of each box.

    Each forcing period has one amplitude: half the peak-to-peak displacement of the box. A swell of the amplitude is a
    rise from low to high values (`exact.measures.modulation.swells`). A modulation period is the time from one swell to
    the next.

    Returns the following columns.
    displacement: "X1" or "X2".
    smallest amplitude: smallest amplitude of all forcing periods.
    largest amplitude: largest amplitude of all forcing periods.
    amplitude variation: standard deviation of the amplitudes, divided by their mean.
    modulation periods: number of modulation periods.
    mean length in cycles: mean modulation period [forcing periods], or NaN if there is no modulation period.
    """
    per_cycle = samples_per_cycle(samples["tau"].to_numpy(), system.period)
    amplitudes = {name: modulation.cycle_amplitudes(samples[name], per_cycle) for name in ("X1", "X2")}
    between = {name: np.diff(modulation.swells(values)) for name, values in amplitudes.items()}
    return pd.DataFrame(
        {
            "displacement": name,
            "smallest amplitude": values.min(),
            "largest amplitude": values.max(),
            "amplitude variation": modulation.variation(values),
            "modulation periods": len(between[name]),
            "mean length in cycles": between[name].mean() if len(between[name]) else np.nan,
        }
        for name, values in amplitudes.items()
    )


@styled
def draw(table: pd.DataFrame, shaded: np.ndarray = ()) -> Figure:
    """Draw the table of `compute`: X_2 in panel a, and below it W_2 with the walls in panel b.

    shaded: ends of the time intervals [forcing periods] that get a grey background, shape (n, 2).
    """
    figure = new_figure(SINGLE_COLUMN, 80.0)
    grid = figure.subplots(len(PANELS), 1, sharex=True)
    style = {"color": BLACK, "linewidth": 0.25 if np.ptp(table["tau"]) > LONG_WINDOW else 1.1}
    for axes, (panel, series) in zip(grid, PANELS.items(), strict=True):
        line = select(table, panel, series)
        time_plot(axes, [(line["cycle"], line["value"], style)], walls=series == "W_2")
        for start, end in shaded:
            axes.axvspan(start, end, color=LIGHT_GREY, linewidth=0, zorder=-1)
        reach = 1.2 * line["value"].abs().max()
        axes.set(ylim=(-reach, reach), ylabel=f"${series}$")
        heading(axes, panel, WORDS[series])
    name_walls(grid[-1])
    grid[-1].set_xlabel(r"forcing cycle, $\tau\,\Omega/2\pi$")
    figure.align_ylabels()
    if len(shaded):
        key = Patch(color=LIGHT_GREY, label="ball takes more than a cycle from wall to wall")
        figure.legend(handles=[key], loc="outside lower center", fontsize=9)
    return figure


def without_resonance(table: pd.DataFrame) -> np.ndarray:
    """Return the ends of the time intervals [forcing periods] without resonance, shape (n, 2).

    In such an interval, ball 2 needs more than one forcing period to reach the opposite wall.
    """
    motion = select(table, "b", "W_2")
    time, wall = motion.loc[motion["value"].abs() == 1, ["cycle", "value"]].to_numpy().T
    reached = time[np.diff(wall, prepend=0) != 0]
    return np.column_stack([reached[:-1], reached[1:]])[np.diff(reached) > 1]
