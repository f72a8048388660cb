"""Companion: map of the regimes in the plane of both forcing amplitudes, with borders that the theory predicts."""

from functools import cache
from textwrap import fill

import numpy as np
import pandas as pd
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator
from scipy import ndimage

from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.figures.plotting.style import BLACK, SINGLE_COLUMN, heading, new_figure, styled
from vibroimpact.studies.figures.plotting.regime_colours import COLOURS, MARKS, key, paint
from vibroimpact.studies.regimes.classification import REGIMES, UNSETTLED
from vibroimpact.studies.sweeps.observations import FROM_REST, fixed_point_counts

SPEC = {
    "title": "Map of regimes over both forcing amplitudes",
    "caption": "Regime that most starts reach in the plane of both forcing amplitudes, with a stroke where some "
        "starts reach another regime. The start from rest is not counted, since a ball may stay idle. Line: "
        "border of stability by the theory, where the number of fixed points that are stable in impacts and slow flow "
        "changes. Crosses: the cases.",
    "alt": "Map over the plane of f10 and f20 in patches of one colour for each class of regimes, some with a mark. "
        "Strongly modulated responses fill the middle and the lower left, other periodic ones the upper left and the "
        "right edge, asymmetric ones the upper middle, where a closed solid line encloses the forces for which the "
        "theory has a stable fixed point; chaos has an island below.",
    "method": "points of a sweep, and the cases; borders of the theory by bisection",
    "sweeps": {"regime_map": {"along": [["f10_hat"], ["f20_hat"]], "evenly": True,
        "observe": ["regimes", "fixed_points"]}},
    "columns": {
        "label": {"meaning": "regime that the start from rest reaches", "unit": "text", "compared": "cells of a map"},
        "f10_hat, f20_hat": {"compared": "algebra"},
        "regime": {"meaning": "regime that most of the other starts reach", "unit": "text",
            "compared": "cells of a map"},
        "coexisting": {"meaning": "number of regimes in which the other starts settle", "unit": "number",
            "compared": "cells of a map"},
        "symmetric": {"compared": "counts of a map"},
        "asymmetric, other periodic, strongly modulated, chaotic": {"compared": "cells of a map"},
        "hopping": {"compared": "counts of a map"},
        "quasi-periodic, one ball idle": {"compared": "rare cells of a map"},
        "no impacts": {"compared": "counts of a map"},
        "unsettled": {"compared": "cells of a map"},
        "fixed_points, stable_points": {"compared": "counts of a map"},
    },
    "tables": {
        "cases": {
            "file": "results/figures/companion_regime_map.cases.csv",
            "about": "Cases of the config in the plane of `companion_regime_map`.",
            "columns": {"case": {}, "f10_hat, f20_hat": {"compared": "algebra"}},
        },
        "borders": {
            "file": "results/figures/companion_regime_map.borders.csv",
            "about": "Lines in the plane of `companion_regime_map` on which the theory's number of fixed points, or of "
                "stable ones, changes, as straight pieces.",
            "columns": {
                "series": {"meaning": "number that changes on the line", "values": ["fixed points", "stable points"]},
                "piece": {"meaning": "number of the piece of the line, from 1; its two ends are two rows",
                    "unit": "number", "compared": "algebra"},
                "f10_hat, f20_hat": {"compared": "roots"},
            },
        },
    },
}  # fmt: skip

BORDERS = ("fixed points", STABLE_POINTS := "stable points")
HALVINGS = 4
"""Number of bisections between two cells with different numbers of fixed points; the error is up to 1/32 of a cell."""
COEXISTING = "coexisting"
SMALLEST_NAMED_PATCH = 20
"""Smallest size, in cells, of a patch that bears the name of its regime; the legend lists regimes without a name."""
CELL_ASPECT = 0.5
"""Ratio of width to height that the search for the place of a name assumes for a cell, as names are wider than high."""
_BORDER = {"color": BLACK, "linewidth": 1.4}
_CASES = {"linestyle": "none", "marker": "x", "color": BLACK, "markersize": 5.0, "markeredgewidth": 1.2}
_STROKES = {"linestyle": "none", "marker": (2, 2, -45), "color": BLACK, "markersize": 6.0, "markeredgewidth": 0.7}
TICKS = 4
"""Largest number of intervals between ticks on an axis; Matplotlib's own choice depends on the limits' last digit."""


