"""Companion to figure 10.5: where the motion with two impacts per cycle exists and is stable, for every kappa."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.kit.style import BLACK, LEVEL, LIGHT_GREY, SINGLE_COLUMN, UNSTABLE, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join, select
from vibroimpact.theory.manifold import largest_C, rho
from vibroimpact.theory.masri import lower_limit, printed_limit, upper_limit

SPEC = {
    "title": "Stability regions as derived",
    "caption": "Companion of Fig. 10.5. The region where the motion exists and is stable (shaded), as derived; dashed: "
        "where the ball leaves the box; dotted: the printed limit (10.26).",
    "alt": "Plane of kappa and C. The shaded region of stable motion lies between the curve C_min and a horizontal "
        "line, cut off at small kappa by the dashed limit at which the ball leaves the box. The printed limit is "
        "dotted, below the region.",
    "equations": [r"p\cot p = \frac{1}{1+\kappa}, \qquad \frac{1}{C_{\mathrm g}} = 1 - "
        r"\frac{2p}{\pi}\big(1+\kappa\cot^2p\big)"],
    "method": "closed form: (10.26), limits of Masri's analysis; penetration as a root",
    "columns": {
        "panel": {},
        "series": {"meaning": r"outline of the stable region; lines of $C_{\min}$, of $\pi^2/(\pi^2 - 4)$, of the $C$ "
            "at which the ball grazes the wall that it has left, and of (10.26); ends of the axes", "values": ["stable",
            "fold", "symmetry breaking", "penetration", "printed", "range"]},
        "kappa, C": {"compared": "algebra"},
    },
}  # fmt: skip

BORDER = {"color": BLACK, "linewidth": 1.0, "linestyle": "-"}
LIMITS = {"fold": BORDER, "symmetry breaking": BORDER, "penetration": UNSTABLE, "printed": LEVEL}
NAMES = {
    "fold": ("$C_{\\min}$", 0.3, (6, 7), "left"),
    "symmetry breaking": (r"$\pi^2/(\pi^2-4)$: symmetry breaks", 0.62, (0, 6), "center"),
    "printed": ("(10.26)", 0.4, (5, -10), "left"),
}
"""By limit: its name in the figure, the kappa where it stands, its distance from the line in points, and its side."""
END = 1e-9
"""Distance from kappa = 0 and 1, where the impact law ends."""


def compute(C_range: tuple[float, float]) -> pd.DataFrame:
    """The limits of docs/stability.md and of (10.26) over kappa, and the region between, for C in C_range.

    Returns columns panel ("regions"), series ("stable": outline of the region of stable motions within the walls;
    "fold", "symmetry breaking", "penetration", "printed": lines), kappa, C; lines stop where they leave C_range.

    Raises:
        ValueError: C_range does not hold all of the stable region and of (10.26).
    """
    lowest, highest = C_range
    kappa = np.clip(np.linspace(0.0, 1.0, 401), END, 1 - END)
    limits = {
        "fold": lower_limit(kappa),
        "symmetry breaking": upper_limit(kappa),
        "penetration": np.array([largest_C(k) for k in kappa]),
        "printed": printed_limit(rho(kappa)),
    }
    if not (lowest <= limits["printed"].min() and limits["symmetry breaking"].max() <= highest):
        raise ValueError(f"C_range: {C_range} does not hold the limits of stability")
    top = np.minimum(limits["symmetry breaking"], limits["penetration"])
    outline = np.append(kappa, kappa[::-1]), np.append(limits["fold"], top[::-1])
    shown = {series: values <= highest for series, values in limits.items()}
    return join(
        [curve("regions", "stable", kappa=outline[0], C=outline[1])]
        + [curve("regions", series, kappa=kappa[shown[series]], C=C[shown[series]]) for series, C in limits.items()]
        + [curve("regions", "range", kappa=[0.0, 1.0], C=C_range)]
    )


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: stable shaded, limits solid, no motion beyond the dashed line, (10.26) dotted."""
    figure = new_figure(SINGLE_COLUMN, 66.0)
    axes = figure.add_subplot()
    outline = select(table, "regions", "stable")
    axes.fill(outline["kappa"], outline["C"], facecolor=LIGHT_GREY, edgecolor="none", zorder=0)
    for series, style in LIMITS.items():
        line = select(table, "regions", series)
        axes.plot(line["kappa"], line["C"], **style)
        if series in NAMES:
            name, kappa, offset, side = NAMES[series]
            at = (kappa, np.interp(kappa, line["kappa"], line["C"]))
            axes.annotate(name, at, offset, textcoords="offset points", fontsize=10, ha=side, linespacing=1.0)
    axes.text(0.62, 1.3, "stable", ha="center")
    leader = {"arrowstyle": "-", "linewidth": 0.5, "shrinkA": 0, "shrinkB": 0, "relpos": (0.1, 0)}
    above = {"xytext": (0.0, 1.03), "textcoords": "axes fraction", "fontsize": 10, "arrowprops": leader}
    axes.annotate("the ball would leave the box", (0.05, 1.98), **above)  # the region there is too narrow for the words
    frame = select(table, "regions", "range")
    axes.set(xlim=frame["kappa"], ylim=frame["C"], xlabel=r"$\kappa$", ylabel="$C_i$")
    return figure
