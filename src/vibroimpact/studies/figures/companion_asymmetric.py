"""Companion: the manifold with its asymmetric branch, and exact pairs of mirror images followed to small epsilon."""

from itertools import chain, pairwise, product, repeat
from string import ascii_lowercase

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from scipy.optimize import brentq

from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.figures.plotting.style import (
    BLACK,
    DOUBLE_COLUMN,
    GREY,
    LIGHT_GREY,
    STABLE,
    UNSTABLE,
    heading,
    new_figure,
    styled,
)
from vibroimpact.studies.figures.plotting.regime_colours import COLOURS
from vibroimpact.studies.regimes import asymmetric_limit
from vibroimpact.studies.regimes.classification import ASYMMETRIC
from vibroimpact.studies.regimes.epsilon_limit import order
from vibroimpact.studies.theory import branch
from vibroimpact.studies.theory.asymmetric_points import fixed_points
from vibroimpact.studies.theory.relaxation import lost_at, relax
from vibroimpact.system.chapter import CASES
from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C, lower_limit

SPEC = {
    "title": "The asymmetric branch of the manifold",
    "caption": "Motions whose balls take unequal times for their two flights. a: where symmetry breaks, at :math:`C_i "
        r"= \pi^2/(\pi^2-4)`, the stable part of the manifold continues as an asymmetric branch. Filled marks: exact "
        r"orbits at the :math:`\varepsilon` of the cases, each joined to the fixed point of the slow flow (circle) "
        r"that it approaches as :math:`\varepsilon` decreases, if any. Other panels, one per case: :math:`v^2` of "
        r"these orbits against :math:`\varepsilon`; :math:`v` is the difference of the flight times over the period. "
        r"A circle in the grey area is no motion: that orbit becomes symmetric before :math:`\varepsilon = 0`.",
    "alt": "First panel: a V-shaped curve of B against C, bold where stable. A green curve rises steeply from its "
        "right arm, with circles on it and diamonds and triangles beside it. Other panels: lines of v squared "
        "against epsilon from these marks, labelled stable or unstable, to circles at epsilon 0; the lowest line "
        "crosses zero just before.",
    "equations": [r"C = \frac{1 - v^2}{1 - v^2 - G}, \qquad B = \frac{\sqrt{G^2 + \rho^2}}{(1 - v^2 - G)\cos\frac{\pi "
        r"v}{2}}, \qquad G = \frac{2v}{\pi}\cot\frac{\pi v}{2}"],
    "method": "closed form, fixed points, and exact asymmetric responses continued to small epsilon",
    "columns": {
        "series": {"meaning": "piece of the manifold", "values": ["symmetric, left", "symmetric, stable",
            "symmetric, right", "asymmetric, stable", "asymmetric, right"]},
        "C, B": {"compared": "algebra"},
    },
    "tables": {
        "modules": {
            "file": "results/figures/companion_asymmetric.modules.csv",
            "about": "Modules with unequal flights in the plane of `companion_asymmetric`, for fixed points and for "
                "exact orbits, one of each pair of mirror images.",
            "columns": {
                "case": {}, "series": {"meaning": "type of solution", "values": ["fixed point", "exact orbit"]},
                "label": {"meaning": "label in `asymmetric_fixed_points.csv` or `orbits.csv`", "unit": "text"},
                "module": {"meaning": "module, 1 or 2", "unit": "number", "compared": "algebra"},
                "C, B": {"compared": "roots"},
                "C_limit, B_limit": {"meaning": "C and B of the fixed point to which an exact orbit leads as epsilon "
                    "falls; blank if there is none and for fixed points", "unit": "dimensionless", "compared": "roots"},
            },
        },
        "pairs": {
            "file": "results/figures/companion_asymmetric.pairs.csv",
            "about": r"Asymmetry of the flights of exact pairs of orbits as $\varepsilon$ decreases.",
            "columns": {
                "case": {}, "label": {"meaning": "label in `orbits.csv`", "unit": "text"},
                "exact": {"meaning": r"verdict by the multipliers at the $\varepsilon$ of the case"},
                "epsilon": {"compared": "algebra"},
                "squared": {"meaning": "$v^2$ of the module with the more unequal flights", "unit": "dimensionless",
                    "compared": "roots"},
                "limit": {"meaning": "the same for the fixed point that is the limit of the pair; blank if there is "
                    "none",
                    "unit": "dimensionless", "compared": "roots"},
            },
        },
        "points": {
            "file": "results/asymmetric_fixed_points.csv",
            "about": "All fixed points of the slow flow in which a ball takes unequal times for its two flights, for "
                r"all cases, with $C_1, C_2 \ge 0$ ([derivation](derivation.md), section 11), and the exact pairs "
                r"whose limits they are for $\varepsilon \to 0$.",
            "columns": {
                "case": {}, "label": {"meaning": "U1, U2, ... by ascending $C_1$", "unit": "text"},
                "squared1, squared2": {"meaning": "$v_i^2$, where $v_i$ is the difference of the two flight times of "
                    "ball $i$ over the period, 0 if they are equal; negative for solutions on the continuation of the "
                    "branch beyond symmetry breaking, which are no motions at leading order", "unit": "dimensionless"},
                "C1, C2, B1, B2, psi1, psi2": {},
                "real": {"meaning": r"True for a motion at leading order, $v_i^2 \ge 0$", "unit": "true or false"},
                "admissible": {"meaning": "True for a motion in which, at leading order, both balls stay between their "
                    "walls",
                    "unit": "true or false"},
                "impact_map": {"meaning": "verdict of Masri's analysis for equal and unequal flights on the impact "
                    r"maps of both modules, with constant $B_i$ and $\phi_i$", "unit": "text", "values": ["stable",
                    "unstable", "undecided"]},
                "slow_flow": {"meaning": "verdict of the slow flow on this branch: stable if the real parts of all "
                    "eigenvalues are negative", "unit": "text", "values": ["stable", "unstable", "undecided"]},
                "modulus": {"meaning": "largest modulus of the multipliers over a forcing period, predicted by impact "
                    "maps and slow flow", "unit": "dimensionless"},
                "lost_at": {"meaning": "for a point that is stable in the slow flow, factor of both forces, below 1, "
                    "at which its symmetric module reaches the fold of the manifold; blank if there is none above 0.5",
                    "unit": "dimensionless"},
                "orbit": {"meaning": "label in `orbits.csv` of the exact orbit (one of two mirror images) whose limit "
                    "is this point; blank if there is none", "unit": "text"},
                "distance": {"meaning": r"distance of this orbit from the point at the $\varepsilon$ of the case: norm "
                    "of the difference in $C_1$, $C_2$, $v_1^2$, $v_2^2$ and the phases [radians] half-way between the "
                    "impacts of each module", "unit": "dimensionless"},
                "onset": {"meaning": r"$\varepsilon$ at which the exact pair branches off a symmetric orbit; 0 if it "
                    r"reaches $\varepsilon = 0$", "unit": "dimensionless"},
                "order": {"meaning": r"exponent $p$ of distance $\sim \varepsilon^p$, fitted to the smallest "
                    r"$\varepsilon$", "unit": "dimensionless"},
                "uncertainty": {"meaning": "standard error of `order`", "unit": "dimensionless"},
                "slow_error": {"meaning": "largest error of a predicted slow rate at `at_epsilon`, "
                    r"$\lvert\log\mu/(2\pi\varepsilon/\Omega) - \lambda\rvert$", "unit": "dimensionless"},
                "fast_error": {"meaning": "largest error of a predicted fast multiplier at `at_epsilon`",
                    "unit": "dimensionless"},
                "at_epsilon": {"meaning": r"smallest $\varepsilon$ to which the pair was followed",
                    "unit": "dimensionless"},
            },
        },
        "relaxation": {
            "file": "results/regimes/relaxation.csv",
            "about": "Modulated response in the slow flow: drift to the fold of the manifold and return at $B = 1$ "
                "([derivation](derivation.md), section 12), for every case, one row per module.",
            "columns": {
                "case, module": {},
                "burst": {"meaning": "mean length of a resonant interval; blank if none ends",
                    "unit": "forcing periods"},
                "share": {"meaning": "share of the time in resonance", "unit": "share"},
                "largest": {"meaning": "largest $B_i$", "unit": "dimensionless"},
            },
        },
    },
}  # fmt: skip