def compute(table: pd.DataFrame, system, systems: dict, starts: int) -> dict:
    """Return the regimes of the map, the borders that the theory predicts, and the cases that are marked.

    Parameters
    ----------
    table : DataFrame
        Table of a sweep over f10_hat and f20_hat, both evenly spaced.
    systems : dict
        System of each case, by name of the case. Cases that differ from `system` only in the forcing amplitudes are
        marked.
    starts : int
        Number of initial states at each point. Only the first initial state is at rest.

    Returns
    -------
    dict
        The tables in SPEC.
    """
    cells = table.rename(columns={FROM_REST: "label"})
    cells["regime"], cells[COEXISTING] = _dominant(cells, starts)
    forces = {case: {"f10_hat": one.f10_hat, "f20_hat": one.f20_hat} for case, one in systems.items()}
    marks = [{"case": case, **at} for case, at in forces.items() if systems[case] == system.with_(**at)]
    pieces = [(series, *piece) for series in BORDERS for piece in _border(system, cells, series)]
    return {
        "csv": cells[["label", "f10_hat", "f20_hat", "regime", COEXISTING, *REGIMES, "fixed_points", "stable_points"]],
        "cases": pd.DataFrame(marks, columns=["case", "f10_hat", "f20_hat"]),
        "borders": pd.DataFrame(pieces, columns=["series", "piece", "f10_hat", "f20_hat"]),
    }


def _dominant(cells, starts):
    """Return two arrays: the regime that most initial states reach in each cell, and the number of reached regimes.

    The number does not count the regime "unsettled". The run from rest is ignored unless it is the only run.
    """
    counts = cells[[*REGIMES]].to_numpy(float) * starts
    if starts > 1:
        counts -= cells["label"].to_numpy()[:, None] == np.array(REGIMES)
    counts = np.where(np.isnan(counts), -1.0, counts.round())
    names = np.where(counts.max(axis=1) >= 0, np.array(REGIMES)[counts.argmax(axis=1)], None)
    settled = [number for number, name in enumerate(REGIMES) if name != UNSETTLED]
    return names, np.where(counts.max(axis=1) >= 0, (counts[:, settled] > 0).sum(axis=1), np.nan)


def _border(system, cells, series):
    """Yield both ends of each straight piece of a border.

    Each end is a tuple (number of the piece, f10_hat, f20_hat). The pieces are numbered from 1.

    series: "fixed points" or "stable points". The number of these points changes at the border.
    """
    which = BORDERS.index(series)
    square = cells.pivot(index="f20_hat", columns="f10_hat", values=series.replace(" ", "_")).to_numpy(float)

    @cache
    def count(f10, f20):
        return fixed_point_counts(system.with_(f10_hat=f10, f20_hat=f20))[which]

    @cache
    def crossing(first, second):
        (a, start), (b, _) = first, second
        low, high = np.array(a), np.array(b)
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if count(*middle) == start else (low, middle)
        return tuple((low + high) / 2)

    pieces = (piece for corners in _squares(cells, square) for piece in _pieces(corners, crossing))
    for number, ends in enumerate(pieces, start=1):
        yield from ((number, *end) for end in ends)


def _squares(cells, square):
    """Yield a list of four tuples (centre, count) for each square of four adjacent cells.

    The count is the number of fixed points, or of stable fixed points, in a cell. Successive cells in the list share a
    side. If the count of a cell is unknown, squares with this cell are left out.

    square: counts of all cells, with rows for f20_hat and columns for f10_hat. An unknown count is nan.
    """
    x, y = np.unique(cells["f10_hat"]), np.unique(cells["f20_hat"])
    for i, j in np.ndindex(len(y) - 1, len(x) - 1):
        around = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]
        if not np.isnan([square[place] for place in around]).any():
            yield [((float(x[n]), float(y[m])), square[m, n]) for m, n in around]


