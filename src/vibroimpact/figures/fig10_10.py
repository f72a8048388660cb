"""Figure 10.10: a fixed point on both planes of the slow invariant manifold, and its theoretical response."""

import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.accuracy.model_choice import motion
from vibroimpact.figures import fig10_06, fig10_07
from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.figures.plotting.style import SINGLE_COLUMN, heading, new_figure, styled
from vibroimpact.tables import join

SPEC = {
    "title": "The only fixed point for weak forces, and its response",
    "notebook": "theoretical_response",
    "caption": r"Fig. 10.10. The only fixed point for :math:`\hat f_{10} = {f10_hat}`, :math:`\hat f_{20} = "
        "{f20_hat}` on both planes, and its theoretical response: boxes :math:`X_i` (dotted) and :math:`U_i = X_i + "
        r"\varepsilon Y_i` grey, balls :math:`Y_i` and :math:`W_i = X_i - Y_i` black. The point lies on the dashed "
        "branches, which (10.26) calls unstable; the exact motion is unstable, too.",
    "alt": "Above, two planes with the manifold and circles P1, P2 on its dashed left arms; below, the theoretical "
        "response of both modules over two forcing periods, grey U and X, black W and Y.",
    "own": "fig10_07",
    "equations": "fig10_07",
    "method": "leading order, (10.9) and (10.10), at a fixed point",
    "columns": {
        "panel": {"meaning": "label of the fixed point and module; for the response, the module"},
        "series": {"meaning": "as in figures 10.6 and 10.7"}, "C, B, tau": {"compared": "roots"},
        "value": {"meaning": "coordinate named in `series`: $U_i$, $X_i$, $W_i$ or $Y_i$ by (10.9), (10.10)",
            "unit": "dimensionless", "compared": "roots"},
    },
}  # fmt: skip


def compute(
    system, points: pd.DataFrame, fixed_point: str, periods: float, C_max, model: str = "slow_flow"
) -> pd.DataFrame:
    """Return the planes of figure 10.6 and the response of figure 10.7 for one fixed point.

    Returns columns panel, series, C, B, tau, value. Rows of the planes have numbers in the columns C and B. Rows of
    the response have numbers in the columns tau and value.

    Raises
    ------
    ValueError
        If `fig10_06.compute` or `fig10_07.compute` raises it.
    """
    point = motion(system, points, fixed_point, model).point
    return join(
        [
            *fig10_06.planes(system, [point], C_max),
            fig10_07.compute(system, points, fixed_point, periods, model),
        ]
    )


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: both planes side by side, and below them the responses of both modules."""
    figure = new_figure(SINGLE_COLUMN, 138.0)
    panels = figure.subplot_mosaic([[1, 2], ["module 1"] * 2, ["module 2"] * 2], height_ratios=(3, 4, 4))
    label, names = table["panel"].iloc[0][:-1], {}
    for module in fig10_06.MODULES:
        names |= fig10_06.draw_plane(panels[module], table, f"{label}{module}")
        panels[module].set_xlabel(f"$C_{module}$")
        heading(panels[module], words=f"fixed point ({label}), module {module}")
        names[panels[module]] += [(line.get_label(), [line]) for line in panels[module].lines[:2]]
        names |= fig10_07.draw_response(panels[f"module {module}"], table, module)
        words = f"theory, module {module}: {fig10_06.verdict(table, label)} by (10.26)"
        heading(panels[f"module {module}"], words=words)
    panels["module 1"].sharex(panels["module 2"])
    panels["module 1"].sharey(panels["module 2"])
    panels["module 1"].tick_params(labelbottom=False)
    panels["module 2"].set_xlabel(r"$\tau$")
    name_curves(figure, names, **fig10_06.NAME)
    return figure
