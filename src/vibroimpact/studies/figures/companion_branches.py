"""Companion: branches of fixed points and of exact orbits against the forcing, with simulated attractors."""

from string import ascii_lowercase

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.figures.plotting.style import (
    BLACK,
    DOUBLE_COLUMN,
    GREY,
    STABLE,
    UNSTABLE,
    heading,
    new_figure,
    styled,
)
from vibroimpact.studies.figures.plotting.regime_colours import COLOURS
from vibroimpact.studies.figures.sweep import SYMBOLS
from vibroimpact.studies.regimes import onset
from vibroimpact.studies.regimes.branches import Path, branches
from vibroimpact.studies.regimes.classification import APERIODIC, ASYMMETRIC, SYMMETRIC, UNSETTLED
from vibroimpact.studies.regimes.classification import starts as spread_starts
from vibroimpact.studies.regimes.families import FAMILIES, AsymmetricOrbits, FixedPoints, SymmetricOrbits
from vibroimpact.studies.regimes.settling import Observation, settle

SPEC = {
    "title": "Branches of 1:1 responses and attractors",
    "caption": "Amplitude :math:`C_2` of 1:1 responses against the forcing, by the theory (top) and exact (bottom): "
        "stable (by the theory: in impacts and slow flow) bold solid, unstable dashed. Left: one force varies, and "
        "the other is that of the case. Right: both forces vary together. Dots: attractors, from simulations from "
        "several starts. Vertical lines: the cases. `special_points.csv` has all special points of the curves.",
    "alt": "Curves of the saw-tooth amplitude C2 against the forcing amplitude: theory and exact branches, stable bold "
        "solid and unstable dashed, symmetric ones blue and asymmetric ones green, both labelled, with thin vertical "
        "lines at the cases, and large grey or small black dots for periodic or other attractors of simulations.",
    "method": "continuation of fixed points and exact 1:1 responses; attractors by direct integration of (10.1) from "
        "several starts, until the motion repeats",
    "columns": {
        "panel": {"meaning": "a letter for each path, in the order of the config"},
        "series": {"meaning": "family of the branch", "values": ["symmetric orbit", "asymmetric orbit",
            "fixed point"]},
        "label": {"meaning": "kind of the special point; blank for other nodes", "unit": "text"},
        "branch, piece": {"meaning": "number of the branch in its family, and of its piece between special points, "
            "from 0", "unit": "number", "compared": "algebra"},
        "p": {"compared": "roots"},
        "C1, C2": {"meaning": "$C_i$ of the saw-tooth, (10.11)", "compared": "roots"},
        "stable": {"meaning": "True if all multipliers of the piece are inside the unit circle; for fixed points, if "
            "they are stable by Masri's analysis and in the slow flow", "unit": "true or false"},
        "admissible": {"meaning": "True if the orbits of the piece are motions of the system; always True for fixed "
            "points",
            "unit": "true or false"},
    },
    "tables": {
        "attractors": {
            "file": "results/figures/companion_branches.attractors.csv",
            "about": "Attractors of simulations along the paths of `companion_branches`, one row per start.",
            "columns": {
                "panel": {"meaning": "path, as in `companion_branches`"},
                "label": {"meaning": "`regime` of the attractor", "unit": "text", "compared": "outcomes"},
                "p": {"compared": "algebra"},
                "C1, C2": {"meaning": "$C_i$, (10.11), computed from half of the ball's mean path per cycle",
                    "compared": "amplitudes"},
            },
        },
        "cases": {
            "file": "results/figures/companion_branches.cases.csv",
            "about": "Cases on the paths of `companion_branches`.",
            "columns": {
                "panel": {"meaning": "path, as in `companion_branches`"},
                "case": {}, "p": {"compared": "algebra"},
            },
        },
        "special_points": {
            "file": "results/regimes/special_points.csv",
            "about": "Special points of the branches in `companion_branches`.",
            "columns": {
                "path": {},
                "family": {"meaning": "exact symmetric or asymmetric orbits, or fixed points of the theory",
                    "unit": "text", "values": ["symmetric orbit", "asymmetric orbit", "fixed point"]},
                "kind": {"meaning": "kind of the special point, with the module if only one is concerned; none if the "
                    "path has no special point",
                    "unit": "text", "values": ["fold", "symmetry breaking", "period doubling", "Neimark-Sacker", "Hopf",
                    "grazing", "speed zero", "fold of the SIM, module 1", "fold of the SIM, module 2",
                    "symmetry breaking, module 1", "symmetry breaking, module 2", "none"]},
                "p, C1, C2": {"compared": "roots"},
                "admissible": {"meaning": "True if the orbits on at least one side are motions of the system; always "
                    "True for fixed points", "unit": "true or false"},
            },
        },
        "onsets": {
            "file": "results/regimes/modulation_onsets.csv",
            "about": "Ranges of modulated responses along the paths of `companion_branches`, predicted by the slow "
                "flow and simulated ([derivation](derivation.md), section 12), two rows per path.",
            "columns": {
                "path": {},
                "source": {"meaning": "slow flow: a ball enters and leaves resonance again and again. simulation: a "
                    "start reaches a strongly modulated or chaotic response", "unit": "text",
                    "values": ["slow flow", "simulation"]},
                "first, last": {"meaning": "ends of the longest range of `p` with modulated responses at every value; "
                    "blank if there is none", "unit": "dimensionless"},
                "uncertainty": {"meaning": "uncertainty of the ends: distance between values of `p`",
                    "unit": "dimensionless"},
                "agreement": {"meaning": "share of the values of `p` at which both sources agree", "unit": "share"},
            },
        },
    },
}  # fmt: skip

