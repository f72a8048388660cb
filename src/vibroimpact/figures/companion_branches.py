"""Companion: branches of 1:1 responses against the forcing, of the theory and exact, with simulated attractors."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from vibroimpact.figures.kit.naming import name_lines
from vibroimpact.figures.kit.style import BLACK, DOUBLE_COLUMN, GREY, STABLE, UNSTABLE, letter_panel, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join
from vibroimpact.frames import with_former_names
from vibroimpact.regimes import onset
from vibroimpact.regimes.branches import Path, branches
from vibroimpact.regimes.classification import APERIODIC, UNSETTLED
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
    SymmetricOrbits,
)
from vibroimpact.regimes.settling import Observation, settle

SPEC = {
    "title": "Branches of 1:1 responses and what attracts",
    "caption": "Branches of 1:1 responses over the forcing, from the theory and exact: stable bold solid, unstable "
        "dashed. Marked are their folds and ends, and where stability is lost; all other special points are in "
        "`special_points.csv`. Vertical lines: the cases. Dots: where simulations from several starts end.",
    "alt": "Curves of the saw-tooth amplitude C2 over the forcing amplitude: theory and exact branches, stable bold "
        "solid and unstable dashed, symmetric ones blue and asymmetric ones red, both named, with marked special "
        "points, thin vertical lines at the cases, and dots where simulations from several starts end.",
    "method": "continuation of fixed points and exact 1:1 responses; attractors by direct integration of (10.1) from "
        "many starts, until it repeats",
    "columns": {
        "panel": {"meaning": "a letter for each path, in the order of the config"},
        "series": {"meaning": "family of the branch, attractor, or a case",
            "values": ["symmetric orbit", "asymmetric orbit", "fixed point", "attractor", "case"]},
        "label": {"meaning": "of a node of a branch what is special about it, of an attractor its regime, of a case "
            "its name; blank for other nodes", "unit": "text", "compared": {"attractor": "outcomes"}},
        "branch, piece": {"meaning": "number of the branch in its family, and of its piece between special points, "
            "from 0", "unit": "number", "compared": "algebra"},
        "p": {"compared": {"attractor": "algebra", "others": "roots"}},
        "C1, C2": {"meaning": "$C_i$ of the saw-tooth, (10.11); of an attractor that of half the ball's mean way per "
            "cycle", "compared": {"attractor": "sample", "others": "roots"}},
        "stable": {"meaning": "all multipliers of the piece are inside the unit circle; of fixed points, Masri's "
            "analysis and the slow flow say so", "unit": "true or false"},
        "admissible": {"meaning": "the orbits of the piece are motions of the system; of fixed points always True",
            "unit": "true or false"},
    },
    "tables": {
        "special_points": {
            "file": "results/regimes/special_points.csv",
            "about": "The special points of the branches in `companion_branches`.",
            "columns": {
                "path": {},
                "family": {"meaning": "exact symmetric or asymmetric orbits, or fixed points of the theory",
                    "unit": "text", "values": ["symmetric orbit", "asymmetric orbit", "fixed point"]},
                "kind": {"meaning": "what happens there; of fixed points with the module, where only one is concerned",
                    "unit": "text", "values": ["fold", "symmetry breaking", "period doubling", "Neimark-Sacker", "Hopf",
                    "grazing", "speed zero", "fold of the SIM, module 1", "fold of the SIM, module 2",
                    "symmetry breaking, module 1", "symmetry breaking, module 2"]},
                "p, C1, C2": {"compared": "roots"},
                "admissible": {"meaning": "the orbits on one side at least are motions of the system; of fixed points "
                    "always True", "unit": "true or false"},
            },
        },
        "onsets": {
            "file": "results/regimes/modulation_onsets.csv",
            "about": "Where modulated responses are along the paths of `companion_branches`, as the slow flow predicts "
                "it and as its attractors show it ([derivation](derivation.md), section 12), two rows per path.",
            "columns": {
                "path": {},
                "source": {"meaning": "slow flow: a ball goes in and out of resonance for good, by the picture of "
                    "`relaxation.csv`. simulation: a start ends in a strongly modulated or chaotic response",
                    "unit": "text", "values": ["slow flow", "simulation"]},
                "first, last": {"meaning": "ends of the longest range of `p` in which that is so at every value, blank "
                    "without one", "unit": "dimensionless"},
                "uncertainty": {"meaning": "of the ends: from one value of `p` to the next", "unit": "dimensionless"},
                "agreement": {"meaning": "part of the values of `p` at which both say the same", "unit": "share"},
                "who": {"meaning": "former name of `source`, until the next release", "unit": "text"},
            },
        },
    },
}  # fmt: skip

MARKERS = {
    FOLD: "o",
    SYMMETRY_BREAKING: "^",
    PERIOD_DOUBLING: "s",
    NEIMARK_SACKER: "D",
    HOPF: "D",
    MANIFOLD_FOLD: "v",
    GRAZING: "X",
    SPEED_ZERO: "X",
}
ENDS = FOLD, GRAZING, SPEED_ZERO
"""Marked wherever branches turn or end; of the other special points those that bound a stable piece."""
_SPECIAL = {"linestyle": "none", "color": "white", "markeredgecolor": BLACK, "markeredgewidth": 0.7, "markersize": 4.2}
REPEATING, PASSING, VARYING = "simulated, periodic or idle", "simulated, unsettled", "simulated, not periodic"
DOTS = {
    REPEATING: {"linestyle": "none", "marker": "o", "markeredgewidth": 0, "markersize": 4.4, "color": "0.8"},
    VARYING: {"linestyle": "none", "marker": ".", "markeredgewidth": 0, "markersize": 3.0, "color": GREY},
    PASSING: {"linestyle": "none", "marker": "x", "markeredgewidth": 0.7, "markersize": 3.4, "color": BLACK},
}
"""Looks of the regimes in which simulated starts end."""
KINDS = {UNSETTLED: PASSING, **dict.fromkeys(APERIODIC, VARYING)}
CASE = {"color": GREY, "linewidth": 0.6, "zorder": 0.7}
NO_SPECIAL_POINT = "none"
COLUMNS = ["panel", "series", "label", "branch", "piece", "p", "C1", "C2", "stable", "admissible"]
HUES = {FixedPoints.name: BLACK, SymmetricOrbits.name: "#004488", AsymmetricOrbits.name: "#BB5566"}
"""Blue and red of Paul Tol's high-contrast palette, which colour-blind readers and grey prints tell apart."""
NAMES = {SymmetricOrbits.name: "symmetric", AsymmetricOrbits.name: "asymmetric"}
"""Names of lines of exact orbits; those of the theory are named by their stability."""
_NAMES = {"f10_hat": r"\hat f_{10}", "f20_hat": r"\hat f_{20}"}


