"""Companion on stability: four criteria side by side on every fixed point and orbit of each case."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from vibroimpact.figures.kit.style import (
    BLACK,
    DOUBLE_COLUMN,
    GREY,
    LEVEL,
    LIGHT_GREY,
    letter_panel,
    new_figure,
    side_by_side,
    styled,
)
from vibroimpact.figures.kit.tables import curve, join, select
from vibroimpact.system.verdict import STABLE, UNDECIDED, UNSTABLE, all_stable
from vibroimpact.theory.manifold import rho
from vibroimpact.theory.masri import lower_limit, printed_limit, upper_limit

SPEC = {
    "title": "Four criteria side by side",
    "caption": "Fixed points and exact orbits of the three cases, filled where they are stable: fixed points by "
        "Masri's analysis and the slow flow, orbits by their multipliers. The region that Masri's analysis allows is "
        "shaded, that of (10.26) lies to the upper right of the dotted lines; lines join fixed points to the orbits "
        "that continue them. In a ring: a verdict of the theory that the exact orbit refutes. The table has each of "
        "the four criteria.",
    "alt": "Three panels, one per case: the plane of C1 and C2 with the stable region shaded and fixed points joined "
        "to their exact orbits, black for stable and white for unstable, in a ring where the exact orbit refutes the "
        "theory.",
    "method": "verdicts and places as computed, limits in closed form",
    "columns": {
        "panel": {"meaning": "the case"},
        "series": {"meaning": "fixed points, exact orbits that are motions of the system, links from one to the other, "
            "and lower left and upper right corner of the region that (10.26) (\"printed\") and Masri's analysis "
            '("stable") allow', "values": ["fixed point", "symmetric", "asymmetric", "link", "printed", "stable"]},
        "label": {"meaning": "label of the fixed point or orbit, as in `fixed_points.csv` and `orbits.csv`; blank for "
            "links and corners", "unit": "text"},
        "C1, C2": {"compared": "roots", "infinite": True}, "printed_10_26, masri_derived, slow_flow, floquet": {},
    },
}  # fmt: skip

CRITERIA = ["printed_10_26", "masri_derived", "slow_flow", "floquet"]
"""The columns of the published table; `fixed_points.csv` calls the last three fast, slow and exact."""
FACES = {STABLE: BLACK, UNSTABLE: "white", UNDECIDED: GREY}
KINDS = {"fixed point": "o", "symmetric": "s", "asymmetric": "D"}
"""Markers: a fixed point of the theory, an exact orbit of either kind."""
NAMES = {"fixed point": "fixed point", "symmetric": "symmetric orbit", "asymmetric": "asymmetric orbit"}
RING = {"marker": "o", "linestyle": "none", "color": BLACK, "markerfacecolor": "none", "markersize": 8.6}
RING |= {"markeredgewidth": 0.9, "label": "the orbit says otherwise"}
PLANE, FRAME = 58.0, 18.0
"""Heights in mm: a plane, everything around it."""


def compute(systems: dict, points: pd.DataFrame, orbits: pd.DataFrame) -> pd.DataFrame:
    """Verdicts and places of all fixed points and admissible orbits, and the limits of each case.

    Args:
        systems: the System of each case, in the order of the panels.
        points, orbits: columns case, label, C1, C2 and one per criterion; orbits also symmetric and admissible, points
            also orbit (`companion_verdicts`).

    Returns columns panel (the case), series ("fixed point", "symmetric", "asymmetric"; "link": from a fixed point to
    its orbit; "printed", "stable": lower left and upper right corner of the region that (10.26), Masri's analysis
    allows), label, C1, C2, one per criterion.
    """
    motions = orbits[orbits["admissible"].astype(bool)].astype({"symmetric": bool})
    parts = []
    for case, system in systems.items():
        here, exact = points[points["case"] == case], motions[motions["case"] == case]
        parts += [
            _rows(case, "fixed point", here),
            _rows(case, "symmetric", exact[exact["symmetric"]]),
            _rows(case, "asymmetric", exact[~exact["symmetric"]]),
            *_links(case, here, exact),
        ]
        corners = {
            "printed": [printed_limit(rho(system.kappa)), np.inf],
            "stable": [lower_limit(system.kappa), upper_limit(system.kappa)],
        }
        parts += [curve(case, series, C1=corner, C2=corner) for series, corner in corners.items()]
    columns = ["panel", "series", "label", "C1", "C2", *CRITERIA]
    return join(part for part in parts if len(part)).reindex(columns=columns)


def _rows(case, series, rows):
    return rows[["label", "C1", "C2", *CRITERIA]].assign(panel=case, series=series)


def _links(case, points, orbits):
    both = points.merge(orbits, left_on="orbit", right_on="label", suffixes=("", "_exact"))
    return [
        curve(case, "link", C1=[row["C1"], row["C1_exact"]], C2=[row["C2"], row["C2_exact"]])
        for _, row in both.iterrows()
    ]


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: per case the plane (C_1, C_2); stable black, unstable white, in a ring where the
    multipliers of the exact orbit say otherwise.
    """
    cases = list(dict.fromkeys(table["panel"]))
    columns, rows = side_by_side(len(cases))
    figure = new_figure(DOUBLE_COLUMN, rows * PLANE + FRAME)
    planes = figure.subplots(rows, columns, squeeze=False).ravel()
    places = table[["C1", "C2"]].to_numpy(float)
    end = 1.1 * places[np.isfinite(places)].max()
    for axes in planes[len(cases) :]:
        axes.set_axis_off()
    for case, plane in zip(cases, planes, strict=False):
        letter_panel(plane, case)
        _draw_plane(plane, table, case, end)
    figure.legend(handles=_key(table), loc="outside lower center", ncols=6, fontsize=8.5)
    return figure


