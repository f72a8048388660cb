"""Companion: branches of 1:1 responses against the forcing, of the theory and exact, with simulated attractors."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from vibroimpact.figures.style import BLACK, DOUBLE_COLUMN, GREY, STABLE, UNSTABLE, letter_panel, new_figure, styled
from vibroimpact.figures.tables import curve, join
from vibroimpact.regimes.branches import Path, branches
from vibroimpact.regimes.classification import MODULATED, settle
from vibroimpact.regimes.classification import starts as spread_starts
from vibroimpact.regimes.families import (
    FAMILIES,
    FOLD,
    GRAZING,
    HOPF,
    MANIFOLD_FOLD,
    NEIMARK_SACKER,
    PERIOD_DOUBLING,
    SPEED_ZERO,
    SYMMETRY_BREAKING,
    AsymmetricOrbits,
    FixedPoints,
)

MARKERS = {
    FOLD: "o",
    SYMMETRY_BREAKING: "^",
    PERIOD_DOUBLING: "s",
    NEIMARK_SACKER: "D",
    HOPF: "D",
    GRAZING: "X",
    SPEED_ZERO: "P",
    MANIFOLD_FOLD: "v",
}
_SPECIAL = {"linestyle": "none", "color": "white", "markeredgecolor": BLACK, "markeredgewidth": 0.7, "markersize": 4.2}
DOTS = {
    True: {"linestyle": "none", "marker": ".", "markeredgewidth": 0, "markersize": 3.0, "color": GREY},
    False: {"linestyle": "none", "marker": "o", "markeredgewidth": 0, "markersize": 4.4, "color": "0.8"},
}
SIMULATED = {True: "simulated, modulated", False: "simulated, not modulated"}
"""Attractors found by simulation: modulated or not."""
COLOURS = {AsymmetricOrbits.name: "0.45"}
_NAMES = {"f10_hat": r"\hat f_{10}", "f20_hat": r"\hat f_{20}"}


def compute(system, paths: list[dict], longest_step: float, seeds: int, attractors: dict, observation: dict) -> dict:
    """Branches along each path, their special points, and attractors from several starts.

    Args:
        paths: each with `along` (names of the parameters that move together) and `range` (low, high).
        longest_step, seeds: of the continuation, see `regimes.branches`; the seeds are evenly spread over the range.
        attractors: `values` of the parameter, evenly spread, `starts` at each, `seed`.
        observation: cycles, rounds, window, nearness of `regimes.classification.settle`.

    Returns "csv" (columns panel, series, label, branch, piece, p, C1, C2, stable, admissible; of an attractor
    C belongs to half of the ball's mean path per cycle) and "special_points" (path, family, kind, p, C1, C2).
    """
    parts = []
    for panel, settings in zip("abcdefgh", paths, strict=False):
        path, interval = Path(system, tuple(settings["along"])), settings["range"]
        for family in FAMILIES.values():
            found = branches(family, path, interval, np.linspace(*interval, seeds), longest_step)
            parts += [part for number, branch in enumerate(found) for part in _pieces(panel, path, number, branch)]
        parts.append(_attractors(panel, path, interval, observation, **attractors))
    table = join(parts)
    special = table[table["label"].ne("") & table["branch"].notna()]
    special = special.sort_values("admissible").drop_duplicates(
        ["panel", "series", "label", "branch", "p"], keep="last"
    )
    special = special.sort_index()
    along = special["panel"].map({panel: " ".join(s["along"]) for panel, s in zip("abcdefgh", paths, strict=False)})
    special = special.assign(path=along).rename(columns={"series": "family", "label": "kind"})
    return {"csv": table, "special_points": special[["path", "family", "kind", "p", "C1", "C2", "admissible"]]}


def _pieces(panel, path, number, branch):
    for piece, (inner, nodes) in enumerate(branch.pieces()):
        amplitudes = np.array([node.amplitudes for node in nodes])
        yield curve(
            panel,
            branch.family.name,
            label=[node.kind for node in nodes],
            branch=number,
            piece=piece,
            p=[node.p for node in nodes],
            C1=amplitudes[:, 0],
            C2=amplitudes[:, 1],
            stable=inner.stable,
            admissible=inner.admissible,
        )


def _attractors(panel, path, interval, observation, values, starts, seed):
    rows = []
    for p in np.linspace(*interval, values):
        regimes = settle(path(p), spread_starts(starts, seed), **observation)
        rows += [(p, *regime.mean_amplitudes, regime.name) for regime in regimes]
    p, C1, C2, names = zip(*rows, strict=True)
    return curve(panel, "attractor", label=names, p=p, C1=C1, C2=C2)


@styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`: C_2 along each path; stable bold solid, unstable dashed, special points marked."""
    table, special = tables["csv"], tables["special_points"]
    panels = list(dict.fromkeys(table["panel"]))
    along = dict(zip(panels, dict.fromkeys(special["path"]), strict=True))
    figure = new_figure(DOUBLE_COLUMN, 132.0)
    grid = figure.subplots(2, len(panels), sharex="col", sharey=True, squeeze=False)
    for column, panel in enumerate(panels):
        mine, points = table[table["panel"] == panel], special[special["path"] == along[panel]]
        theory = mine["series"] == FixedPoints.name
        _attractor_dots(grid[1, column], mine[mine["series"] == "attractor"])
        _lines(grid[0, column], mine[theory])
        _lines(grid[1, column], mine[~theory & mine["admissible"].eq(True)])
        _marks(grid[0, column], points[points["family"] == FixedPoints.name])
        _marks(grid[1, column], points[(points["family"] != FixedPoints.name) & points["admissible"]])
        attractors = mine[mine["series"] == "attractor"]["p"]
        grid[1, column].set(xlim=(attractors.min(), attractors.max()), xlabel=_axis(along[panel]))
        for row, what in enumerate(("theory", "exact")):
            letter_panel(grid[row, column], "abcdefgh"[row * len(panels) + column])
            grid[row, column].set_title(what, loc="right", pad=3)
    for row in range(2):
        grid[row, 0].set(ylabel="$C_2$", ylim=(0.0, 2.6))
    figure.legend(handles=_legend(special), loc="outside lower center", ncols=5, fontsize=8.5, columnspacing=1.0)
    return figure


def _lines(axes, table):
    for _, piece in table.groupby(["series", "branch", "piece"], sort=False):
        style = STABLE if piece["stable"].iloc[0] else UNSTABLE
        axes.plot(piece["p"], piece["C2"], **style | {"color": COLOURS.get(piece["series"].iloc[0], BLACK)})


def _marks(axes, special):
    for kind, marker in MARKERS.items():
        rows = special[_is(special, kind)]
        axes.plot(rows["p"], rows["C2"], marker=marker, zorder=4, **_SPECIAL)


def _attractor_dots(axes, attractors):
    for modulated, style in DOTS.items():
        rows = attractors[(attractors["label"] == MODULATED) == modulated]
        axes.plot(rows["p"], rows["C2"], zorder=1, **style, label=SIMULATED[modulated])


def _is(special, kind):
    """Rows of a kind; of those that name a module as well."""
    return special["kind"].str.partition(",")[0] == kind


def _legend(special):
    kinds = [kind for kind in MARKERS if _is(special, kind).any()]
    marked = {MARKERS[kind]: [other for other in kinds if MARKERS[other] == MARKERS[kind]] for kind in kinds}
    grey = {"color": COLOURS[AsymmetricOrbits.name]}
    return [
        Line2D([], [], **STABLE, label="stable"),
        Line2D([], [], **UNSTABLE, label="unstable"),
        Line2D([], [], **STABLE | grey, label="asymmetric, stable"),
        Line2D([], [], **UNSTABLE | grey, label="asymmetric, unstable"),
        *(Line2D([], [], **DOTS[modulated], label=SIMULATED[modulated]) for modulated in (False, True)),
        *(Line2D([], [], marker=marker, label=", ".join(names), **_SPECIAL) for marker, names in marked.items()),
    ]


def _axis(along):
    return (
        "$" + " = ".join(_NAMES.get(name, r"\mathrm{" + name.replace("_", r"\_") + "}") for name in along.split()) + "$"
    )