def compute(
    system,
    paths: list[dict],
    longest_step: float,
    seeds: int,
    attractors: dict,
    observation: dict,
    systems: dict,
) -> dict:
    """Branches along each path, their special points, and attractors from several starts.

    Args:
        paths: each with `along` (names of the parameters that move together) and `range` (low, high).
        longest_step, seeds: of the continuation, see `regimes.branches`; the seeds are evenly spread over the range.
        attractors: `values` of the parameter, evenly spread, `starts` at each, `seed`.
        observation: arguments of `regimes.settling.Observation`.
        systems: case -> system; those on a path are marked.

    Returns "csv" (columns panel, series, label, branch, piece, p, C1, C2, stable, admissible; of an attractor C belongs
    to half of the ball's mean path per cycle; of a case, named by the label, the p where it lies),
    "special_points" (path, family, kind, p, C1, C2; a path without any has a row of the kind "none"), and "onsets"
    (rows of `regimes.onset.onsets`).
    """
    parts, onsets = [], []
    for panel, settings in zip("abcdefgh", paths, strict=False):
        path, interval = Path(system, tuple(settings["along"])), settings["range"]
        for family in FAMILIES.values():
            found = branches(family, path, interval, np.linspace(*interval, seeds), longest_step)
            parts += [part for number, branch in enumerate(found) for part in _pieces(panel, path, number, branch)]
        ends = _attractors(panel, path, interval, observation, **attractors)
        parts += [ends, *(curve(panel, "case", label=case, p=p) for case, p in _on(path, interval, systems))]
        onsets += onset.onsets(path, np.unique(ends["p"]), ends["p"], ends["label"])
    table = join(parts).reindex(columns=COLUMNS)
    special = table[table["label"].ne("") & table["branch"].notna()]
    special = special.sort_values("admissible").drop_duplicates(
        ["panel", "series", "label", "branch", "p"], keep="last"
    )
    special = special.sort_index()
    along = special["panel"].map({panel: " ".join(s["along"]) for panel, s in zip("abcdefgh", paths, strict=False)})
    special = special.assign(path=along).rename(columns={"series": "family", "label": "kind"})
    special = _every_path(special[["path", "family", "kind", "p", "C1", "C2", "admissible"]], paths)
    modulated = with_former_names(pd.DataFrame(onsets, columns=onset.COLUMNS), onset.FORMER)
    return {"csv": table, "special_points": special, "onsets": modulated}


def _on(path, interval, systems):
    """Cases on a path, and where."""
    places = {case: getattr(system, path.names[0]) for case, system in systems.items()}
    for case, p in places.items():
        if interval[0] <= p <= interval[1] and path(p) == systems[case]:
            yield case, p


