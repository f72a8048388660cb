"""Figure 10.5: stable and unstable regions for the vibro-impact system."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.plotting.markdown import EXACTLY
from vibroimpact.figures.plotting.style import BLACK, LEVEL, LIGHT_GREY, SINGLE_COLUMN, new_figure, styled
from vibroimpact.tables import curve, join, select
from vibroimpact.theory.manifold import C_min, rho
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C, impact_multipliers, printed_limit

SPEC = {
    "title": "Stability regions as printed",
    "notebook": "closed_form",
    "caption": r"Fig. 10.5. Stable (shaded) and unstable (white) regions on the plane :math:`(\kappa, C_i)` by "
        r"(10.26); dotted: :math:`C_{\min}(\kappa)`.",
    "alt": "Plane of kappa and C, divided by a rising line: shaded (stable) above, white (unstable) below. The dotted "
        "curve C_min of kappa lies in the shaded region and meets the line at kappa = 1.",
    "equations": [r"C_i > \frac{4}{4 + \pi\rho} \tag{10.26}"],
    "method": "closed form: (10.11), (10.16), (10.25), (10.26)",
    "columns": {
        "panel": {},
        "series": {"meaning": r"outlines of the regions of (10.26), and the line $C_{\min}(\kappa)$ of (10.25)",
            "values": ["stable", "unstable", "C_min"]},
        "kappa, C": {"compared": "algebra"},
    },
}  # fmt: skip

REGIONS = {"stable": LIGHT_GREY, "unstable": "white"}


def compute(C_range: tuple[float, float]) -> pd.DataFrame:
    """Return the stable and unstable regions of the plane (kappa, C), and the fold C_min(kappa) of (10.25).

    The regions are those of (10.26) for 0 <= kappa <= 1 and for C in C_range.

    Returns columns panel, series, kappa, C. The series "stable" and "unstable" are the outlines of the regions. The
    series "C_min" is the fold.

    Raises
    ------
    ValueError
        If C_range does not contain the whole border between the regions.
    """
    lowest, highest = C_range
    kappa = np.linspace(0.0, 1.0, 201)
    limit = printed_limit(rho(kappa))
    if not (lowest < limit.min() and limit.max() < highest):
        ends = f"from {limit.min()} to {limit.max()}"
        raise ValueError(f"C_range: {C_range} does not contain all limits C of (10.26), which range {ends}")
    around = np.append(kappa, [1.0, 0.0])
    return join(
        [
            curve("regions", "stable", kappa=around, C=np.append(limit, [highest, highest])),
            curve("regions", "unstable", kappa=around, C=np.append(limit, [lowest, lowest])),
            curve("regions", "C_min", kappa=kappa, C=C_min(rho(kappa))),
        ]
    )


def key_points(table: pd.DataFrame) -> pd.DataFrame:
    """Return a table with one row for each of six evenly spaced kappa.

    The columns are kappa, border (the limit of C from (10.26)), C_min, and stable_left_arm (C_min minus border).
    """
    fold = select(table, "regions", "C_min")["C"].to_numpy()
    border = select(table, "regions", "stable").iloc[: len(fold)]
    rows = np.linspace(0, len(fold) - 1, 6).astype(int)
    points = pd.DataFrame({"kappa": border["kappa"].to_numpy(), "border": border["C"].to_numpy(), "C_min": fold})
    return points.assign(stable_left_arm=points["C_min"] - points["border"]).iloc[rows].reset_index(drop=True)


def exact(C_range: tuple[float, float]) -> str:
    """Return a text in Markdown on the exact impact map at the stability limit (10.26)."""
    kappa = np.linspace(0.0, 1.0, 201)
    growth = max(abs(impact_multipliers(printed_limit(rho(k)), k)).max() for k in kappa)
    return (
        f"{EXACTLY} with prescribed box motion, small disturbances at the border of (10.26) are multiplied by up to "
        f"**{growth:.2f}** from impact to impact. They decay only between the dotted line $C_{{\\min}}(\\kappa)$ and "
        f"$C = {SYMMETRY_BREAKING_C:.3f}$, for every $\\kappa$."
    )


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: stable shaded, unstable white, C_min dotted."""
    figure = new_figure(SINGLE_COLUMN, 56.0)
    axes = figure.add_subplot()
    for series, colour in REGIONS.items():
        outline = select(table, "regions", series)
        axes.fill(outline["kappa"], outline["C"], facecolor=colour, edgecolor=BLACK, linewidth=1.0, zorder=0)
    fold = select(table, "regions", "C_min")
    axes.plot(fold["kappa"], fold["C"], **LEVEL)
    axes.annotate(
        r"$C_{\min}(\kappa)$",
        fold[["kappa", "C"]].iloc[len(fold) // 3],
        (-4, 3),
        textcoords="offset points",
        ha="right",
        fontsize=10,
    )
    border = select(table, "regions", "stable")[["kappa", "C"]].iloc[len(fold) * 2 // 3]
    axes.annotate("(10.26)", border, (4, -4), textcoords="offset points", va="top", fontsize=10)
    for name, height, side in (("stable", 0.97, "top"), ("unstable", 0.05, "bottom")):
        axes.text(0.5, height, name, transform=axes.transAxes, ha="center", va=side)
    axes.set(xlim=(0.0, 1.0), ylim=(table["C"].min(), table["C"].max()), xlabel=r"$\kappa$", ylabel="$C_i$")
    return figure
