"""Companion to figure 10.5: where the motion with two impacts per cycle exists and is stable, for every kappa."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.plotting.style import BLACK, LEVEL, LIGHT_GREY, SINGLE_COLUMN, UNSTABLE, new_figure, styled
from vibroimpact.theory.manifold import largest_C, rho
from vibroimpact.theory.masri import lower_limit, printed_limit, upper_limit

SPEC = {
    "title": "Stability regions as derived",
    "caption": "Companion of Fig. 10.5. Shaded: the motion exists and is stable, as derived. Dashed: limit at which "
        "the ball leaves the box. Dotted: the printed limit (10.26).",
    "alt": "Plane of kappa and C. The shaded region of stable motion lies between the curve C_min and a horizontal "
        "line. At small kappa, the dashed limit at which the ball leaves the box cuts it off. The printed limit is "
        "dotted, below the region.",
    "equations": [r"p\cot p = \frac{1}{1+\kappa}, \qquad \frac{1}{C_{\mathrm g}} = 1 - "
        r"\frac{2p}{\pi}\big(1+\kappa\cot^2p\big)"],
    "method": "closed form: (10.26), limits of Masri's analysis; penetration as a root",
    "columns": {
        "series": {"meaning": r"lines of $C_{\min}$, of $\pi^2/(\pi^2 - 4)$, of the $C$ at which the ball grazes the "
            "wall that it has just left, and of (10.26)", "values": ["fold", "symmetry breaking", "penetration",
            "printed"]},
        "kappa, C": {"compared": "algebra"},
    },
    "tables": {
        "outline": {
            "file": "results/figures/companion_10_05.outline.csv",
            "about": "Outline of the region of `companion_10_05` in which motions exist and are stable.",
            "columns": {"kappa, C": {"compared": "algebra"}},
        },
    },
}  # fmt: skip

BORDER = {"color": BLACK, "linewidth": 1.0, "linestyle": "-"}
LIMITS = {"fold": BORDER, "symmetry breaking": BORDER, "penetration": UNSTABLE, "printed": LEVEL}
NAMES = {
    "fold": (r"$C_{\min}$", 0.3, (6, 9), "left"),
    "symmetry breaking": (r"$\pi^2/(\pi^2-4)$: symmetry breaks", 0.62, (0, 9), "center"),
    "printed": ("(10.26)", 0.4, (5, -8), "left"),
    "penetration": (r"$\leftarrow$ the ball would leave the box", 0.16, (5, 0), "left"),
}
"""For each limit: its name in the figure, and the kappa, offset from the line [points] and alignment of the name."""
KAPPA_MARGIN = 1e-9
"""Smallest distance of kappa from 0 and from 1; `System` accepts neither 0 nor 1."""


def compute(C_range: tuple[float, float]) -> dict:
    """Return the limits in docs/stability.md and (10.26) as functions of kappa, and the region of stable motions.

    Returns "csv": columns series ("fold", "symmetry breaking", "penetration", "printed"), kappa, C, where C is in
    C_range; and "outline", the outline of the region of stable motions within the walls: columns kappa, C.

    Raises
    ------
    ValueError
        If C_range does not contain the stable region and the limit (10.26).
    """
    lowest, highest = C_range
    kappa = np.clip(np.linspace(0.0, 1.0, 401), KAPPA_MARGIN, 1 - KAPPA_MARGIN)
    limits = {
        "fold": lower_limit(kappa),
        "symmetry breaking": np.broadcast_to(upper_limit(kappa), kappa.shape),
        "penetration": np.array([largest_C(k) for k in kappa]),
        "printed": printed_limit(rho(kappa)),
    }
    ends = limits["printed"].min(), limits["symmetry breaking"].max()
    if not (lowest <= ends[0] and ends[1] <= highest):
        raise ValueError(f"C_range: {C_range} does not contain the limits of stability, {ends[0]} to {ends[1]}")
    top = np.minimum(limits["symmetry breaking"], limits["penetration"])
    lines = pd.concat(pd.DataFrame({"series": name, "kappa": kappa, "C": C}) for name, C in limits.items())
    outline = {"kappa": np.append(kappa, kappa[::-1]), "C": np.append(limits["fold"], top[::-1])}
    return {"csv": lines[lines["C"] <= highest], "outline": pd.DataFrame(outline)}


@styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`: stable region shaded, its limits solid, penetration dashed, (10.26) dotted."""
    figure = new_figure(SINGLE_COLUMN, 62.0)
    axes = figure.add_subplot()
    axes.fill(*tables["outline"].to_numpy().T, facecolor=LIGHT_GREY, edgecolor="none", zorder=0)
    for series, style in LIMITS.items():
        line = tables["csv"].query("series == @series")
        axes.plot(line["kappa"], line["C"], **style)
        name, kappa, offset, side = NAMES[series]
        at = (kappa, np.interp(kappa, line["kappa"], line["C"]))
        axes.annotate(name, at, offset, textcoords="offset points", fontsize=10, ha=side, va="center")
    axes.text(0.6, 1.35, "stable", ha="center", fontsize=10)
    lowest, highest = np.floor(10 * tables["csv"]["C"].min()) / 10 - 0.1, tables["csv"]["C"].max()
    axes.set(xlim=(0.0, 1.0), ylim=(lowest, round(highest, 1)), xlabel=r"$\kappa$", ylabel="$C_i$")
    return figure