def _every_path(special, paths):
    """Special points by path, in the order of the paths; for a path without any a row that says so."""
    order = [" ".join(settings["along"]) for settings in paths]
    without = [path for path in order if path not in set(special["path"])]
    if without:
        special = pd.concat([special, pd.DataFrame({"path": without, "kind": NO_SPECIAL_POINT})], ignore_index=True)
    return special.sort_values("path", key=lambda names: names.map(order.index), kind="stable")


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
        regimes = settle(path(p), spread_starts(starts, seed), Observation(**observation))
        rows += [(p, *regime.mean_amplitudes, regime.name) for regime in regimes]
    p, C1, C2, names = zip(*rows, strict=True)
    return curve(panel, "attractor", label=names, p=p, C1=C1, C2=C2)


@styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`: C_2 along each path; stable bold solid, unstable dashed, special points marked."""
    table, special = tables["csv"], tables["special_points"]
    panels = list(dict.fromkeys(table["panel"]))
    figure = new_figure(DOUBLE_COLUMN, 118.0)
    grid = figure.subplots(2, len(panels), sharex="col", squeeze=False)
    for column, (panel, along) in enumerate(zip(panels, dict.fromkeys(special["path"]), strict=True)):
        mine = table[table["panel"] == panel]
        attractors, theory = mine[mine["series"] == "attractor"], mine["series"] == FixedPoints.name
        for row, what in enumerate(("theory", "exact")):
            axes = grid[row, column]
            axes.set(xlim=(attractors["p"].min(), attractors["p"].max()), ylim=(0.0, 2.6), ylabel="$C_2$")
            letter_panel(axes, "abcdefgh"[row * len(panels) + column])
            axes.set_title(what, loc="right", pad=3)
        _attractor_dots(grid[1, column], attractors)
        _cases(*grid[:, column], mine[mine["series"] == "case"])
        _branches(grid[0, column], mine[theory])
        _branches(grid[1, column], mine[~theory & mine["admissible"].eq(True)])
        grid[1, column].set_xlabel(_axis(along))
    for axes in grid.flat:
        axes.label_outer()
    figure.legend(handles=_legend(grid.flat), fontsize=8.5, columnspacing=1.0, loc="outside lower center", ncols=4)
    return figure


def _cases(theory, exact, cases):
    """Thin lines where the cases lie, with their names above the foot of the first panel."""
    for _, case in cases.iterrows():
        for axes in (theory, exact):
            axes.axvline(case["p"], **CASE)
        theory.annotate(
            case["label"],
            (case["p"], 0),
            (2, 3),
            xycoords=theory.get_xaxis_transform(),
            textcoords="offset points",
            rotation=90,
            fontsize=8.5,
        )


def _branches(axes, table):
    """Lines of the pieces with their names, at stable ones if there are any, and the marks on them."""
    named = {}
    for (family, stable), pieces in table.groupby(["series", "stable"], sort=False):
        style = (STABLE if stable else UNSTABLE) | {"color": HUES[family]}
        lines = [
            axes.plot(piece["p"], piece["C2"], **style)[0]
            for _, piece in pieces.groupby(["branch", "piece"], sort=False)
        ]
        name = NAMES.get(family, "stable" if stable else "unstable")
        if stable or name not in named:
            named[name] = HUES[family], [line.get_xydata() for line in lines]
    _marks(axes, table[table["label"].ne("")])
    name_lines(axes, named)


def _marks(axes, special):
    """Special points where branches turn or end, and where stability is lost; each is in the pieces on both sides."""
    for kind, marker in MARKERS.items():
        rows = special[_is(special, kind) & (special["stable"].eq(True) | (kind in ENDS))]
        rows = rows[rows["p"].between(*axes.get_xlim())].drop_duplicates(["series", "branch", "p"])
        axes.plot(rows["p"], rows["C2"], marker=marker, zorder=4, **_SPECIAL, label=kind)


def _attractor_dots(axes, attractors):
    kinds = attractors["label"].map(lambda name: KINDS.get(name, REPEATING))
    for kind, style in DOTS.items():
        rows = attractors[kinds == kind]
        axes.plot(rows["p"], rows["C2"], zorder=1, **style, label=kind)


def _is(special, kind):
    """Rows of a kind; of those that name a module as well."""
    return special["label" if "label" in special else "kind"].str.split(",").str[0] == kind


def _legend(panels):
    """Return the legend of dots and marks in all panels; kinds with one marker share an entry."""
    shown = {line.get_label() for axes in panels for line in axes.lines if len(line.get_xdata())}
    kinds = [kind for kind in MARKERS if kind in shown]
    marked = {MARKERS[kind]: [other for other in kinds if MARKERS[other] == MARKERS[kind]] for kind in kinds}
    return [
        *(Line2D([], [], **style, label=kind) for kind, style in DOTS.items() if kind in shown),
        *(Line2D([], [], marker=marker, label=", ".join(names), **_SPECIAL) for marker, names in marked.items()),
    ]


def _axis(along):
    return (
        "$" + " = ".join(_NAMES.get(name, r"\mathrm{" + name.replace("_", r"\_") + "}") for name in along.split()) + "$"
    )