def _pieces(corners, crossing):
    """Return the pieces of the border within a square of four cell centres.

    If the border crosses two sides of the square, one piece joins both crossings. If it crosses four sides, a piece
    leads from each crossing to the mean of the crossings.

    corners: list from `_squares`.
    crossing: function of two corners that returns the point at which the border crosses the side between them.
    """
    sides = [sorted(pair) for pair in zip(corners, corners[1:] + corners[:1], strict=True) if pair[0][1] != pair[1][1]]
    ends = [crossing(first, second) for first, second in sides]
    if len(ends) == 2:
        return [ends]
    middle = tuple(np.mean(ends, axis=0)) if ends else None
    return [[end, middle] for end in ends]


@styled
def draw(tables: dict) -> Figure:
    """Draw the map of `compute`: a colour per regime, strokes where regimes coexist, and the border of stability."""
    cells, cases, borders = (tables[name] for name in ("csv", "cases", "borders"))
    regimes = cells.pivot(index="f20_hat", columns="f10_hat", values="regime")
    figure = new_figure(SINGLE_COLUMN, 103.0)
    axes = figure.add_subplot()
    occurring = paint(axes, regimes)
    together = cells[cells[COEXISTING] > 1]
    axes.plot(together["f10_hat"], together["f20_hat"], **_STROKES)
    pieces = borders[borders["series"] == STABLE_POINTS][["f10_hat", "f20_hat"]].to_numpy().reshape(-1, 2, 2)
    axes.plot(*pieces.T, **_BORDER)
    marked = [(case, axes.plot(*place, **_CASES)) for case, *place in cases.itertuples(index=False)]
    f10, f20 = regimes.columns.to_numpy(), regimes.index.to_numpy()
    lined = cells.pivot(index="f20_hat", columns="f10_hat", values=COEXISTING).to_numpy() > 1
    for x, y in pieces.reshape(-1, 2):
        lined[np.abs(f20 - y).argmin(), np.abs(f10 - x).argmin()] = True
    unnamed = [name for name in occurring if name in MARKS or not _name(axes, regimes, name, lined)]
    axes.set(aspect="equal", xlim=_ends(f10), ylim=_ends(f20), xlabel=r"$\hat f_{10}$", ylabel=r"$\hat f_{20}$")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(TICKS))
    heading(axes, words="attractor that most starts reach")
    handles = {"others coexist": Line2D([], [], **_STROKES), "border of stability": Line2D([], [], **_BORDER)}
    handles |= {fill(name, 26): handle for name, handle in key(unnamed).items()}
    figure.legend(handles.values(), handles, loc="outside lower center", ncols=2, fontsize=9)
    name_curves(figure, {axes: marked}, fontsize=9)
    return figure


def _name(axes, regimes, name, lined):
    """Write the name of a regime in its largest patch; return False if this patch is too small.

    lined: mask of the cells that contain a stroke or a piece of the border of stability. The name avoids these cells.
    """
    patches, _ = ndimage.label(regimes.eq(name))
    sizes = np.bincount(patches.ravel())[1:]
    if not len(sizes) or sizes.max() < SMALLEST_NAMED_PATCH:
        return False
    free = (patches == sizes.argmax() + 1) & ~lined
    depth = ndimage.distance_transform_edt(np.pad(free, 1), sampling=(1.0, CELL_ASPECT))
    i, j = np.unravel_index(depth.argmax(), depth.shape)
    dark = np.dot(to_rgb(COLOURS[name]), (0.3, 0.59, 0.11)) < 0.5
    place = regimes.columns[j - 1], regimes.index[i - 1]
    axes.text(*place, name, ha="center", va="center", color="white" if dark else BLACK)
    return True


def _ends(centres):
    """Return the outer edges of the first and the last cell, from the centres of all cells."""
    half = 0.5 * (centres[1] - centres[0])
    return np.round([centres[0] - half, centres[-1] + half], 12)  # rounded, so that a tick at an edge is inside
