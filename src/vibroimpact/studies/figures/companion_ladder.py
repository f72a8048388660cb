"""Companion: from leading order to the exact orbit, level by level: error, cost, and the cheapest that is right."""

from collections import Counter

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.accuracy.verdict_table import NO_ORBIT, partners
from vibroimpact.figures.plotting.style import BLACK, GREY, HALO, LEVEL, SINGLE_COLUMN, heading, new_figure, styled
from vibroimpact.studies.regimes import two_terms
from vibroimpact.studies.regimes.hierarchy import EXACT, LEADING, TWO_TERMS, error, harmonics_name, levels, of_harmonics
from vibroimpact.studies.regimes.midpoint_grid import plane_of_forces
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C, SYMMETRY_BREAKING_SLOPE

SPEC = {
    "title": "From leading order to the exact orbit, level by level",
    "caption": "How much model it needs: the largest relative error of :math:`C_i` over all symmetric motions of the "
        "three cases, against the number of terms of the boxes' response that are summed to find them: leading order; "
        "two terms; N odd harmonics of the balls' force with exact receptances (grey); the same where the part of the "
        "free mass is kept in closed form, so that N harmonics are those of :math:`U_i`. Dotted: terms that the exact "
        "orbits need.",
    "alt": "Error over cost on logarithmic axes; leading order at the upper left, two terms far below it, and two "
        "lines of marks for growing numbers of harmonics that fall, the one of harmonics of U ten times lower.",
    "method": "fixed points to leading and next order, N harmonics with exact receptances, exact symmetric responses",
    "columns": {
        "case": {},
        "series": {"meaning": "kind of level", "values": ["theory", "harmonics of U", "harmonics of the force",
            "exact"]},
        "level": {"meaning": "leading order; two terms; N harmonics; exact", "unit": "text"},
        "cost": {"meaning": "terms of the boxes' response that are summed until all motions are found",
            "unit": "number", "compared": "algebra"},
        "error": {"meaning": "largest error of $C_1$, $C_2$ over the larger of both, of all motions; blank if their "
            "number is wrong, and of exact orbits", "unit": "dimensionless", "compared": "logarithm"},
    },
    "tables": {
        "plane": {
            "file": "results/figures/companion_ladder.plane.csv",
            "about": "Over the plane of forces, the lowest level that has all symmetric motions, and no other, to 5 % "
                "and to 1 %.",
            "columns": {
                "f10_hat, f20_hat": {"compared": "algebra"},
                "to 5 %, to 1 %": {"meaning": "the level", "unit": "text", "compared": "counts of a map"},
            },
        },
        "verdicts": {
            "file": "results/regimes/ladder_verdicts.csv",
            "about": "What each level of `companion_ladder` says of its motions over the plane of forces, and what is "
                "true.",
            "columns": {
                "rung": {"meaning": "leading order; two terms; N harmonics of $U_i$; exact", "unit": "text"},
                "said": {"meaning": "the verdict of the level", "unit": "text"},
                "true": {"meaning": "the verdict of the multipliers of the exact orbit, or no orbit", "unit": "text"},
                "motions": {"meaning": "number of motions", "unit": "number", "compared": "algebra"},
            },
        },
        "limits": {
            "file": "results/regimes/ladder_limits.csv",
            "about": "Limits of the symmetric motions to leading and next order, and exact (docs/derivation.md).",
            "columns": {
                "limit": {"meaning": "C at symmetry breaking; f20_hat at the fold", "unit": "text"},
                "leading": {"meaning": "its value at leading order", "unit": "dimensionless", "compared": "roots"},
                "slope": {"meaning": r"its change per $\varepsilon$", "unit": "dimensionless", "compared": "roots"},
                "two_terms": {"meaning": r"to the next order, at the $\varepsilon$ of the system",
                    "unit": "dimensionless", "compared": "roots"},
                "exact": {"meaning": "of exact orbits", "unit": "dimensionless", "values": [], "compared": "roots"},
            },
        },
    },
}  # fmt: skip

THEORY, OF_U, OF_FORCE = "theory", "harmonics of U", "harmonics of the force"
LIMITS = {"to 5 %": 0.05, "to 1 %": 0.01}
STYLES = {
    THEORY: {"linestyle": "none", "marker": "D", "markersize": 5, "markerfacecolor": "white", "color": BLACK},
    OF_FORCE: {"marker": "o", "markersize": 4, "linewidth": 0.8, "color": GREY, "linestyle": "--"},
    OF_U: {"marker": "s", "markersize": 4, "linewidth": 1.0, "color": BLACK},
}
_IN_PLANE = 3


