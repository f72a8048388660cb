"""Companion: which regime starts end in over both forcing amplitudes, with the theory's borders drawn over it."""

from functools import cache

import numpy as np
import pandas as pd
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap, to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from scipy import ndimage

from vibroimpact.figures.kit.style import BLACK, DOUBLE_COLUMN, hatch_gaps, new_figure, styled
from vibroimpact.figures.kit.tables import curve, select
from vibroimpact.regimes.classification import (
    ASYMMETRIC,
    CHAOTIC,
    HOPPING,
    IDLE,
    NO_IMPACTS,
    OTHER,
    QUASI_PERIODIC,
    REGIMES,
    STRONGLY_MODULATED,
    SYMMETRIC,
    UNSETTLED,
)
from vibroimpact.sweeps.observations import FROM_REST, fixed_point_counts

SPEC = {
    "title": "Map of regimes over both forcing amplitudes",
    "caption": "Over the plane of both forcing amplitudes the regime that most of several starts end in, with a stroke "
        "where others coexist. Started from rest, which is not counted, a ball may stay idle. Dotted: the theory's "
        "number of fixed points changes; solid: that of the stable ones does; crosses: the cases.",
    "alt": "Map over the plane of f10 and f20 in patches of one colour for each class of regimes. Strongly modulated "
        "responses fill the middle and the lower left, other periodic ones the upper left and the right edge, "
        "asymmetric ones the upper middle, where a closed solid line encloses the forces for which the theory has a "
        "stable fixed point; chaos has an island below.",
    "method": "the points of a sweep, with the cases; borders of the theory by bisection",
    "sweeps": {"regime_map": {"along": [["f10_hat"], ["f20_hat"]], "evenly": True,
        "observe": ["regimes", "fixed_points"]}},
    "columns": {
        "panel": {"meaning": "map"},
        "series": {"meaning": "cell of the map, case of the config, or what changes on a border", "values": ["cell",
            "case", "fixed points", "stable points"]},
        "label": {"meaning": "regime that the start from rest ends in; name of the case; number of the straight piece "
            "of the border, whose two ends are two rows", "unit": "text", "compared": {"cell": "cells of a map"}},
        "f10_hat, f20_hat": {"compared": {"cell": "algebra", "case": "algebra", "others": "roots"}},
        "regime": {"meaning": "regime that most starts other than rest end in", "unit": "text", "compared": {
            "cell": "cells of a map"}},
        "coexisting": {"meaning": "number of regimes that starts other than rest settle in", "unit": "number",
            "compared": {"cell": "cells of a map"}},
        "symmetric, asymmetric, other periodic, strongly modulated, chaotic, hopping, quasi-periodic, one ball idle, "
        "no impacts, unsettled": {"compared": "cells of a map"},
        "fixed_points, stable_points": {"compared": "counts of a map"},
    },
}  # fmt: skip

BORDERS = {
    "fixed points": {"linestyles": (0, (1, 1)), "linewidths": 1.1},
    "stable points": {"linestyles": "solid", "linewidths": 1.6},
}
HALVINGS = 4
"""Halvings between two cells with different counts: the border is found to 1/32 of their distance."""
CLASSES = {
    "symmetric": ("#004488", (SYMMETRIC,)),
    "asymmetric": ("#7aa6d6", (ASYMMETRIC,)),
    "other periodic": ("#d5e7f2", (OTHER,)),
    "strongly modulated": ("#e8b84a", (STRONGLY_MODULATED,)),
    "chaotic": ("#994455", (CHAOTIC, HOPPING)),
    "quasi-periodic or unsettled": ("#848484", (QUASI_PERIODIC, IDLE, NO_IMPACTS, UNSETTLED)),
}
"""Classes drawn alike, in colours that differ in grey print: colour and regimes of each."""
TOGETHER = "coexisting"
NAMED_FROM = 20
"""A patch of so many cells or more bears the name of its class; the legend has the classes without one."""
_CASES = {"linestyle": "none", "marker": "x", "color": BLACK, "markersize": 6.0, "markeredgewidth": 1.4}
_STROKES = {"linestyle": "none", "marker": (2, 2, -45), "color": BLACK, "markersize": 8.0, "markeredgewidth": 0.8}
TICKS = 4
"""At most so many intervals between ticks: left to itself, the number would depend on the last digit of the limits."""