DOTS = {
    "simulated, periodic or idle": {"marker": "o", "markersize": 4.4, "color": "0.8"},
    "simulated, any other motion": {"marker": "o", "markersize": 1.2, "color": BLACK},
}
"""Style of the dots by the kind of motion in which a simulation ends."""
CASE = {"color": GREY, "linewidth": 0.6, "zorder": 0.7}
HUES = {
    FixedPoints.name: COLOURS[SYMMETRIC],
    SymmetricOrbits.name: COLOURS[SYMMETRIC],
    AsymmetricOrbits.name: COLOURS[ASYMMETRIC],
}
NAMES = {SymmetricOrbits.name: "symmetric", AsymmetricOrbits.name: "asymmetric"}
"""Names of the branches of exact orbits; branches of the theory are named by their stability."""
NODES = ["family", "special", "branch", "piece", "p", "C1", "C2", "stable", "admissible"]
"""Columns of `Branch.rows` that are kept."""


def compute(
    system,
    paths: list[dict],
    longest_step: float,
    seeds: int,
    attractors: dict,
    observation: dict,
    systems: dict,
) -> dict:
    """Return the branches along each path, their special points, and attractors from several initial states.

    Parameters
    ----------
    paths : list of dict
        For each path, `along` (names of the parameters that vary together) and `range` (low, high).
    longest_step : float
        Length of the longest step of the continuation.
    seeds : int
        Number of parameter values at which branches are searched for, evenly spaced in the range.
    attractors : dict
        `values` (number of parameter values), `starts` (number of initial states at each value) and `seed` (seed of the
        initial states).
    observation : dict
        Arguments of `Observation`.
    systems : dict
        System of each case, by name of the case. The figure marks the cases that lie on a path.

    Returns
    -------
    dict
        The tables in SPEC.
    """
    nodes, attracting, cases, onsets = [], [], [], []
    begun = spread_starts(attractors["starts"], attractors["seed"])
    names = {panel: " ".join(settings["along"]) for panel, settings in zip(ascii_lowercase, paths, strict=False)}
    for panel, settings in zip(names, paths, strict=True):
        path, interval = Path(system, tuple(settings["along"])), settings["range"]
        for family in FAMILIES["both"]:
            found = branches(family, path, interval, np.linspace(*interval, seeds), longest_step)
            nodes += [{"panel": panel, **row} for number, branch in enumerate(found) for row in branch.rows(number)]
        values = np.linspace(*interval, attractors["values"])
        ends = [
            (panel, regime.name, p, *regime.mean_amplitudes)
            for p in values
            for regime in settle(path(p), begun, Observation(**observation))
        ]
        attracting += ends
        onsets += onset.onsets(path, values, [p for _, _, p, *_ in ends], [regime for _, regime, *_ in ends])
        places = {case: getattr(one, path.names[0]) for case, one in systems.items()}
        low, high = interval
        cases += [(panel, case, p) for case, p in places.items() if low <= p <= high and path(p) == systems[case]]
    nodes = pd.DataFrame(nodes, columns=["panel", *NODES]).rename(columns={"family": "series", "special": "label"})
    return {
        "csv": nodes,
        "attractors": pd.DataFrame(attracting, columns=["panel", "label", "p", "C1", "C2"]),
        "cases": pd.DataFrame(cases, columns=["panel", "case", "p"]),
        "special_points": _special_points(nodes, names),
        "onsets": pd.DataFrame(onsets, columns=onset.COLUMNS),
    }


