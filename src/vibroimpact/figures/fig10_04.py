"""Figure 10.4: the slow invariant manifold of the system."""

import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.plotting.manifold import branches, draw_branches
from vibroimpact.figures.plotting.markdown import EXACTLY
from vibroimpact.figures.plotting.style import BLACK, GREY, LEVEL, SINGLE_COLUMN, new_figure, styled
from vibroimpact.tables import curve, join, select
from vibroimpact.theory.manifold import B_min, rho
from vibroimpact.theory.masri import impact_multipliers, lower_limit, printed_limit, upper_limit

SPEC = {
    "title": "The slow invariant manifold",
    "notebook": "closed_form",
    "caption": "Fig. 10.4. Slow invariant manifold (SIM) with its stable branch (bold solid) and unstable branch "
        r"(dashed) by (10.26); dotted: :math:`B_{\min}` and :math:`C_{\min}`. Inset: the stable piece of the left arm, "
        "from the limit of (10.26) to the fold.",
    "alt": "V-shaped curve of B against C. Its rounded bottom touches the dotted level B_min at C_min. The left arm is "
        "dashed (unstable); the bottom and the right arm are bold (stable). An inset shows the bottom.",
    "equations": [
        r"B_i^2 = 1 - 2C_i + (1 + \rho^2)\,C_i^2, \qquad \rho = \frac{2(1-\kappa)}{\pi(1+\kappa)} \tag{10.16}",
        r"B_{\min} = \frac{\rho}{\sqrt{1+\rho^2}}, \qquad C_{\min} = \frac{1}{1+\rho^2} \tag{10.25}",
    ],
    "method": "closed form: (10.11), (10.16), (10.25), (10.26)",
    "columns": {
        "panel": {},
        "series": {"meaning": r"stable and unstable branch by (10.26), and the level $B_{\min}$ of (10.25)", "values": [
            "SIM stable", "SIM unstable", "B_min"]},
        "C, B": {"compared": "algebra"},
    },
}  # fmt: skip

INSET = (0.335, 0.43, 0.31, 0.38)


def compute(kappa: float, C_max: float) -> pd.DataFrame:
    """Return the manifold B(C), (10.16), for 0 <= C <= C_max, and the level B_min of its fold, (10.25).

    Returns columns panel, series, C, B. The series are "SIM stable", "SIM unstable" and "B_min". The
    condition (10.26) decides which branch of the manifold is stable.

    Raises
    ------
    ValueError
        If C_max is not above C_min, the value of C at the fold.
    """
    level = curve("SIM", "B_min", C=[0.0, C_max], B=B_min(rho(kappa)))
    return join([*branches("SIM", kappa, C_max), level])


def key_points(table: pd.DataFrame) -> pd.DataFrame:
    """Return C and B at the border of stability and at the lowest point of the manifold."""
    stable = select(table, "SIM", "SIM stable")[["C", "B"]]
    points = stable.loc[[stable["C"].idxmin(), stable["B"].idxmin()]]
    return points.set_axis(["border of stability, (10.26)", "fold (C_min, B_min), (10.25)"])


def exact(kappa: float, C_max: float) -> str:
    """Return a text in Markdown on the exact impact map at the stability limit (10.26)."""
    border, low, high = printed_limit(rho(kappa)), lower_limit(kappa), upper_limit(kappa)
    growth = abs(impact_multipliers(border, kappa)).max()
    return (
        f"{EXACTLY} with prescribed box motion, small disturbances at the border of (10.26), $C = {border:.3f}$, are "
        f"multiplied by **{growth:.2f}** from impact to impact. They decay only for ${low:.3f} < C < {high:.3f}$."
    )


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: stable branch bold, unstable branch dashed, B_min and C_min dotted.

    The inset shows the manifold from the stability limit (10.26) to the fold.
    """
    figure = new_figure(SINGLE_COLUMN, 66.0)
    axes = figure.add_subplot()
    stable, (C_max, B_level) = select(table, "SIM", "SIM stable"), select(table, "SIM", "B_min")[["C", "B"]].iloc[-1]
    border, fold = stable["C"].iloc[0], stable["C"].loc[stable["B"].idxmin()]
    axes.set(xlim=(0.0, C_max), ylim=(0.0, 1.06 * table["B"].max()), xlabel="$C_i$", ylabel="$B_i$")
    inset = axes.inset_axes(INSET, xlim=(2 * border - fold, 2 * fold - border), ylim=(0.8 * B_level, 1.5 * B_level))
    inset.set(xticks=[], yticks=[])
    for one in (axes, inset):
        draw_branches(one, table, "SIM")
        one.plot([0.0, C_max], [B_level, B_level], **LEVEL)
        one.plot([fold, fold], [0.0, B_level], **LEVEL)
        one.plot(border, stable["B"].iloc[0], "|", color=BLACK, markersize=9, markeredgewidth=1.2)
    above = {"xytext": (0.5, 1.06), "textcoords": "axes fraction", "ha": "center"}
    leader = {"arrowstyle": "-", "linewidth": 0.5}
    inset.annotate(f"limit of (10.26): {border:.3f}", (border, stable["B"].iloc[0]), arrowprops=leader, **above)
    axes.indicate_inset_zoom(inset, edgecolor=GREY)
    axes.annotate(r"$B_{\min}$", (0.0, B_level), (6, 4), textcoords="offset points", fontsize=10)
    axes.annotate(r"$C_{\min}$", (fold, 0.0), (3, 3), textcoords="offset points", fontsize=10)
    axes.legend(loc="upper center", reverse=True, ncols=2)
    return figure