def compute(table: pd.DataFrame, system, systems: dict, starts: int) -> pd.DataFrame:
    """The map from the table of a sweep over f10_hat, then f20_hat, both evenly spaced.

    Args:
        system: of the sweep. systems: case -> system; those that differ from it in the forcing amplitudes alone are
            marked.
        starts: of each point, the first of them rest.

    Returns columns panel, series ("cell", "case", or what changes on a border), label (regime from rest; name
    of the case; number of the piece of the border), f10_hat, f20_hat, the share of each regime, fixed_points,
    stable_points, and what is drawn: the regime that most starts other than rest end in, and how many regimes they do.
    """
    cells = table.rename(columns={FROM_REST: "label"}).assign(series="cell")
    cells["regime"], cells[TOGETHER] = _dominant(cells, starts)
    forces = {case: {"f10_hat": one.f10_hat, "f20_hat": one.f20_hat} for case, one in systems.items()}
    marks = [
        {"label": case, "series": "case", **at} for case, at in forces.items() if systems[case] == system.with_(**at)
    ]
    marked = [pd.DataFrame(marks)] if marks else []
    borders = _borders(system, cells)
    table = pd.concat([cells, *marked, *borders], ignore_index=True).assign(panel="map")
    shown = ["label", "f10_hat", "f20_hat", "regime", TOGETHER, *REGIMES, "fixed_points", "stable_points"]
    return table[["panel", "series", *shown]]


def _dominant(cells, starts):
    """Return, for each cell, the regime of most starts other than rest, and the number of regimes they settle in."""
    counts = cells[[*REGIMES]].to_numpy(float) * starts
    if starts > 1:
        counts -= cells["label"].to_numpy()[:, None] == np.array(REGIMES)
    counts = np.where(np.isnan(counts), -1.0, counts.round())
    names = np.where(counts.max(axis=1) >= 0, np.array(REGIMES)[counts.argmax(axis=1)], None)
    settled = [number for number, name in enumerate(REGIMES) if name != UNSETTLED]
    return names, np.where(counts.max(axis=1) >= 0, (counts[:, settled] > 0).sum(axis=1), np.nan)


def _borders(system, cells):
    """Return where the counts of the theory change: pieces of lines between points found by halving."""

    @cache
    def counts(f10, f20):
        return fixed_point_counts(system.with_(f10_hat=f10, f20_hat=f20))

    for which, series in enumerate(BORDERS):
        square = _square(cells, series.replace(" ", "_"))

        @cache
        def crossing(first, second, which=which):
            (a, start), (b, _) = first, second
            low, high = np.array(a), np.array(b)
            for _ in range(HALVINGS):
                middle = (low + high) / 2
                low, high = (middle, high) if counts(*middle)[which] == start else (low, middle)
            return tuple((low + high) / 2)

        pieces = [piece for corners in _squares(cells, square) for piece in _pieces(corners, crossing)]
        if pieces:
            f10, f20 = np.array(pieces).reshape(-1, 2).T
            numbers = np.repeat(np.arange(len(pieces)) + 1, 2).astype(str)
            yield curve("map", series, f10_hat=f10, f20_hat=f20).assign(label=numbers)


def _squares(cells, square):
    """Return the centres of every four neighbouring cells, in order round the square, each with its count; gaps left
    out.
    """
    x, y = np.unique(cells["f10_hat"]), np.unique(cells["f20_hat"])
    for i, j in np.ndindex(len(y) - 1, len(x) - 1):
        around = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]
        if not np.isnan([square[place] for place in around]).any():
            yield [((float(x[n]), float(y[m])), square[m, n]) for m, n in around]


