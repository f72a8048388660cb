"""Companion to figure 10.4: the manifold with the limits of stability as derived, beside the printed one."""

from itertools import pairwise

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.kit.style import BLACK, LIGHT_GREY, SINGLE_COLUMN, STABLE, UNSTABLE, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join, select
from vibroimpact.theory.manifold import B_of_C, largest_C, rho
from vibroimpact.theory.masri import lower_limit, printed_limit, upper_limit

SPEC = {
    "title": "The manifold with the limits as derived",
    "caption": "Companion of Fig. 10.4. The manifold with the limits of stability as derived from Masri's analysis: "
        "stable piece bold solid on a shaded band, unstable pieces dashed; square: the printed limit (10.26). Inset: "
        r"the piece from there to :math:`C_{\min}`, which (10.26) calls stable.",
    "alt": "V-shaped curve B over C; a shaded band between C_min and the limit of symmetry breaking holds the only "
        "stable piece. A square marks the printed limit, on the unstable left arm; an inset magnifies the unstable "
        "piece from there to C_min.",
    "equations": [r"C_{\min} = \frac{1}{1+\rho^2} < C < \frac{\pi^2}{\pi^2 - 4}"],
    "method": "closed form: (10.16), (10.26), limits of Masri's analysis",
    "settings": {"kappa": "system.kappa", "C_max": "stability.companion_10_04.C_max"},
    "columns": {
        "panel": {},
        "series": {"meaning": "pieces of the manifold below, between and above the limits as derived; points: (10.26), "
            r"$C_{\min}$, $\pi^2/(\pi^2 - 4)$", "values": ["SIM left", "SIM stable", "SIM right", "printed", "fold",
            "symmetry breaking"]},
        "C, B": {"compared": "algebra"},
    },
}  # fmt: skip

PIECES = {"SIM left": UNSTABLE, "SIM stable": STABLE, "SIM right": UNSTABLE}
"""The manifold from left to right: below the fold, between the limits, above the upper one."""
LIMITS = {
    "printed": ("(10.26)", {"marker": "s", "markerfacecolor": "white"}, (14, 7)),
    "fold": (r"$C_{\min}$", {"marker": "o", "markerfacecolor": BLACK}, (0, 11)),
    "symmetry breaking": (r"$\pi^2/(\pi^2-4)$", {"marker": "o", "markerfacecolor": BLACK}, (26, -17)),
}
"""By limit: its name in the figure, its marker, the place of the name in points from the marker."""
INSET, AROUND, TALL = (0.27, 0.42, 0.33, 0.36), 0.3, 0.35
"""The inset between the printed limit and the fold: its place as shares of the axes, and its margins beyond both."""


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
    figure = new_figure(SINGLE_COLUMN, 66.0)
    axes = figure.add_subplot()
    axes.set(xlim=(0.0, table["C"].max()), ylim=(0.0, 1.06 * table["B"].max()), xlabel="$C_i$", ylabel="$B_i$")
    _draw_pieces(axes, table)
    _mark(axes, table, ["symmetry breaking"], named=True)
    _mark(axes, table, ["printed", "fold"], named=False)
    axes.legend(loc="upper left", bbox_to_anchor=(0.05, 1.0), ncols=2)
    _draw_inset(axes, table)
    return figure


def _draw_pieces(axes, table):
    """The manifold on the shaded band of its stable piece."""
    stable = select(table, "SIM", "SIM stable")["C"]
    axes.axvspan(stable.min(), stable.max(), facecolor=LIGHT_GREY, edgecolor="none", zorder=0)
    names = {"SIM stable": "stable", "SIM left": "unstable"}
    for series, style in PIECES.items():
        piece = select(table, "SIM", series)
        axes.plot(piece["C"], piece["B"], **style, label=names.get(series))


def _mark(axes, table, limits, named):
    for series in limits:
        name, marker, offset = LIMITS[series]
        ((C, B),) = select(table, "SIM", series)[["C", "B"]].to_numpy()
        axes.plot([C], [B], linestyle="none", color=BLACK, markersize=4.5, zorder=3, **marker)
        if named:
            axes.annotate(name, (C, B), offset, textcoords="offset points", fontsize=10, ha="center")


def _draw_inset(axes, table):
    """Draw the part between the printed limit and the fold, which (10.26) calls stable though it is not."""
    ends = [select(table, "SIM", series)[["C", "B"]].to_numpy()[0] for series in ("printed", "fold")]
    (left, top), (right, bottom) = ends
    inset = axes.inset_axes(INSET)
    wide, high = AROUND * (right - left), TALL * (top - bottom)
    inset.set(xlim=(left - wide, right + wide), ylim=(bottom - high, top + 2 * high))
    inset.set_xticks([left, right], [f"{left:.3f}", f"{right:.3f}"])
    _draw_pieces(inset, table)
    _mark(inset, table, ["printed", "fold"], named=True)
    inset.tick_params(labelsize=7.5, labeltop=True, labelbottom=False, pad=2)
    axes.indicate_inset_zoom(inset, edgecolor=BLACK, linewidth=0.5, alpha=1)