def compute(systems: dict, harmonics, f10_range, f20_range, points: int, fold_range) -> dict:
    """Errors and costs of the levels for every case, the cheapest right level over the plane, verdicts and limits.

    Args:
        systems: case -> system; the plane and the fold have the parameters of the first.
        harmonics: of the levels, odd, ascending; the first three also over the plane.
        fold_range: of f20_hat, with one fold.

    Returns "csv": columns case, series (kind of level), level, cost, error (blank where the number of
    motions is wrong); "plane": f10_hat, f20_hat, and the lowest level that is right within each of LIMITS; "verdicts":
    rung, said, true, motions, over the plane; "limits": limit, leading, slope, two_terms, exact.
    """
    system = next(iter(systems.values()))
    plane = {
        (f10, f20): levels(system.with_(f10_hat=f10, f20_hat=f20), harmonics[:_IN_PLANE])
        for f10, f20 in plane_of_forces(f10_range, f20_range, points)
    }
    cases = [row for case, one in systems.items() for row in _of_case(case, one, harmonics)]
    cheapest = [(*place, *(_cheapest(found, limit) for limit in LIMITS.values())) for place, found in plane.items()]
    return {
        "csv": pd.DataFrame(cases, columns=["case", "series", "level", "cost", "error"]),
        "plane": pd.DataFrame(cheapest, columns=["f10_hat", "f20_hat", *LIMITS]),
        "verdicts": verdicts(plane.values()),
        "limits": _limits(system, fold_range),
    }


def _of_case(case, system, harmonics):
    found = levels(system, harmonics)
    exact = found[EXACT]
    kinds = {name: THEORY if name in (LEADING, TWO_TERMS) else OF_U for name in found if name != EXACT}
    plain = {harmonics_name(N): of_harmonics(system, N, free_mass=False) for N in harmonics}
    every = [(kinds[name], name, found[name]) for name in kinds] + [(OF_FORCE, *item) for item in plain.items()]
    yield from ((case, kind, name, level.cost, error(level.C, exact.C)) for kind, name, level in every)
    yield case, EXACT, EXACT, exact.cost, np.nan


def _cheapest(found, limit):
    """The first level with all motions, and no other, to within the limit."""
    return next(name for name, level in found.items() if error(level.C, found[EXACT].C) <= limit)


def verdicts(plane) -> pd.DataFrame:
    """Count verdicts of leading order and of two terms against the exact ones; plane: the levels at each place.

    Returns columns rung, said, true, motions.
    """
    counts = Counter()
    for found in plane:
        exact = found[EXACT]
        for name in (LEADING, TWO_TERMS):
            level = found[name]
            true = [NO_ORBIT if k is None else exact.verdicts[k] for k in partners(level.C, exact.C)]
            counts.update(zip([name] * len(true), level.verdicts, true, strict=True))
    rows = [(*key, number) for key, number in counts.items()]
    return pd.DataFrame(rows, columns=["rung", "said", "true", "motions"])


def _limits(system, fold_range):
    breaking = two_terms.symmetry_breaking(system.epsilon)
    fold = two_terms.fold(system, "f20_hat", fold_range)
    rows = [
        ("C at symmetry breaking", SYMMETRY_BREAKING_C, SYMMETRY_BREAKING_SLOPE, breaking, np.nan),
        ("f20_hat at the fold", *fold.values()),
    ]
    return pd.DataFrame(rows, columns=["limit", "leading", "slope", "two_terms", "exact"])


@styled
def draw(tables: dict) -> Figure:
    """Draw the table "csv" of `compute`: error against cost, the worst of the cases for each level."""
    worst = tables["csv"].groupby(["series", "level"], sort=False)[["cost", "error"]].max().reset_index()
    figure = new_figure(SINGLE_COLUMN, 76.0)
    axes = figure.add_subplot()
    for series, style in STYLES.items():
        line = worst[worst["series"] == series]
        axes.plot(line["cost"], line["error"], **style)
    beside = {"textcoords": "offset points", **HALO}
    exact = worst.loc[worst["series"] == EXACT, "cost"].max()
    for row in worst[worst["series"].isin([THEORY, OF_U])].itertuples():
        aside = {"xytext": (6, -3)}
        if row.level == TWO_TERMS:
            aside = {"xytext": (-6, 4), "ha": "right"}
        elif row.series == OF_U and row.cost < exact:
            aside = {"xytext": (-5, -9), "ha": "right"}
        axes.annotate(row.level, (row.cost, row.error), **aside, **beside)
    for series, end, aside in (
        (OF_FORCE, 0, {"xytext": (-6, -3), "ha": "right", "color": STYLES[OF_FORCE]["color"]}),
        (OF_U, -1, {"xytext": (-10, -13)}),
    ):
        place = worst.loc[worst["series"] == series, ["cost", "error"]].iloc[end]
        axes.annotate(series, place, **aside, **beside)
    axes.axvline(exact, **LEVEL)
    axes.annotate("exact", (exact, 0.94), (4, 0), xycoords=axes.get_xaxis_transform(), **beside)
    heading(axes, words="error against cost, level by level")
    axes.set(xscale="log", xlabel="terms of the response summed", ylabel="largest relative error of $C$")
    if worst["error"].gt(0).any():
        axes.set_yscale("log")
    axes.margins(y=0.14)
    axes.set_xlim(0.3, 30 * worst["cost"].max())
    return figure