def _motions(table, case):
    return table[(table["panel"] == case) & table["series"].isin(KINDS)]


def _draw_plane(axes, table, case, end):
    """The plane (C_1, C_2): region of Masri's analysis shaded, that of (10.26) above the dotted lines."""
    low, high = select(table, case, "stable")["C1"]
    axes.fill([low, high, high, low], [low, low, high, high], facecolor=LIGHT_GREY, edgecolor="none", zorder=0)
    printed = select(table, case, "printed")["C1"].iloc[0]
    axes.plot([printed, printed, end], [end, printed, printed], **LEVEL, zorder=1)
    links = select(table, case, "link")[["C1", "C2"]].to_numpy().reshape(-1, 2, 2)
    for link in links:
        axes.plot(*link.T, color=BLACK, linewidth=0.6, zorder=2)
    for _, motion in _motions(table, case).iterrows():
        _mark(axes, (motion["C1"], motion["C2"]), motion, overall(motion))
        if motion["series"] == "fixed point":
            right = motion["C1"] < 0.2 * end  # away from the axis
            offset = {"xytext": (4 if right else -6, -9), "textcoords": "offset points", "fontsize": 8.5}
            offset["ha"] = "left" if right else "right"
            axes.annotate(f"({motion['label']})", (motion["C1"], motion["C2"]), **offset)
    axes.set(xlim=(0, end), ylim=(0, end), xlabel="$C_1$", ylabel="$C_2$", aspect="equal")


def overall(motion) -> str:
    """Return the exact verdict on an orbit, or that of the theory on a fixed point: both time scales stable."""
    if motion["series"] != "fixed point":
        return motion["floquet"]
    return all_stable((motion["masri_derived"], motion["slow_flow"]))


def _mark(axes, place, motion, verdict):
    """The marker of a motion with the face of a verdict, in a ring where the exact orbit refutes it."""
    if {verdict, motion["floquet"]} == {STABLE, UNSTABLE}:
        axes.plot(*place, **RING, zorder=3)
    axes.plot(*place, **_marker(motion["series"], verdict), zorder=3)


def _key(table):
    """Return handles of the key: shapes half filled, and fillings, as far as they occur, without shape."""
    occurring = set(table[list(CRITERIA)].to_numpy().ravel())
    either = {"fillstyle": "left", "markerfacecoloralt": "white"}
    kinds = [Line2D([], [], **_marker(series, STABLE) | either, label=name) for series, name in NAMES.items()]
    faces = [Patch(facecolor=FACES[name], edgecolor=BLACK, label=name) for name in FACES if name in occurring]
    return [*kinds, *faces, Line2D([], [], **RING)]


def _marker(series, verdict):
    return {
        "marker": KINDS[series],
        "linestyle": "none",
        "color": BLACK,
        "markerfacecolor": FACES[verdict],
        "markeredgewidth": 0.7,
        "markersize": 4.2,
    }
