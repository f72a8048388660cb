"""Companion to figure 10.11: when a float64 run leaves the true trajectory of the modulated response."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.plotting.style import BLACK, GREY, SINGLE_COLUMN, new_figure, styled
from vibroimpact.studies.horizon import departure
from vibroimpact.system import System
from vibroimpact.system.state import NAMES
from vibroimpact.tables import curve, join, select

SPEC = {
    "title": "Departure of double precision from the true trajectory",
    "caption": "Error of a simulation of Fig. 10.11 in double precision. Measured: distance from the true trajectory, "
        "computed with many digits and confirmed by doubling them. Estimated: by the certificate of the run. "
        "Dot: horizon, at which the estimate exceeds :math:`10^{-3}`.",
    "alt": "Distance between the trajectory in double precision and the confirmed one over forcing cycles, on a "
        "logarithmic axis. It grows from rounding to the size of the motion and stays there.",
    "method": "simulation in float64, and the error estimate in the certificate of this run",
    "columns": {
        "panel": {}, "series": {"values": ["measured", "expected", "horizon"]},
        "cycle": {"meaning": "time since the start; for the series horizon, time at which the estimated error exceeds "
            "$10^{-3}$",
            "unit": "forcing periods", "compared": {"measured": "algebra", "others": "horizon"}},
        "error": {"meaning": "largest error of a component of the state: measured, or estimated by the certificate of "
            "the run", "unit": "dimensionless", "compared": {"measured": "rounding",
            "others": "certificate"}},
    },
}  # fmt: skip


def compute(system: System, initial_state, strobe: pd.DataFrame) -> pd.DataFrame:
    """Return the measured and the expected error of a float64 run at the start of each forcing cycle.

    The expected error is the estimate in the certificate of the run.

    Parameters
    ----------
    strobe : DataFrame
        True states at the starts of the cycles, with the columns `NAMES`.

    Returns
    -------
    DataFrame
        The table in SPEC.
    """
    difference, expected, horizon = departure(system, initial_state, strobe[list(NAMES)].to_numpy(float))
    cycles = np.arange(len(difference))
    known = np.isfinite(expected)
    return join(
        [
            curve("error", "measured", cycle=cycles, error=difference),
            curve("error", "expected", cycle=cycles[known], error=expected[known]),
            curve("error", "horizon", cycle=[horizon], error=[1e-3]),
        ]
    )


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: error against cycles, on a logarithmic axis."""
    figure = new_figure(SINGLE_COLUMN, 58.0)
    axes = figure.add_subplot()
    measured, expected = select(table, "error", "measured"), select(table, "error", "expected")
    axes.semilogy(measured["cycle"], measured["error"].clip(lower=1e-17), color=BLACK, linewidth=0.8, label="measured")
    axes.semilogy(expected["cycle"], expected["error"], color=GREY, linestyle="--", linewidth=1.6, label="estimated")
    ((cycle, error),) = select(table, "error", "horizon")[["cycle", "error"]].to_numpy()
    name = f"horizon: estimate exceeds {error:g}"
    axes.plot(cycle, error, marker="o", color=BLACK, linestyle="none", markersize=4, label=name)
    axes.set(xlim=(0, measured["cycle"].max()), ylim=(1e-17, 30))
    axes.set(xlabel="forcing cycle", ylabel="error in double precision")
    axes.legend(loc="lower right", fontsize=9)
    return figure
