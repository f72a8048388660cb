"""Figure 10.6: fixed points and singular points on the slow invariant manifold."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from vibroimpact.accuracy.model_choice import motions
from vibroimpact.figures.plotting.manifold import branches, draw_branches
from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.figures.plotting.style import (
    BLACK,
    GREY,
    SINGLE_COLUMN,
    STABLE,
    UNSTABLE,
    heading,
    new_figure,
    styled,
)
from vibroimpact.tables import curve, join, select
from vibroimpact.theory.fixed_points.balance import singular_points
from vibroimpact.theory.fixed_points.table import labelled_points

SPEC = {
    "title": "Fixed points for equal forces",
    "notebook": "fixed_points",
    "caption": r"Fig. 10.6. Fixed points for :math:`\hat f_{10} = {f10_hat}`, :math:`\hat f_{20} = {f20_hat}` on the "
        "SIM: projections :math:`P_1`, :math:`P_2` (black circles) and singular points :math:`S_1`, :math:`S_2` "
        "(grey squares), one row per fixed point. The branch that (10.26) calls stable is bold solid, the other "
        "dashed. Lower right: :math:`C_i` of singular points outside the frame, or that there are none. Headings: "
        "verdicts of (10.26), which agree with the chapter. They concern the impacts only: the exact motion of a "
        "point called stable may be unstable.",
    "alt": "Three rows, a to c, of two planes, C1 and B1, C2 and B2, with the V-shaped manifold, its left arm dashed "
        "and its right arm bold. Black circles P1, P2 mark the fixed point of the row, grey squares S1, S2 the "
        "singular points; row b names an S2 beyond the frame, and row a has no S2.",
    "own": {
        "title": "Fixed points of case {case}",
        "caption": r"Fixed points of case *{case}*, :math:`\hat f_{10} = {f10_hat}`, :math:`\hat f_{20} = {f20_hat}`, "
            "on the SIM: projections :math:`P_1`, :math:`P_2` (black circles) and singular points :math:`S_1`, "
            ":math:`S_2` (grey squares), one row per fixed point. Lower right: :math:`C_i` of singular points outside "
            "the frame, or that there are none. Headings: verdicts of (10.26), which judges the "
            "impacts alone.",
        "alt": "A row for each fixed point of case {case}, of two planes, C1 and B1, C2 and B2, with the V-shaped "
            "manifold, its left arm dashed and its right arm bold. Black circles P1, P2 mark the fixed point of the "
            "row, grey squares S1, S2 the singular points.",
    },
    "equations": [
        r"h_{B_1}^* = h_{\psi_1}^* = h_{B_2}^* = h_{\psi_2}^* = 0 \tag{10.23}",
        r"h_1(B_1, C_1, B_2, C_2) = 0, \quad h_2(B_1, C_1, B_2, C_2) = 0 \tag{10.24}",
    ],
    "method": "manifold in closed form, singular points as real zeros of (10.24)",
    "columns": {
        "panel": {"meaning": "label of the fixed point and module: a1, a2, ..."},
        "series": {"meaning": "both branches of the manifold by (10.26), the projection P_i of the fixed point, and "
            'singular points S_i of (10.24); "beyond": those outside the frame'},
        "C, B": {"compared": "roots"},
    },
}  # fmt: skip

MODULES = (1, 2)
NAME = {"fontsize": 10, "color": BLACK}
ZOOM = {"xlim": (0.85, 1.25), "ylim": (0.0, 0.34)}
"""Part of a plane around the fold; if this part contains several points, it is drawn enlarged in INSET."""
INSET = (0.13, 0.45, 0.44, 0.52)
KEY = "fixed point $P_i$", "singular point $S_i$", "stable by (10.26)", "unstable by (10.26)"
ROW_HEIGHT, MARGINS = 38.0, 23.0
"""Height in mm of one row of planes, and of all headings and labels together."""
MARKERS = {
    "S": {"marker": "s", "color": "0.3", "markersize": 4.6, "markerfacecolor": "0.75", "markeredgewidth": 0.7},
    "P": {"marker": "o", "color": BLACK, "markersize": 4.2, "markeredgecolor": "white", "markeredgewidth": 0.4},
}
"""Markers of the points S_i and P_i, in drawing order: circles are drawn above the larger squares."""


def compute(system, points: pd.DataFrame, C_max, model: str = "slow_flow") -> pd.DataFrame:
    """Return the manifold with points P_i and S_i on the planes (C_1, B_1) and (C_2, B_2).

    The points P_i are projections of the fixed points. The singular points S_i solve (10.24).

    Parameters
    ----------
    points : DataFrame
        Fixed points of the case, columns label, C1, C2, B1, B2, psi1, psi2.
    model : str, default 'slow_flow'
        slow_flow or exact_orbit. With exact_orbit, P_i and S_i are computed from the exact orbits next to the fixed
        points. A fixed point without an exact orbit next to it is left out.
    C_max
        One number, or one number per module. The axis C_i ends at C_max or at 1.1 times the largest C_i of all fixed
        points, whichever is larger.

    Returns columns panel (label and module, such as "a1"), series, C, B. The series are "SIM stable", "SIM unstable",
    "P_i", "S_i", and "S_i beyond" for singular points outside the planes. Without fixed points the planes show the
    manifold alone.

    Raises
    ------
    ValueError
        If C_max is not beyond the fold of the manifold, or if the model is unknown.
    """
    found = motions(system, labelled_points(points), model)
    return join(planes(system, [motion.point for motion in found], C_max))


def planes(system, points, C_max) -> list[pd.DataFrame]:
    """Return the table of `compute` in parts.

    Each part is one curve, or one set of points, in one plane.
    """
    ends = np.fmax.reduce([np.broadcast_to(C_max, 2), *(1.1 * point.C for point in points)])
    if not points:
        return [branch for i in MODULES for branch in branches(str(i), system.kappa, ends[i - 1])]
    return [part for point in points for i in MODULES for part in _plane(system, point, i, ends[i - 1])]


def _plane(system, point, module, end):
    panel = f"{point.label}{module}"
    C, B = point.C[module - 1], point.B[module - 1]
    singular = singular_points(system, point, module)
    inside = singular[:, 0] <= end
    return [
        *branches(panel, system.kappa, end),
        *([curve(panel, f"P_{module}", C=C, B=B)] if module in system.modules else []),
        *(
            curve(panel, series, C=part[:, 0], B=part[:, 1])
            for series, part in ((f"S_{module}", singular[inside]), (f"S_{module} beyond", singular[~inside]))
        ),
    ]


@styled
def draw(table: pd.DataFrame, chapter: dict[str, str] | None = None) -> Figure:
    """Draw the table of `compute`: one row per fixed point, P_i as black circles, S_i as grey squares.

    Parameters
    ----------
    chapter : dict, optional
        Verdict of the chapter on each fixed point, keyed by the label of the point. The heading of a fixed point shows
        the chapter's verdict if (10.26) gives another verdict.
    """
    labels = list(dict.fromkeys(panel[:-1] for panel in table["panel"]))
    figure = new_figure(SINGLE_COLUMN, ROW_HEIGHT * len(labels) + MARGINS)
    grid = figure.subplots(len(labels), len(MODULES), sharex="col", sharey=True, squeeze=False)
    names = {}
    for row, label in zip(grid, labels, strict=True):
        by_limit, printed = verdict(table, label), (chapter or {}).get(label)
        agree = printed in (None, by_limit)
        words = f"{by_limit} by (10.26)" if agree else f"chapter {printed}, (10.26) {by_limit}"
        heading(row[0], words=f"fixed point ({label}): {words}" if by_limit else "")
        for axes, module in zip(row, MODULES, strict=True):
            names |= draw_plane(axes, table, f"{label}{module}")
            if by_limit and (outside := singular_points_outside(table, f"{label}{module}")):
                corner = {"textcoords": "offset points", "ha": "right", "va": "bottom", "linespacing": 0.9}
                axes.annotate(outside, (1, 0), (-4, 3), "axes fraction", **corner, **NAME)
    for axes, module in zip(grid[0], MODULES, strict=True):
        axes.set_title(f"module {module}\n", pad=4)  # the line break puts this title above the heading of the row
    for axes, module in zip(grid[-1], MODULES, strict=True):
        axes.set_xlabel(f"$C_{module}$")
    handles = [Line2D([], [], linestyle="none", **MARKERS[kind]) for kind in "PS"]
    handles += [Line2D([], [], **look) for look in (STABLE, UNSTABLE)]
    figure.legend(handles, KEY, loc="outside lower center", ncols=2)
    name_curves(figure, names, **NAME)
    return figure


def verdict(table: pd.DataFrame, label: str) -> str:
    """Return the verdict of (10.26) on a fixed point, or "" if `table` does not contain the point.

    The verdict is "stable" if P_i lies on the stable branch for each active module, else "unstable". A module is active
    if a force drives it, directly or through the coupling.
    """
    beyond = [
        select(table, f"{label}{module}", "SIM stable")["C"].min() < C
        for module in MODULES
        for C in select(table, f"{label}{module}", f"P_{module}")["C"]
    ]
    return "" if not beyond else "stable" if all(beyond) else "unstable"


def singular_points_outside(table: pd.DataFrame, panel: str) -> str:
    """Return a text with the C_i of all singular points outside the frame of a panel, or "" if all are inside.

    The text is "no S_i" if the panel has no singular points.
    """
    name = f"S_{panel[-1]}"
    beyond = select(table, panel, f"{name} beyond")["C"]
    if len(beyond):
        return rf"${name}\,\rightarrow$" f"\nat $C_{panel[-1]} = {', '.join(f'{C:.1f}' for C in beyond)}$"
    return "" if len(select(table, panel, name)) else f"no ${name}$"


def draw_plane(axes, table: pd.DataFrame, panel: str) -> dict:
    """Draw the plane (C_i, B_i) of one panel, and return the names of the points.

    The result is a dict for the argument `panels` of `name_curves`. The keys are axes, and the values are lists of
    pairs. A pair contains the name of a point, and a list with the Line2D object of this point.
    """
    module = panel[-1]
    end = select(table, panel, "SIM stable")["C"].iloc[-1]
    top = table["B"][table["series"].str.startswith("SIM")].max()
    # Round the end of the axis, since a rounding error in it can change Matplotlib's ticks.
    axes.set(xlim=(0.0, round(end, 9)), ylim=(0.0, 1.08 * top), ylabel=f"$B_{module}$")
    axes.locator_params(nbins=4, steps=[1, 2, 5, 10])
    points = [
        (kind, C, B) for kind in MARKERS for C, B in select(table, panel, f"{kind}_{module}")[["C", "B"]].to_numpy()
    ]
    close = [point for point in points if ZOOM["xlim"][0] < point[1] < ZOOM["xlim"][1]]
    panes = {axes: points}
    if len(close) > 1:
        inset = axes.inset_axes(INSET, xticks=[], yticks=[], **ZOOM)
        axes.indicate_inset((*np.transpose([*ZOOM.values()])[0], *np.ptp([*ZOOM.values()], axis=1)), edgecolor=GREY)
        panes[inset] = close
    names = {}
    for pane, shown in panes.items():
        draw_branches(pane, table, panel)
        lines = [(point, pane.plot(*point[1:], linestyle="none", zorder=3, **MARKERS[point[0]])) for point in shown]
        own = [one for one in lines if pane is not axes or len(panes) == 1 or one[0] not in close]
        names[pane] = [(f"${kind}_{module}$", line) for (kind, _, _), line in own]
    return names
