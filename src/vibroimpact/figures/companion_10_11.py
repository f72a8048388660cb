"""Companion to figure 10.11: the modulated response with the gaps shaded in which its ball is out of resonance."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.kit import simulated
from vibroimpact.figures.kit.style import LIGHT_GREY, styled
from vibroimpact.figures.kit.tables import curve, join, select
from vibroimpact.regimes.modulation import bursts

SPEC = {
    "title": "Gaps of resonance",
    "caption": "Companion of Fig. 10.11: the same response with the gaps shaded in which the second ball is out of "
        "resonance. Between them are bursts of at least two flights in a row that lead to the other wall and last "
        "between a quarter and three quarters of the forcing period.",
    "alt": "Two panels as in figure 10.11, the displacement X2 and the relative displacement W2, with grey bands where "
        "the ball does not go from wall to wall in time with the forcing. In many of the bands the displacement X2 "
        "swells. A heading says what part of the time the bands take.",
    "equations": "fig10_08",
    "method": "resonant bursts between the impacts of the simulation",
    "case": "figures.fig10_11.case",
    "inputs": {"samples": "results/simulations/{case}/samples.csv", "events": "results/simulations/{case}/events.csv"},
    "columns": {
        "panel": {"values": ["a", "b", "gaps"]},
        "series": {"meaning": "the displacement, or a gap of resonance", "values": ["X_2", "W_2", "gap"]},
        "tau": {"compared": "exact"},
        "value": {"meaning": "$X_2$ or $W_2 = X_2 - Y_2$, as the series says; the events of module 2 are among the "
            "points", "unit": "dimensionless", "compared": "exact"},
        "end": {"meaning": r"of a gap, whose start is `tau`: its end, $\tau$", "unit": "dimensionless",
            "compared": "exact"},
    },
}  # fmt: skip


def compute(system, samples: pd.DataFrame, events: pd.DataFrame) -> pd.DataFrame:
    """X_2 and W_2 over tau, as in figure 10.11, and the gaps between the resonant bursts of ball 2.

    Args:
        samples, events: of the simulation, see `simulated.compute`; events also with their kind.

    Returns columns panel ("a", "b", "gaps"), series ("X_2", "W_2", "gap"), tau (of a gap: its start), value, end (of a
    gap, else blank). Gaps are what lies between bursts (`regimes.modulation.bursts`), and between them and the ends of
    the samples.
    """
    motion = simulated.compute(samples, events)
    hits = events[(events["module"] == 2) & (events["kind"] == "impact")]
    first, last = samples["tau"].iloc[[0, -1]]
    resonant = bursts(hits["tau"], hits["wall"], system.period).clip(first, last)
    starts, ends = np.append(first, resonant[:, 1]), np.append(resonant[:, 0], last)
    gap = ends > starts
    return join([motion, curve("gaps", "gap", tau=starts[gap], end=ends[gap])])


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: figure 10.11 with the gaps of resonance shaded, and their part of the time."""
    figure = simulated.draw(table)
    gaps = select(table, "gaps", "gap")
    for axes in figure.axes:
        for start, end in gaps[["tau", "end"]].to_numpy():
            axes.axvspan(start, end, facecolor=LIGHT_GREY, edgecolor="none", zorder=-1)
    first, last = figure.axes[0].get_xlim()
    share = (gaps["end"] - gaps["tau"]).sum() / (last - first)
    figure.axes[0].set_title(f"shaded: out of resonance, {100 * share:.0f} % of the time", loc="right", pad=3)
    return figure
