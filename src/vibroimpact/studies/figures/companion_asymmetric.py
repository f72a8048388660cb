"""Companion: the manifold with its asymmetric branch, and exact asymmetric orbits as epsilon tends to 0."""

from itertools import cycle, pairwise, product

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from scipy.optimize import brentq

from vibroimpact.figures.plotting import style
from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.studies.figures.plotting.regime_colours import COLOURS
from vibroimpact.studies.regimes import asymmetric_limit
from vibroimpact.studies.regimes.classification import ASYMMETRIC
from vibroimpact.studies.theory import branch
from vibroimpact.studies.theory.asymmetric_points import fixed_points
from vibroimpact.studies.theory.relaxation import lost_at
from vibroimpact.system.chapter import CASES
from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C, lower_limit

SPEC = {
    "title": "The asymmetric branch of the manifold",
    "caption": "Motions whose balls take unequal times for their two flights. a: where symmetry breaks, at :math:`C_i "
        r"= \pi^2/(\pi^2-4)`, the stable part of the manifold continues as an asymmetric branch. Circles: fixed points "
        r"of the slow flow. b: exact orbits from the :math:`\varepsilon` of the cases (filled marks) down to the fixed "
        r"points, to :math:`v = 0`, where they become symmetric, or to where two orbits meet and vanish. :math:`v` is "
        r"the difference of the flight times over the period. Lines in b show the stability at the :math:`\varepsilon` "
        "of the cases.",
    "alt": "First panel: a rising line of B against C, bold up to the point where a steeper green curve branches "
        "off, with two circles on it. Second panel: lines of flight asymmetry against epsilon. Two end in "
        "circles at epsilon 0, two stable ones fall to zero just before, two others meet, as written at the lines.",
    "equations": [r"C = \frac{1 - v^2}{1 - v^2 - G}, \qquad B = \frac{\sqrt{G^2 + \rho^2}}{(1 - v^2 - G)\cos\frac{\pi "
        r"v}{2}}, \qquad G = \frac{2v}{\pi}\cot\frac{\pi v}{2}"],
    "method": "closed form, fixed points, and exact asymmetric responses continued to small epsilon",
    "columns": {
        "series": {"meaning": "piece of the manifold, or fixed point with unequal flights",
            "values": ["symmetric, left", "symmetric, stable", "symmetric, right", "asymmetric, stable",
                "asymmetric, right", "fixed point"]},
        "C, B": {"compared": "algebra"},
    },
    "tables": {
        "pairs": {
            "file": "results/figures/companion_asymmetric.pairs.csv",
            "about": r"Asymmetry of the flights of exact pairs of orbits as $\varepsilon$ decreases.",
            "columns": {
                "case": {}, "label": {"meaning": "label in `orbits.csv`", "unit": "text"},
                "exact": {"meaning": r"verdict by the multipliers at the $\varepsilon$ of the case"},
                "epsilon": {"meaning": r"$\varepsilon$; 0 for the fixed point to which the pair leads, if any",
                    "unit": "dimensionless", "compared": "roots"},
                "asymmetry": {"meaning": "$\\lvert v\\rvert$ of the module with the more unequal flights; 0 where the "
                    "pair branches off a symmetric orbit", "unit": "dimensionless", "compared": "roots"},
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
                "onset": {"meaning": r"$\varepsilon$ at which the exact pair branches off a symmetric orbit; 0 if it "
                    r"reaches $\varepsilon = 0$", "unit": "dimensionless"},
            },
        },
    },
}  # fmt: skip

_COLOUR = {"color": COLOURS[ASYMMETRIC]}
PIECES = {
    "symmetric, left": style.UNSTABLE,
    "symmetric, stable": style.STABLE,
    "symmetric, right": style.UNSTABLE,
    "asymmetric, stable": style.STABLE | _COLOUR,
    "asymmetric, right": style.UNSTABLE | _COLOUR,
}
POINT = "fixed point"
_MARK = {"linestyle": "none", "zorder": 3}
POINT_MARK = _MARK | {"color": style.BLACK, "marker": "o", "markerfacecolor": "white", "markersize": 4.6}
ORBIT_MARKS = [
    _MARK | {"color": colour, "marker": marker, "markersize": size}
    for colour, marker, size in ((style.BLACK, "D", 3.6), (style.GREY, "^", 5.0), (style.BLACK, "s", 4.0))
]
"""Marks of the exact orbits of the first, second and third case; then they repeat."""
ENDS = "to a fixed point", "become symmetric", "two orbits meet"
"""Ways in which exact orbits end as epsilon falls."""
C_MARGIN = 0.1
"""Margin, in C, around the asymmetric branch and the fixed points in the panel of the manifold."""
_PHASES, _SPEEDS = (
    [f"{what}{module}_{wall}" for module, wall in product((1, 2), ("plus", "minus"))] for what in ("phase", "speed")
)
COLUMNS = ["case", "label", "squared1", "squared2", "C1", "C2", "B1", "B2", "psi1", "psi2"]
JUDGED = ["real", "admissible", "impact_map", "slow_flow", "modulus", "lost_at", "orbit", "onset"]


