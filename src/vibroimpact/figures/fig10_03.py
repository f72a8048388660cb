"""Figure 10.3: the saw-tooth function used as a part of the solution W_i0."""

import math

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.plotting.markdown import EXACTLY
from vibroimpact.figures.plotting.style import BLACK, LEVEL, SINGLE_COLUMN, new_figure, styled
from vibroimpact.tables import curve, join, select
from vibroimpact.theory.manifold import sawtooth

SPEC = {
    "title": "The saw-tooth function",
    "notebook": "closed_form",
    "caption": r"Fig. 10.3. The saw-tooth function :math:`Z_i(\tau_0)` of (10.11) for constant :math:`C_i` and "
        r":math:`\theta_i`; its corners are the impacts.",
    "alt": "Triangle wave Z against tau_0 between C and -C. Its corners, the impacts, are half a period apart, at "
        "theta, theta + pi and so on.",
    "equations": [r"Z_i = \frac{2}{\pi}\,C_i \arcsin\left[\cos(\tau_0 - \theta_i)\right] \tag{10.11}"],
    "method": "closed form: (10.11), (10.16), (10.25), (10.26)",
    "columns": {
        "panel": {}, "series": {"values": ["Z", "impacts"]},
        "tau0": {"meaning": r"fast time $\tau_0$ as a phase; impacts at $\theta + j\pi$", "unit": "radians",
            "compared": "algebra"},
        "Z": {"meaning": r"saw-tooth $Z(\tau_0)$, (10.11); the impacts are its corners", "unit": "dimensionless",
            "compared": "algebra"},
    },
}  # fmt: skip


def compute(amplitude: float, theta: float, tau0_max: float) -> pd.DataFrame:
    """Return the saw-tooth Z(tau_0) of (10.11) on [0, tau0_max], and the impacts, which are at the corners of Z.

    amplitude: constant C of (10.11). theta: constant phase of (10.11) [rad].

    Returns columns panel, series ("Z" or "impacts"), tau0, Z. The points of the series "Z" include the corners.

    Raises
    ------
    ValueError
        If amplitude is not above 0, or if no impact lies in [0, tau0_max].
    """
    if not amplitude > 0:
        raise ValueError(f"amplitude: {amplitude} is not above 0")
    first = math.ceil(-theta / math.pi)
    last = math.floor((tau0_max - theta) / math.pi)
    if not tau0_max > 0 or last < first:
        raise ValueError(
            f"tau0_max: {tau0_max} is before the first impact; impacts are at theta + j pi, theta = {theta}"
        )
    impacts = theta + math.pi * np.arange(first, last + 1)
    tau0 = np.union1d(np.linspace(0.0, tau0_max, 201), impacts)
    return join(
        curve("Z", series, tau0=instants, Z=sawtooth(instants, amplitude, theta))
        for series, instants in (("Z", tau0), ("impacts", impacts))
    )


def key_points(table: pd.DataFrame) -> pd.DataFrame:
    """Return one row per impact, with the columns tau0, Z and `after`, the time since the previous impact."""
    impacts = select(table, "Z", "impacts")[["tau0", "Z"]]
    return impacts.assign(after=impacts["tau0"].diff()).reset_index(drop=True)


def exact(amplitude: float, theta: float, tau0_max: float) -> str:
    """Return a text in Markdown on the shape of Z in exact motions of the system.

    The arguments are those of `compute`.
    """
    return (
        f"{EXACTLY} between its impacts a ball flies freely, so that $Z = W - U = -(1 + \\varepsilon)Y$ consists of "
        "straight lines there, too. Its corners are half a period apart only in symmetric motions."
    )


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`, with the amplitude and the impact times marked."""
    figure = new_figure(SINGLE_COLUMN, 42.0)
    axes = figure.add_subplot()
    line, impacts = (select(table, "Z", series) for series in ("Z", "impacts"))
    C = impacts["Z"].abs().max()
    axes.axhline(0.0, color=BLACK, linewidth=0.4, zorder=0)
    for level in (C, -C):
        axes.axhline(level, **LEVEL, zorder=0)
    axes.vlines(impacts["tau0"], -1.3 * C, impacts["Z"], **LEVEL, zorder=0)
    axes.plot(line["tau0"], line["Z"], color=BLACK, linewidth=1.4, label="$Z_i$")
    axes.plot(impacts["tau0"], impacts["Z"], "o", color=BLACK, label="impacts")
    axes.set(xlim=(0.0, line["tau0"].max()), ylim=(-1.3 * C, 1.3 * C), xlabel=r"$\tau_0$", ylabel="$Z_i$")
    axes.set_yticks([-C, 0.0, C], ["$-C_i$", "$0$", "$C_i$"])
    later = [rf"$\theta_i+{'' if j == 1 else j}\pi$" for j in range(1, len(impacts))]
    axes.set_xticks(impacts["tau0"], [r"$\theta_i$", *later])
    axes.tick_params(labelsize=10, right=False, top=False)
    return figure
