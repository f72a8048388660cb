"""Figure 10.11: the strongly modulated response, in the form of figure 10.8."""

import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.plotting import simulated

SPEC = {
    "title": "Strongly modulated response for weak forces",
    "notebook": "simulation",
    "caption": r"Fig. 10.11. Strongly modulated response, simulated for :math:`\hat f_{10} = {f10_hat}`, :math:`\hat "
        "f_{20} = {f20_hat}`: a, displacement of the second box; b, relative displacement of its ball. Grey: "
        "intervals without resonance, in which the ball takes longer than a forcing period from wall to wall.",
    "alt": "Two panels over many forcing periods: a, the displacement X2, whose amplitude rises and falls; b, the "
        "relative displacement W2, which alternates between intervals from wall to wall and irregular ones.",
    "own": "fig10_08",
    "equations": "fig10_08",
    "method": "simulated motion of the second module, with a corner at each event",
    "columns": {
        "panel": {"values": ["a", "b"]}, "series": {"values": ["X_2", "W_2"]}, "tau": {"compared": "exact"},
        "cycle": {"meaning": r"time in forcing periods, $\tau/T$", "unit": "forcing periods", "compared": "exact"},
        "value": {"meaning": "$X_2$ or $W_2 = X_2 - Y_2$, named in `series`; the points include the events of module 2",
            "unit": "dimensionless", "compared": "exact"},
    },
    "tables": {
        "statistics": {
            "file": "results/figures/fig10_11.statistics.csv",
            "about": "Statistics of the amplitude of each box in the window. The amplitude is half the peak-to-peak "
                "displacement of a forcing period.",
            "columns": {
                "displacement": {"meaning": "X1 or X2", "unit": "text"},
                "smallest amplitude": {"meaning": "smallest amplitude", "unit": "dimensionless", "compared": "exact"},
                "largest amplitude": {"meaning": "largest amplitude", "unit": "dimensionless", "compared": "exact"},
                "amplitude variation": {"meaning": "standard deviation of the amplitudes over their mean",
                    "unit": "dimensionless",
                    "compared": "exact"},
                "modulation periods": {"meaning": "number of distances between swells; a swell is a cycle whose "
                    "amplitude rises above 65 % of the range for the first time after it was below 35 %",
                    "unit": "number", "compared": "exact"},
                "mean length in cycles": {"meaning": "mean distance between swells", "unit": "forcing periods",
                    "compared": "exact"},
            },
        },
    },
}  # fmt: skip


def compute(system, samples: pd.DataFrame, events: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Return two tables: the motion of module 2, and statistics of the amplitudes of both boxes.

    The keys of the tables are "csv" and "statistics". The table "csv" has the columns of figure 10.8.
    """
    return {"csv": simulated.compute(system, samples, events), "statistics": simulated.statistics(system, samples)}


def draw(tables: dict[str, pd.DataFrame]) -> Figure:
    """Draw the tables of `compute` as in figure 10.8.

    Grey shading marks time intervals without resonance. In such an interval, ball 2 needs more than one forcing period
    to reach the opposite wall.
    """
    return simulated.draw(tables["csv"], simulated.without_resonance(tables["csv"]))