_COLOUR = {"color": COLOURS[ASYMMETRIC]}
PIECES = {
    "symmetric, left": UNSTABLE,
    "symmetric, stable": STABLE,
    "symmetric, right": UNSTABLE,
    "asymmetric, stable": STABLE | _COLOUR,
    "asymmetric, right": UNSTABLE | _COLOUR,
}
POINT, ORBIT = "fixed point", "exact orbit"
_MARK = {"color": BLACK, "linestyle": "none", "zorder": 3}
POINT_MARK = _MARK | {"marker": "o", "markerfacecolor": "white", "markersize": 4.6}
ORBIT_MARKS = [_MARK | {"marker": marker, "markersize": size} for marker, size in (("D", 3.6), ("^", 5.0), ("s", 4.0))]
"""Marks of the exact orbits of the first, second and further cases."""
NO_MOTION = -0.06
"""Lower end of the axis of v^2, unless a fixed point lies lower; the area below 0 is grey."""
C_MARGIN = 0.1
"""Margin, in C, around the asymmetric branch and the markers in the panel of the manifold."""
UNEQUAL_FROM = 1e-3
"""Value of v^2 above which the two flights of a ball count as unequal."""
_PHASES, _SPEEDS = (
    [f"{what}{module}_{wall}" for module, wall in product((1, 2), ("plus", "minus"))] for what in ("phase", "speed")
)
MODULES = ["case", "series", "label", "module", "C", "B", "C_limit", "B_limit"]
COLUMNS = ["case", "label", "squared1", "squared2", "C1", "C2", "B1", "B2", "psi1", "psi2"]
JUDGED = ["real", "admissible", "impact_map", "slow_flow", "modulus"]
RELAXATION_CYCLES = 400, 100
"""Cycles of the slow flow that are observed, and cycles of the transient before them."""
COMPARED = ["lost_at", "orbit", "distance", "onset", "order", "uncertainty", "slow_error", "fast_error", "at_epsilon"]


