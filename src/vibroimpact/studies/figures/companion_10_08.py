"""Companion to figures 10.7 and 10.8: the motion of module 2, predicted by the theory and simulated."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.exact.measures.slow_variables import amplitude_and_lag
from vibroimpact.figures.plotting.style import BLACK, GREY, SINGLE_COLUMN, heading, new_figure, styled, time_plot
from vibroimpact.tables import curve, join, select
from vibroimpact.theory.fixed_points.table import labelled_points
from vibroimpact.theory.response import impact_times, leading_order

SPEC = {
    "title": "Predicted and simulated flights",
    "caption": "Companion of Figs. 10.7 and 10.8: relative displacement :math:`W_2` against the phase of the forcing. "
        "Top: predicted at the fixed point nearest to the simulated motion. Bottom: simulated; grey: its mirror "
        "image, half a period later with all signs changed, which also solves the equations. Each flight is labelled "
        "with its length in forcing periods :math:`T`.",
    "alt": "W2 over two forcing periods. In the theory, all flights from wall to wall take half a period. In the "
        "simulation, long and short flights alternate; another curve shows the mirror image of this motion.",
    "equations": [r"W_{i0} = B_i\sin(\tau_0 + \phi_i) + Z_i \tag{10.10}"],
    "method": "(10.10) at the fixed point nearest to the simulated motion, and the simulated motion",
    "columns": {
        "panel": {"values": ["theory", "simulation"]},
        "series": {"meaning": "the motion; its mirror image, half a period later with all signs changed; the impacts",
            "values": ["W_2", "mirror image", "impact"]},
        "label": {"meaning": "label of the fixed point", "unit": "text"},
        "phase": {"meaning": r"time since the start of a forcing period, $\tau/T$", "unit": "forcing periods",
            "compared": "trajectory"},
        "W2": {"meaning": "$W_2 = X_2 - Y_2$", "unit": "dimensionless", "compared": "trajectory"},
    },
}  # fmt: skip

PANELS = {"theory": "theory: fixed point ({})", "simulation": "simulated"}
PERIODS = 2
MOST_FLIGHTS = 4
"""The figure shows the lengths of the flights of a motion with at most this number of flights per forcing period."""


def compute(system, points: pd.DataFrame, samples: pd.DataFrame, events: pd.DataFrame) -> pd.DataFrame:
    """Return W_2 = X_2 - Y_2 over two forcing periods, as predicted by the theory and as simulated.

    The prediction is (10.10) at the fixed point nearest to the simulated motion.

    Parameters
    ----------
    points : DataFrame
        Fixed points of the theory, with the columns label, C1, C2, B1, B2, psi1, psi2.
    samples : DataFrame
        Simulated states at evenly spaced times, with the columns tau, X1, Y1, X2, Y2. The first sample is at the start
        of a forcing period.
    events : DataFrame
        Simulated events, with the columns tau, module, wall, kind, X2, Y2.

    Returns
    -------
    DataFrame
        The table in SPEC.
    """
    start, period = samples["tau"].iloc[0], system.period
    hits = events[(events["module"] == 2) & (events["kind"] == "impact")]
    sampled = pd.DataFrame({"phase": (samples["tau"] - start) / period, "W2": samples["X2"] - samples["Y2"]})
    impacts = pd.DataFrame({"phase": (hits["tau"] - start) / period, "W2": hits["wall"].astype(float)})
    motion = pd.concat([sampled, impacts]).drop_duplicates("phase").sort_values("phase")
    # If a motion is shifted by half a period and all its signs are changed, it still solves the equations.
    image = motion.assign(phase=motion["phase"] - 0.5, W2=-motion["W2"])
    return join(
        [
            *_theory(system, points, samples),
            *(
                curve("simulation", series, **line[line["phase"].between(0.0, PERIODS + 1e-9)])
                for series, line in (("W_2", motion), ("mirror image", image), ("impact", impacts))
            ),
        ]
    )


def _theory(system, points, samples):
    """Yield the curves predicted at the fixed point nearest to the simulation; without fixed points, yield nothing."""
    period = system.period
    whole = samples[samples["tau"] < samples["tau"].iloc[0] + period * (1 - 1e-9)]
    U = np.column_stack([whole[f"X{i}"] + system.epsilon * whole[f"Y{i}"] for i in (1, 2)])
    B, psi = amplitude_and_lag(whole["tau"], U, system.Omega)
    found = sorted(
        labelled_points(points), key=lambda at: np.linalg.norm(B * np.exp(-1j * psi) - at.B * np.exp(-1j * at.psi))
    )
    for point in found[:1]:
        at = impact_times(system, point)[1] + 0.5 * period * np.arange(-2, 2 * PERIODS + 1)
        at = at[(at >= 0) & (at <= PERIODS * period)]
        for series, tau in ("W_2", np.union1d(np.linspace(0.0, PERIODS * period, 401), at)), ("impact", at):
            W2 = leading_order(system, point, tau).W[:, 1]
            yield curve("theory", series, phase=tau / period, W2=W2).assign(label=point.label)


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: the theory in the upper panel, the simulation in the lower panel."""
    figure = new_figure(SINGLE_COLUMN, 88.0)
    grid = figure.subplots(len(PANELS), 1, sharex=True, sharey=True)
    for axes, (panel, title) in zip(grid, PANELS.items(), strict=True):
        line = select(table, panel, "W_2")
        name = title.format(*line.get("label", [])) if len(line) else "theory: no fixed point"
        heading(axes, words=name)
        image = select(table, panel, "mirror image")
        axes.plot(image["phase"], image["W2"], color=GREY, linewidth=1.0, label="mirror image")
        time_plot(axes, [(line["phase"], line["W2"], {"color": BLACK, "linewidth": 1.3})])
        _name_flights(axes, select(table, panel, "impact"))
        axes.set(ylabel="$W_2$", ylim=(-1.75, 1.75), yticks=(-1, 0, 1), xlim=(0, PERIODS))
    grid[-1].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.1)
    grid[-1].set_xlabel(r"phase of the forcing, $\tau/T$")
    return figure


def _name_flights(axes, impacts):
    """Write the length of each flight, in forcing periods, beside the wall at which the flight ends."""
    phase, wall = impacts["phase"].to_numpy(), impacts["W2"].to_numpy()
    if len(phase) > MOST_FLIGHTS * PERIODS:
        return
    for start, end, to in zip(phase, phase[1:], wall[1:], strict=False):
        level = 1.18 * to
        ends = {"arrowstyle": "|-|,widthA=0.15,widthB=0.15", "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", (start, level), (end, level), arrowprops=ends)
        side = "bottom" if to > 0 else "top"
        axes.text((start + end) / 2, 1.24 * to, f"{end - start:.2f} $T$", ha="center", va=side, fontsize=8)
