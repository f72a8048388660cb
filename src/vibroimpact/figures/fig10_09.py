"""Figure 10.9: fixed points and singular points for unequal forces, in the form of figure 10.6."""

import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures import fig10_06
from vibroimpact.figures.fig10_06 import compute
from vibroimpact.tables import select

SPEC = {
    "title": "Fixed points for unequal forces",
    "notebook": "fixed_points",
    "caption": r"Fig. 10.9. Fixed points for :math:`\hat f_{10} = {f10_hat}`, :math:`\hat f_{20} = {f20_hat}`, drawn "
        "as in Fig. 10.6. The squares are our assumption: the chapter mentions them for Fig. 10.6 only. The chapter "
        "calls a and b unstable, c stable. The headings give the verdicts of (10.26), and both verdicts where they "
        "differ. Both projections of b lie on the branch that (10.26) as printed calls stable. So the chapter's own "
        "figure cannot use the printed limit, :math:`C_i = 0.904`; its limit must lie above 0.957.",
    "alt": "Three rows, a to c, of two planes, C1 and B1, C2 and B2, as in figure 10.6; most circles have moved down "
        "towards the fold of the manifold.",
    "own": "fig10_06",
    "equations": "fig10_06",
    "method": "manifold in closed form, singular points as real zeros of (10.24)",
    "columns": "fig10_06",
}  # fmt: skip

__all__ = ["compute", "draw"]

CHAPTER = {"a": "unstable", "b": "unstable", "c": "stable"}
"""Verdicts by label, from the chapter's caption of Fig. 10.9."""
PLACE_OF_B = {"b1": 0.957, "b2": 1.665}
"""C of fixed point b at the chapter's parameters, by plane. The verdicts of CHAPTER apply only to these parameters."""


def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute` as in figure 10.6.

    At the chapter's parameters, the heading of a fixed point also shows the chapter's verdict if (10.26) gives another
    verdict.
    """
    found = [abs(select(table, plane, f"P_{plane[1]}")["C"] - C) < 1e-3 for plane, C in PLACE_OF_B.items()]
    return fig10_06.draw(table, CHAPTER if all(len(near) and near.all() for near in found) else {})
