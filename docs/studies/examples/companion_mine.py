"""Companion figure: speed at which a ball hits a wall in a motion with two impacts per cycle."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.plotting.style import SINGLE_COLUMN, STABLE, new_figure, styled
from vibroimpact.tables import curve, select

SPEC = {
    "title": "Speed of a ball at its wall",
    "caption": "How fast a ball meets its wall, over the amplitude :math:`C_i` of its saw-tooth.",
    "alt": "A straight line from the origin, the speed before an impact over the saw-tooth amplitude C.",
    "equations": [r"W_i^{\prime -} = \frac{4 C_i}{\pi(1+\kappa)}"],
    "method": "closed form: (10.12), (10.14)",
    "columns": {
        "panel, series": {},
        "C": {"compared": "algebra"},
        "speed": {"meaning": "$W_i'$ just before an impact, (10.12)", "unit": "dimensionless", "compared": "algebra"},
    },
}


def compute(kappa: float, C_max: float) -> pd.DataFrame:
    """Return the relative speed W' just before an impact for 0 <= C <= C_max, from (10.12) and (10.14)."""
    C = np.linspace(0.0, C_max, 101)
    return curve("speed", "before impact", C=C, speed=4 * C / (np.pi * (1 + kappa)))


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`."""
    figure = new_figure(SINGLE_COLUMN, 50.0)
    axes = figure.add_subplot()
    line = select(table, "speed", "before impact")
    axes.plot(line["C"], line["speed"], **STABLE)
    axes.set(xlabel="$C_i$", ylabel="$W_i'$")
    return figure
