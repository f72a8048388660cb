"""Figure 10.11: the strongly modulated response, drawn as figure 10.8."""

import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.plotting import simulated

SPEC = {
    "title": "Strongly modulated response for weak forces",
    "notebook": "simulation",
    "caption": r"Fig. 10.11. Strongly modulated response, simulated for :math:`\hat f_{10} = {f10_hat}`, :math:`\hat "
        "f_{20} = {f20_hat}`: a, displacement of the second box; b, relative displacement of its ball. Grey: "
        "no resonance, the ball takes longer than a forcing period from wall to wall.",
    "alt": "Two panels over many forcing periods: a, the displacement X2 with an amplitude that swells and fades; b, "
        "the relative displacement W2, with stretches that fill the gap between the walls and irregular ones between "
        "them.",
    "own": "fig10_08",
    "equations": "fig10_08",
    "method": "motion of the second module as simulated, with its events as corners",
    "columns": {
        "panel": {"values": ["a", "b"]}, "series": {"values": ["X_2", "W_2"]}, "tau": {"compared": "exact"},
        "cycle": {"meaning": r"time in forcing periods, $\tau/T$", "unit": "forcing periods", "compared": "exact"},
        "value": {"meaning": "$X_2$ or $W_2 = X_2 - Y_2$, as the series says; the events of module 2 are among the "
            "points", "unit": "dimensionless", "compared": "exact"},
    },
    "tables": {
        "statistics": {
            "file": "results/figures/fig10_11.statistics.csv",
            "about": "The amplitude of each box, half its peak-to-peak displacement in each forcing period of the "
                "window.",
            "columns": {
                "displacement": {"meaning": "X1 or X2", "unit": "text"},
                "smallest amplitude": {"meaning": "smallest of them", "unit": "dimensionless", "compared": "exact"},
                "largest amplitude": {"meaning": "largest of them", "unit": "dimensionless", "compared": "exact"},
                "amplitude variation": {"meaning": "their standard deviation over their mean", "unit": "dimensionless",
                    "compared": "exact"},
                "modulation periods": {"meaning": "distances between swells, the cycles at which it has risen above 65 "
                    "% of its range since it was below 35 %", "unit": "number", "compared": "exact"},
                "mean length in cycles": {"meaning": "mean of these distances", "unit": "forcing periods",
                    "compared": "exact"},
            },
        },
    },
}  # fmt: skip


def compute(system, samples: pd.DataFrame, events: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Return the motion as in figure 10.8 ("csv") and statistics of the amplitudes of both boxes ("statistics")."""
    return {"csv": simulated.compute(system, samples, events), "statistics": simulated.statistics(system, samples)}


def draw(tables: dict[str, pd.DataFrame]) -> Figure:
    """Draw the tables of `compute` as in figure 10.8, with grey shading in intervals without resonance."""
    return simulated.draw(tables["csv"], simulated.without_resonance(tables["csv"]))