def compute(systems: dict, orbits: pd.DataFrame, kappa, epsilon, values: int, C_max: float) -> dict:
    """Return the manifold, the asymmetric fixed points, and exact asymmetric orbits as epsilon decreases.

    Parameters
    ----------
    systems : dict
        System of each case, by name of the case.
    orbits : DataFrame
        Rows of `verdict_table.orbit_rows` for all cases.
    kappa
        Restitution coefficient of the manifold. Cases with another kappa are left out.
    epsilon
        Both ends of the range of epsilon.
    values : int
        Number of values of epsilon, evenly spaced on a log scale.
    C_max : float
        Largest C of the symmetric branch.

    Returns
    -------
    dict
        The tables in SPEC. If the limit of an orbit is known, the last row of this orbit in "pairs" is the limit.
    """
    pairs, rows, places = [], [], []
    for case, system in systems.items():
        if system.kappa != kappa:
            continue
        points, here, origins = fixed_points(system), orbits[orbits["case"] == case], {}
        falling = np.sort(np.geomspace(*epsilon, values))[::-1]
        for row, root in _pairs(system, here):
            way = asymmetric_limit.follow(system, root, falling[falling < system.epsilon])
            end = asymmetric_limit.leads_to(way, points)
            followed = [(station.system.epsilon, np.sqrt(station.place[2:4].max())) for station in way]
            if end is not None:
                onset = 0.0 if end.real else asymmetric_limit.onset(way)
                followed.append((onset, np.sqrt(max(0.0, end.squared[end.asymmetric].max()))))
                origins.setdefault(end, (row["label"], onset))
            pairs += [(case, row["label"], row["exact"], *place) for place in followed]
        rows += [
            _row(system, case, f"U{n}", point, *origins.get(point, ("", np.nan))) for n, point in enumerate(points, 1)
        ]
        places += [
            place for point in points if point.real for place in np.transpose([point.C, point.B])[point.asymmetric]
        ]
    shown = pd.DataFrame(places, columns=["C", "B"], dtype=float).assign(series=POINT)
    return {
        "csv": pd.concat([*_manifold(kappa, C_max), shown], ignore_index=True),
        "pairs": pd.DataFrame(pairs, columns=["case", "label", "exact", "epsilon", "asymmetry"]),
        "points": pd.DataFrame(rows, columns=[*COLUMNS, *JUDGED]),
    }


def _manifold(kappa, C_max):
    """Yield the pieces of the symmetric and of the asymmetric branch of the manifold.

    The symmetric branch ends at C = C_max. Both branches end at the same value of B.
    """
    edges = (0.0, lower_limit(kappa), SYMMETRY_BREAKING_C, C_max)
    r, end = rho(kappa), branch.period_doubling(kappa)
    symmetric = [np.linspace(*ends, 101) for ends in pairwise(edges)]
    last = brentq(lambda squared: branch.amplitudes(squared, kappa)[1] - B_of_C(C_max, r), 0.0, 1 - 1e-9)
    squared = np.linspace(0, min(end, last), 101), np.linspace(min(end, last), last, 101)
    places = [(C, B_of_C(C, r)) for C in symmetric] + [branch.amplitudes(x, kappa) for x in squared]
    for name, (C, B) in zip(PIECES, places, strict=True):
        yield pd.DataFrame({"series": name, "C": C, "B": B})


def _pairs(system, orbits):
    """Yield one orbit of each pair of mirror images, as (row, root).

    row: row of the orbit in the table `orbits`.
    root: solution of `AsymmetricConditions` for the orbit, shape (6,).
    """
    rows = orbits[~orbits["symmetric"].astype(bool) & ~(orbits["C1"] <= 0) & ~(orbits["C2"] <= 0)]
    one_each = rows.loc[~rows[["C1", "C2"]].round(7).duplicated()]
    for _, row in one_each.iterrows():
        speeds = row[_SPEEDS].to_numpy(float).reshape(2, 2)
        root = np.concatenate([row[_PHASES].to_numpy(float) * system.period, speeds.sum(axis=1)])
        yield row, np.nan_to_num(root)


