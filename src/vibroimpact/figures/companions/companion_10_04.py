"""Companion to figure 10.4: the manifold with the limits of stability as derived, beside the printed one."""

from itertools import pairwise

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.kit.style import BLACK, LIGHT_GREY, SINGLE_COLUMN, STABLE, UNSTABLE, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join, select
from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.masri import lower_limit, upper_limit
from vibroimpact.theory.masri_printed import printed_limit
from vibroimpact.theory.penetration import largest_C

PIECES = {"SIM left": UNSTABLE, "SIM stable": STABLE, "SIM right": UNSTABLE}
"""The manifold from left to right: below the fold, between the limits, above the upper one."""
LIMITS = {
    "printed": ("(10.26)", {"marker": "s", "markerfacecolor": "white"}, (-15, 30)),
    "fold": (r"$C_{\min}$", {"marker": "o", "markerfacecolor": BLACK}, (12, 30)),
    "symmetry breaking": (r"$\pi^2/(\pi^2-4)$", {"marker": "o", "markerfacecolor": BLACK}, (-24, 24)),
}
"""Of each limit: its name in the figure, its marker, the place of the name in points from the marker."""


def compute(kappa: float, C_max: float) -> pd.DataFrame:
    """The manifold B(C), (10.16), with the limits of docs/stability.md and of (10.26), for 0 <= C <= C_max.

    Returns columns panel ("SIM"), series ("SIM left" and "SIM right": unstable, "SIM stable"; "printed", "fold",
    "symmetry breaking": points), C, B.

    Raises:
        ValueError: C_max is not between the upper limit of stability and the C up to which the ball stays inside.
    """
    r = rho(kappa)
    low, high, end = lower_limit(kappa), upper_limit(kappa), largest_C(kappa)
    if not high < C_max <= end:
        raise ValueError(f"C_max: {C_max} is not above the limit of stability {high} and at most {end}")
    edges = (0.0, low, high, C_max)
    pieces = [np.linspace(*ends, 201) for ends in pairwise(edges)]
    limits = dict(zip(LIMITS, (printed_limit(r), low, high), strict=True))
    return join(
        [curve("SIM", series, C=C, B=B_of_C(C, r)) for series, C in zip(PIECES, pieces, strict=True)]
        + [curve("SIM", series, C=C, B=B_of_C(C, r)) for series, C in limits.items()]
    )


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: stable piece bold solid on a shaded band, unstable pieces dashed, limits marked."""
    figure = new_figure(SINGLE_COLUMN, 58.0)
    axes = figure.add_subplot()
    stable = select(table, "SIM", "SIM stable")["C"]
    axes.axvspan(stable.min(), stable.max(), facecolor=LIGHT_GREY, edgecolor="none", zorder=0)
    names = {"SIM stable": "stable", "SIM left": "unstable"}
    for series, style in PIECES.items():
        piece = select(table, "SIM", series)
        axes.plot(piece["C"], piece["B"], **style, label=names.get(series))
    for series, (name, marker, offset) in LIMITS.items():
        ((C, B),) = select(table, "SIM", series)[["C", "B"]].to_numpy()
        axes.plot([C], [B], linestyle="none", color=BLACK, markersize=4.5, zorder=3, **marker)
        leader = {"arrowstyle": "-", "linewidth": 0.5, "shrinkA": 0, "shrinkB": 3}
        axes.annotate(name, (C, B), offset, textcoords="offset points", fontsize=10, ha="center", arrowprops=leader)
    axes.set(xlim=(0.0, table["C"].max()), ylim=(0.0, 1.06 * table["B"].max()), xlabel="$C_i$", ylabel="$B_i$")
    axes.legend(loc="upper center", ncols=2)
    return figure