def compute(systems: dict, orbits: pd.DataFrame, kappa, epsilon, values: int, fit_below: float, C_max: float) -> dict:
    """Return the manifold, all asymmetric fixed points of the cases, and the exact pairs of orbits that lead to them.

    Parameters
    ----------
    systems : dict
        Case -> system.
    orbits : DataFrame
        Rows of `verdict_table.orbit_rows` for all cases.
    kappa
        Restitution coefficient of the manifold; cases with another kappa are left out.
    epsilon, values
        Range and number of values of epsilon, evenly on a log scale. Pairs are followed to the
        values below the epsilon of their case.
    fit_below : float
        Largest epsilon in the fit of the order with which the distance between orbit and fixed point falls.
    C_max : float
        Largest C of the symmetric branch.

    Returns "csv", the manifold: columns series (a piece of a branch), C, B; "modules", those with unequal flights:
    case, series (fixed point or exact orbit), label, module, C, B, C_limit, B_limit; "pairs": case, label, exact,
    epsilon, squared (the larger v^2), limit (the larger v^2 of the fixed point to which the pair leads); "points", a
    row per fixed point; and "relaxation", statistics of the modulated response by the slow flow, a row per module.
    """
    systems = {case: system for case, system in systems.items() if system.kappa == kappa}
    modules, pairs, rows, relaxed = [], [], [], []
    for case, system in systems.items():
        points, here = fixed_points(system), orbits[orbits["case"] == case]
        falling = np.sort(np.geomspace(*epsilon, values))[::-1]
        ways = {
            label: asymmetric_limit.follow(system, root, falling[falling < system.epsilon])
            for label, root in _pairs(system, here)
        }
        ends = {label: asymmetric_limit.leads_to(way, points) for label, way in ways.items()}
        for number, point in enumerate(points, start=1):
            label = next((name for name, end in ends.items() if end is point), "")
            rows.append(_row(system, case, f"U{number}", point, label, ways.get(label), fit_below))
            modules += _in_plane(case, POINT, f"U{number}", None, point.C, point.B, point.squared)
        for label, way in ways.items():
            (verdict,) = here.loc[here["label"] == label, "exact"]
            limit = np.nan if ends[label] is None else ends[label].squared[ends[label].asymmetric].max()
            pairs += [(case, label, verdict, each.system.epsilon, each.place[2:4].max(), limit) for each in way]
            places = way[0].place[:2], way[0].box_amplitudes, way[0].place[2:4]
            modules += _in_plane(case, ORBIT, label, ends[label], *places)
        found = relax(system, *RELAXATION_CYCLES)
        relaxed += [[case, i + 1, found.bursts[i], found.share[i], found.largest[i]] for i in (0, 1)]
    return {
        "csv": _manifold(kappa, C_max),
        "modules": pd.DataFrame(modules, columns=MODULES),
        "pairs": pd.DataFrame(pairs, columns=["case", "label", "exact", "epsilon", "squared", "limit"]),
        "points": pd.DataFrame(rows, columns=[*COLUMNS, *JUDGED, *COMPARED]),
        "relaxation": pd.DataFrame(relaxed, columns=["case", "module", "burst", "share", "largest"]),
    }