def _special_points(nodes, names):
    """Return the special points of each path; a path without special points has one row of the kind "none"."""
    found = nodes[nodes["label"].ne("")].sort_values("admissible")
    found = found.drop_duplicates(["panel", "series", "label", "branch", "p"], keep="last").sort_index()
    without = pd.DataFrame({"panel": [one for one in names if one not in set(found["panel"])], "label": "none"})
    found = pd.concat([found, without] if len(found) else [without]).sort_values("panel", kind="stable")
    found = found.assign(path=found["panel"].map(names)).rename(columns={"series": "family", "label": "kind"})
    return found.reindex(columns=["path", "family", "kind", "p", "C1", "C2", "admissible"])


@styled
def draw(tables: dict) -> Figure:
    """Draw C_2 along each path: theory in the upper panel, exact motions and simulations in the lower panel."""
    nodes, attractors, cases = tables["csv"], tables["attractors"], tables["cases"]
    panels = list(dict.fromkeys(attractors["panel"]))
    figure = new_figure(DOUBLE_COLUMN, 112.0)
    grid = figure.subplots(2, len(panels), sharex="col", sharey=True, squeeze=False)
    names = {}
    for column, (panel, along) in enumerate(zip(panels, dict.fromkeys(tables["special_points"]["path"]), strict=True)):
        mine, simulated, marked = (table[table["panel"] == panel] for table in (nodes, attractors, cases))
        top, bottom = grid[:, column]
        top.set(xlim=simulated["p"].agg(["min", "max"]), ylim=(-0.1, 2.6))
        _attractor_dots(bottom, simulated)
        _cases(top, bottom, marked)
        theory = mine["series"] == FixedPoints.name
        names[top] = _branches(top, mine[theory])
        names[bottom] = _branches(bottom, mine[~theory & mine["admissible"].eq(True)])
        bottom.set_xlabel(f"${' = '.join(SYMBOLS[name].strip('$') for name in along.split())}$")
        heading(top, ascii_lowercase[column], "theory: symmetric motions")
        heading(bottom, ascii_lowercase[len(panels) + column], "exact motions and simulations")
    for axes in grid[:, 0]:
        axes.set_ylabel("amplitude $C_2$")
    figure.legend(handles=bottom.lines[: len(DOTS)], fontsize=9, loc="outside lower center", ncols=2)
    name_curves(figure, names)
    return figure


def _cases(theory, exact, cases):
    """Draw a thin vertical line at each case, and write the name of the case at the bottom of the panel `theory`."""
    for case, p in cases[["case", "p"]].itertuples(index=False):
        for axes in (theory, exact):
            axes.axvline(p, **CASE)
        place = {"xycoords": theory.get_xaxis_transform(), "textcoords": "offset points", "rotation": 90}
        theory.annotate(case, (p, 0), (2, 3), **place)


def _branches(axes, nodes):
    """Draw all branches; return (name, lines) of each long branch.

    If the branch has stable motions, `lines` are the lines of the stable motions. Otherwise, `lines` are all lines of
    the branch.
    """
    named, spans = {}, nodes.groupby(["series", "branch"])["p"].agg(np.ptp)
    # Successive pieces with the same stability are drawn as one line. If dashes started again at each piece, the line
    # would look solid.
    begins = nodes[["series", "stable", "branch"]].ne(nodes[["series", "stable", "branch"]].shift()).any(axis=1)
    begins |= nodes.index.to_series().diff().ne(1)  # a gap in the index, where inadmissible rows were left out
    pieces = nodes.groupby(["series", "branch", "stable", begins.cumsum()], sort=False)
    for (family, branch, stable, _), piece in pieces:
        line = axes.plot(piece["p"], piece["C2"], **(STABLE if stable else UNSTABLE) | {"color": HUES[family]})
        name = NAMES.get(family, "stable" if stable else "unstable")
        if spans[family, branch] > 0.2 * spans.max():
            named.setdefault((name, branch), {True: [], False: []})[stable].extend(line)
    return [(name, lines[True] or lines[False]) for (name, _), lines in named.items()]


def _attractor_dots(axes, attractors):
    varying = attractors["label"].isin([UNSETTLED, *APERIODIC])
    for (kind, style), rows in zip(DOTS.items(), (attractors[~varying], attractors[varying]), strict=True):
        axes.plot(rows["p"], rows["C2"], linestyle="none", markeredgewidth=0, zorder=1, **style, label=kind)