def _row(system, case, name, point, label, onset):
    kappa, slow_time = system.kappa, system.epsilon * system.period
    slow = np.abs(np.exp(point.slow_eigenvalues * slow_time))
    row = [case, name, *point.squared, *point.C, *point.B, *point.psi, point.real, point.admissible(kappa)]
    row += [point.fast_verdict(kappa), point.slow_verdict(), max(*slow, *np.abs(point.fast(kappa)))]
    return [*row, lost_at(system, point) if point.slow_verdict() == "stable" else np.nan, label, onset]


@style.styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`: the manifold with both branches, and the asymmetry of orbits against epsilon."""
    figure = style.new_figure(style.DOUBLE_COLUMN, 84.0)
    left, right = figure.subplots(1, 2)
    style.heading(left, "a", "both branches of the manifold")
    style.heading(right, "b", r"exact asymmetric orbits as $\varepsilon$ falls")
    names = _draw_manifold(left, tables["csv"])
    ends = _draw_pairs(right, tables["pairs"])
    looks = {"stable": style.STABLE, "unstable": style.UNSTABLE}
    lines = [Line2D([], [], label=label, **look) for label, look in looks.items()]
    marks = [handle for axes in (left, right) for handle in axes.get_legend_handles_labels()[0]]
    figure.legend(handles=[*marks, *lines], loc="outside lower center", ncols=len(marks) + 2, columnspacing=1.2)
    figure.get_layout_engine().set(wspace=0.06)
    name_curves(figure, {left: names})
    name_curves(figure, {right: ends}, fontsize=8, color=style.BLACK)
    return figure


def _draw_manifold(axes, table):
    """Draw the part of the manifold around its asymmetric branch; return the name and the line of each branch."""
    lines = {}
    for series, look in PIECES.items():
        piece = table[table["series"] == series]
        lines[series] = axes.plot(piece["C"], piece["B"], **look)
    points = table[table["series"] == POINT]
    axes.plot(points["C"], points["B"], label="fixed points", **POINT_MARK)
    # The panel shows only this part of the manifold, since figure 10.4 shows the rest.
    near = table["C"][~table["series"].str.startswith("symmetric")]
    axes.set(xlim=(near.min() - C_MARGIN, near.max() + C_MARGIN), xlabel="$C_i$", ylabel="$B_i$")
    seen = table["B"][table["C"].between(*axes.get_xlim())]
    axes.set_ylim(seen.min() - 0.05, seen.max() + 0.1)
    return [("asymmetric", lines["asymmetric, right"]), ("symmetric", lines["symmetric, stable"])]


def _draw_pairs(axes, pairs):
    """Draw the asymmetry of the orbits against epsilon, and return the drawn lines.

    The lines are grouped by the way in which their orbits end (an entry of ENDS).
    """
    last, named = pairs.drop_duplicates(["case", "label"], keep="last"), {}
    meets = last.round({"asymmetry": 1}).duplicated(["case", "epsilon", "asymmetry"], keep=False)
    ends = pd.Series(np.select([last["epsilon"] == 0, last["asymmetry"] == 0, meets], ENDS, ""), last.index)
    for (case, mine), mark in zip(pairs.groupby("case", sort=False), cycle(ORBIT_MARKS), strict=False):
        for (_, verdict), way in mine.groupby(["label", "exact"], sort=False):
            look = (style.STABLE if verdict == "stable" else style.UNSTABLE) | {"color": mark["color"]}
            line = axes.plot(way["epsilon"], way["asymmetry"], **look)
            named.setdefault(ends[way.index[-1]], []).extend(line)
        label = f"exact orbits, {case} forces" if case in CASES else f"exact orbits, case {case}"
        here = mine.drop_duplicates("label")
        axes.plot(here["epsilon"], here["asymmetry"], clip_on=False, label=label, **mark)
    points = last[last["epsilon"] == 0]
    if len(points):  # with clip_on=False, a line without data would spoil the layout
        axes.plot(points["epsilon"], points["asymmetry"], clip_on=False, **POINT_MARK)
    label = r"difference of flight times / period, $\vert v\vert$"
    axes.set(xlabel=r"$\varepsilon$", ylabel=label, xlim=(0, None), ylim=(0, None))
    return [(end, named[end]) for end in ENDS if end in named]