def _manifold(kappa, C_max):
    """Return the pieces of the symmetric and of the asymmetric branch of the manifold.

    The asymmetric branch ends where its B equals the B of the symmetric branch at C_max.
    """
    edges = (0.0, lower_limit(kappa), SYMMETRY_BREAKING_C, C_max)
    r, end = rho(kappa), branch.period_doubling(kappa)
    symmetric = [np.linspace(*ends, 101) for ends in pairwise(edges)]
    last = brentq(lambda squared: branch.amplitudes(squared, kappa)[1] - B_of_C(C_max, r), 0.0, 1 - 1e-9)
    squared = np.linspace(0, min(end, last), 101), np.linspace(min(end, last), last, 101)
    places = [(C, B_of_C(C, r)) for C in symmetric] + [branch.amplitudes(x, kappa) for x in squared]
    return pd.concat(
        pd.DataFrame({"series": name, "C": C, "B": B}) for name, (C, B) in zip(PIECES, places, strict=True)
    )


def _pairs(system, orbits):
    """For each mirror pair of orbits with positive C, yield the label and the root (6,) of one of both orbits.

    The root is one of the equations for asymmetric orbits (`AsymmetricConditions`).
    """
    rows = orbits[~orbits["symmetric"].astype(bool) & ~(orbits["C1"] <= 0) & ~(orbits["C2"] <= 0)]
    one_each = rows.loc[~rows[["C1", "C2"]].round(7).duplicated()]
    for _, row in one_each.iterrows():
        speeds = row[_SPEEDS].to_numpy(float).reshape(2, 2)
        root = np.concatenate([row[_PHASES].to_numpy(float) * system.period, speeds.sum(axis=1)])
        yield row["label"], np.nan_to_num(root)


def _in_plane(case, series, label, limit, *places):
    """Yield a row for each module with unequal flights, of a fixed point or of an exact orbit (`series`).

    limit: the fixed point to which the orbit leads, or None. places: C, B and v^2 of both modules, each (2,).
    """
    ends = [[np.nan] * 2] * 2 if limit is None else np.transpose([limit.C, limit.B])
    for module, C, B, squared, end in zip((1, 2), *places, ends, strict=True):
        if squared > UNEQUAL_FROM:
            yield case, series, label, module, C, B, *end


def _row(system, case, name, point, label, way, fit_below):
    kappa, slow_time = system.kappa, system.epsilon * system.period
    slow = np.abs(np.exp(point.slow_eigenvalues * slow_time))
    row = [case, name, *point.squared, *point.C, *point.B, *point.psi, point.real, point.admissible(kappa)]
    row += [point.fast_verdict(kappa), point.slow_verdict(), max(*slow, *np.abs(point.fast(kappa)))]
    row.append(lost_at(system, point) if point.slow_verdict() == "stable" else np.nan)
    if way is None:
        return [*row, "", *[np.nan] * (len(COMPARED) - 2)]
    distance = np.array([np.linalg.norm(asymmetric_limit.offset(station, point)) for station in way])
    epsilon = np.array([station.system.epsilon for station in way])
    small = epsilon < fit_below
    fitted = order(epsilon[small], distance[small]) if np.count_nonzero(small) > 1 else (np.nan, np.nan)
    last = asymmetric_limit.distance_to_limit(way[-1], point)
    onset = asymmetric_limit.onset(way) if not point.real else 0.0
    return [*row, label, distance[0], onset, *fitted, last.slow_error, last.fast_error, last.epsilon]


@styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`: the manifold with both branches, and v^2 of the pairs against epsilon by case."""
    pairs = tables["pairs"]
    marks = dict(zip(dict.fromkeys(pairs["case"]), chain(ORBIT_MARKS, repeat(ORBIT_MARKS[-1])), strict=False))
    figure = new_figure(DOUBLE_COLUMN, 84.0)
    left, *others = figure.subplots(1, 1 + len(marks), squeeze=False, width_ratios=[1.5, *[1] * len(marks)])[0]
    for axes in others[1:]:
        axes.sharey(others[0])
        axes.tick_params(labelleft=False)
    heading(left, "a", "both branches of the manifold")
    names = {left: _draw_manifold(left, tables["csv"], tables["modules"], marks)}
    for axes, letter, (case, mark) in zip(others, ascii_lowercase[1:], marks.items(), strict=False):
        heading(axes, letter, f"exact orbits, {_title(case)}")
        _draw_case(axes, pairs[pairs["case"] == case], mark)
    if marks:
        others[0].set_ylabel("$v^2$ ($v$: difference of flights / period)")
        others[0].set_ylim(min(NO_MOTION, 1.15 * pairs["limit"].min()), 1.15 * pairs["squared"].max())
    lines = [Line2D([], [], label=label, **style) for label, style in (("stable", STABLE), ("unstable", UNSTABLE))]
    handles = [*left.get_legend_handles_labels()[0], *lines]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), columnspacing=1.2)
    name_curves(figure, names)
    return figure


def _title(case):
    return f"{case} forces" if case in CASES else f"case {case}"


def _draw_manifold(axes, pieces, modules, marks):
    """Draw the part of the manifold around its asymmetric branch; return the name and the line of each branch.

    A thin line leads from each fixed point to the exact orbit that approaches it as epsilon falls.
    """
    lines = {}
    for series, style in PIECES.items():
        piece = pieces[pieces["series"] == series]
        lines[series] = axes.plot(piece["C"], piece["B"], **style)
    orbits, points = (modules[modules["series"] == series] for series in (ORBIT, POINT))
    axes.plot(orbits[["C", "C_limit"]].T, orbits[["B", "B_limit"]].T, color=GREY, linewidth=0.7)
    places = pd.concat([points[["C", "B"]], orbits[["C_limit", "B_limit"]].set_axis(["C", "B"], axis=1)])
    axes.plot(places["C"], places["B"], label="fixed points", **POINT_MARK)
    for case, mark in marks.items():
        here = orbits[orbits["case"] == case]
        axes.plot(here["C"], here["B"], label=f"exact orbits, {_title(case)}", **mark)
    # Figure 10.4 shows the rest of the manifold.
    near = pd.concat([modules["C"], pieces["C"][pieces["series"].str.startswith("asymmetric")]])
    axes.set(xlim=(near.min() - C_MARGIN, near.max() + C_MARGIN), xlabel="$C_i$", ylabel="$B_i$")
    seen = pd.concat([pieces["B"][pieces["C"].between(*axes.get_xlim())], modules["B"]])
    axes.set_ylim(seen.min() - 0.05, seen.max() + 0.1)
    return [("asymmetric", lines["asymmetric, right"]), ("symmetric", lines["symmetric, stable"])]


def _draw_case(axes, pairs, mark):
    for (_, verdict), way in pairs.groupby(["label", "exact"], sort=False):
        axes.plot(way["epsilon"], way["squared"], **STABLE if verdict == "stable" else UNSTABLE)
        start = way.iloc[0][["epsilon", "squared"]]
        axes.plot(*start, clip_on=False, **mark)
        axes.annotate(verdict, start, (-5, 4), textcoords="offset points", ha="right")
    ends = pairs.drop_duplicates("label")["limit"]
    axes.plot(np.zeros(len(ends)), ends, clip_on=False, **POINT_MARK)
    axes.axhspan(-1, 0, color=LIGHT_GREY, linewidth=0, zorder=0)
    axes.text(0.95, -0.01, "no motion", ha="right", va="top", transform=axes.get_yaxis_transform())
    axes.set(xlabel=r"$\varepsilon$", xlim=(0, None))
    axes.locator_params(axis="x", nbins=3)
    axes.xaxis.set_major_formatter("{x:g}")