def _pieces(corners, crossing):
    """The border within a square: from side to side, or from each side to the middle where three or four parts meet."""
    sides = [sorted(pair) for pair in zip(corners, corners[1:] + corners[:1], strict=True) if pair[0][1] != pair[1][1]]
    ends = [crossing(first, second) for first, second in sides]
    if len(ends) == 2:
        return [ends]
    middle = tuple(np.mean(ends, axis=0)) if ends else None
    return [[end, middle] for end in ends]


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: a colour for each class of regimes, a stroke where several coexist; borders."""
    cells, cases = (select(table, "map", name) for name in ("cell", "case"))
    f10, f20 = np.unique(cells["f10_hat"]), np.unique(cells["f20_hat"])
    numbers = {name: n for n, (_, names) in enumerate(CLASSES.values()) for name in names}
    shown = _square(cells.assign(number=cells["regime"].map(numbers)), "number")
    figure = new_figure(DOUBLE_COLUMN, 104.0)
    axes = figure.add_subplot()
    colours = ListedColormap([colour for colour, _ in CLASSES.values()])
    axes.pcolormesh(f10, f20, shown, cmap=colours, vmin=-0.5, vmax=len(CLASSES) - 0.5, rasterized=True)
    if np.isnan(shown).any():
        hatch_gaps(axes)
    together = cells[cells[TOGETHER] > 1]
    axes.plot(together["f10_hat"], together["f20_hat"], label=TOGETHER, **_STROKES)
    for series, style in BORDERS.items():
        pieces = select(table, "map", series)[["f10_hat", "f20_hat"]].to_numpy().reshape(-1, 2, 2)
        axes.add_collection(LineCollection(pieces, colors=BLACK, **style))
    axes.plot(cases["f10_hat"], cases["f20_hat"], **_CASES)
    paper = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.8}
    for _, case in cases.iterrows():
        offset = {"xytext": (5, 3), "textcoords": "offset points", "fontsize": 9}
        axes.annotate(case["label"], (case["f10_hat"], case["f20_hat"]), bbox=paper, **offset)
    named = {number for number in range(len(CLASSES)) if _name(axes, f10, f20, shown == number, number)}
    axes.set(aspect="equal", xlim=_ends(f10), ylim=_ends(f20), xlabel=r"$\hat f_{10}$", ylabel=r"$\hat f_{20}$")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(TICKS))
    figure.legend(handles=_legend(set(np.unique(shown)) - named), loc="outside right center", fontsize=9, frameon=False)
    return figure


def _name(axes, x, y, inside, number):
    """Write the name of a class on its largest patch, where this is widest; return True if it is large enough."""
    patches, _ = ndimage.label(inside)
    sizes = np.bincount(patches.ravel())[1:]
    if not len(sizes) or sizes.max() < NAMED_FROM:
        return False
    depth = ndimage.distance_transform_edt(np.pad(patches == sizes.argmax() + 1, 1))
    i, j = np.unravel_index(depth.argmax(), depth.shape)
    name, (colour, _) = list(CLASSES.items())[number]
    dark = np.dot(to_rgb(colour), (0.3, 0.59, 0.11)) < 0.5
    axes.text(x[j - 1], y[i - 1], name, ha="center", va="center", fontsize=9, color="white" if dark else BLACK)
    return True


def _ends(centres):
    """Outer edges of a row of cells, free of the rounding that decides whether a tick at the end is seen."""
    half = 0.5 * (centres[1] - centres[0])
    return np.round([centres[0] - half, centres[-1] + half], 12)


def _square(cells, column):
    """Values on the grid, f20_hat along the first axis."""
    return cells.pivot(index="f20_hat", columns="f10_hat", values=column).to_numpy(dtype=float)


def _legend(numbers):
    box = {"edgecolor": BLACK, "linewidth": 0.4}
    classes = enumerate(CLASSES.items())
    made = [Patch(facecolor=colour, label=name, **box) for n, (name, (colour, _)) in classes if n in numbers]
    made.append(Line2D([], [], label="others coexist", **_STROKES))
    for series, style in BORDERS.items():
        look = {"linestyle": style["linestyles"], "linewidth": style["linewidths"]}
        made.append(Line2D([], [], color=BLACK, label=f"number of {series} changes", **look))
    return [*made, Line2D([], [], label="cases of the config", **_CASES)]
