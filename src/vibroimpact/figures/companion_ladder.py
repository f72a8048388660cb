"""Companion: from leading order to the exact orbit, rung by rung: error, cost, and the cheapest rung that is right."""

from collections import Counter

import numpy as np
import pandas as pd
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from vibroimpact.claims.verdict_table import NO_ORBIT, partners
from vibroimpact.figures.kit.style import BLACK, DOUBLE_COLUMN, GREY, letter_panel, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join
from vibroimpact.regimes import two_terms
from vibroimpact.regimes.hierarchy import EXACT, LEADING, TWO_TERMS, error, harmonics_name, levels, of_harmonics
from vibroimpact.regimes.midpoint_grid import plane_of_forces
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C, SYMMETRY_BREAKING_SLOPE

SPEC = {
    "title": "From leading order to the exact orbit, rung by rung",
    "caption": "How much model it needs. a: the largest relative error of :math:`C_i` over all symmetric motions of "
        "the three cases, against the number of terms of the boxes' response that are summed to find them: leading "
        "order; two terms; N odd harmonics of the balls' force with exact receptances (grey); the same where the part "
        "of the free mass is kept in closed form, so that N harmonics are those of :math:`U_i`. b, c: over the plane "
        "of forces, the lowest rung that has all symmetric motions, and no other, to 5 % and 1 %; at the lowest forces "
        "there is none, which leading order says too.",
    "alt": "First panel: error over cost on logarithmic axes; leading order at the upper left, two terms far below it, "
        "and two lines of marks for growing numbers of harmonics that fall, the one of harmonics of U ten times lower. "
        "Other panels: maps of the plane of forces in shades of grey, one shade for each rung.",
    "method": "fixed points to leading and next order, N harmonics with exact receptances, exact symmetric responses",
    "columns": {
        "panel": {"meaning": "cases: errors and costs; plane: the cheapest rung", "values": ["cases", "plane"]},
        "series": {"meaning": "in cases the kind of rung; in plane how far off it may be", "values": ["theory",
            "harmonics of U", "harmonics of the force", "exact", "5 %", "1 %"]},
        "label": {"meaning": "in cases rung and case; in plane the lowest rung that has all motions, and no other, "
            "within the limit", "unit": "text", "compared": {"5 %": "counts of a map", "1 %": "counts of a map"}},
        "cost": {"meaning": "terms of the boxes' response that are summed until all motions are found",
            "unit": "number", "compared": "algebra"},
        "error": {"meaning": "largest error of $C_1$, $C_2$ over the larger of both, of all motions; blank if their "
            "number is wrong", "unit": "dimensionless", "compared": "logarithm"},
        "f10_hat, f20_hat": {"compared": "algebra"},
    },
    "tables": {
        "verdicts": {
            "file": "results/regimes/ladder_verdicts.csv",
            "about": "What each rung of `companion_ladder` says of its motions over the plane of forces, and what is "
                "true.",
            "columns": {
                "rung": {"meaning": "leading order; two terms; N harmonics of $U_i$; exact", "unit": "text"},
                "said": {"meaning": "the verdict of the rung", "unit": "text"},
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

CASES, PLANE, THEORY, OF_U, OF_FORCE = "cases", "plane", "theory", "harmonics of U", "harmonics of the force"
LIMITS = {"5 %": 0.05, "1 %": 0.01}
STYLES = {
    THEORY: {"linestyle": "none", "marker": "D", "markersize": 5, "markerfacecolor": "white"},
    OF_FORCE: {"marker": "o", "markersize": 4, "linewidth": 0.8, "color": GREY, "linestyle": "--"},
    OF_U: {"marker": "s", "markersize": 4, "linewidth": 1.0},
}
_SHADES = ("0.93", "0.78", "0.6", "0.42", "0.22", "black")
"""None is white, which would read as missing."""
_IN_PLANE = 3


def compute(systems: dict, harmonics, f10_range, f20_range, points: int, fold_range) -> dict:
    """Errors and costs of the rungs for every case, the cheapest right rung over the plane, verdicts and limits.

    Args:
        systems: case -> system; the plane and the fold have the parameters of the first.
        harmonics: of the rungs, odd, ascending; the first three also over the plane.
        fold_range: of f20_hat, with one fold.

    Returns "csv": columns panel ("cases" or "plane"), series ("theory", "harmonics of U", "harmonics of the force",
    "exact"; in "plane" how far off the rung may be), label (rung and case; in "plane" the lowest such rung), cost,
    error (blank where the number of motions is wrong), f10_hat, f20_hat; "verdicts": rung, said, true, motions, over
    the plane; "limits": limit, leading, slope, two_terms, exact.
    """
    system = next(iter(systems.values()))
    plane = {
        (f10, f20): levels(system.with_(f10_hat=f10, f20_hat=f20), harmonics[:_IN_PLANE])
        for f10, f20 in plane_of_forces(f10_range, f20_range, points)
    }
    rows = [row for case, one in systems.items() for row in _of_case(case, one, harmonics)]
    rows += [_cheapest(name, limit, place, found) for place, found in plane.items() for name, limit in LIMITS.items()]
    return {"csv": join(rows), "verdicts": verdicts(plane.values()), "limits": _limits(system, fold_range)}


def _of_case(case, system, harmonics):
    found = levels(system, harmonics)
    exact = found[EXACT].C
    series = {name: THEORY if name in (LEADING, TWO_TERMS) else OF_U for name in found if name != EXACT}
    plain = {harmonics_name(N): of_harmonics(system, N, free_mass=False) for N in harmonics}
    every = [(series[name], name, found[name]) for name in series] + [(OF_FORCE, *item) for item in plain.items()]
    for kind, name, rung in every:
        yield curve(CASES, kind, label=f"{name}, {case}", cost=rung.cost, error=error(rung.C, exact))
    yield curve(CASES, EXACT, label=f"{EXACT}, {case}", cost=found[EXACT].cost)


def _cheapest(name, limit, place, found):
    """The first rung with all motions, and no other, to within the limit."""
    right = next(rung for rung, one in found.items() if error(one.C, found[EXACT].C) <= limit)
    return curve(PLANE, name, label=right, f10_hat=place[0], f20_hat=place[1])


def verdicts(plane) -> pd.DataFrame:
    """Count verdicts of leading order and of two terms against the exact ones; plane: the levels at each place.

    Returns columns rung, said, true, motions.
    """
    counts = Counter()
    for found in plane:
        exact = found[EXACT]
        for name in (LEADING, TWO_TERMS):
            rung = found[name]
            true = [NO_ORBIT if k is None else exact.verdicts[k] for k in partners(rung.C, exact.C)]
            counts.update(zip([name] * len(true), rung.verdicts, true, strict=True))
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
    """Draw the tables of `compute`: error against cost, and two maps of the cheapest rung."""
    table = tables["csv"]
    figure = new_figure(DOUBLE_COLUMN, 82.0)
    left, *maps = figure.subplots(1, 1 + len(LIMITS), width_ratios=[1.25, 1, 1])
    letter_panel(left, "a")
    cases = table[table["panel"] == CASES]
    _draw_errors(left, cases)
    plane = table[table["panel"] == PLANE]
    rungs_of = cases[cases["series"].isin([THEORY, OF_U])]["label"].str.rsplit(", ", n=1).str[0]
    order = [name for name in [*dict.fromkeys(rungs_of), EXACT] if (plane["label"] == name).any()]
    for axes, name, letter in zip(maps, LIMITS, "bc", strict=True):
        letter_panel(axes, letter)
        axes.set_title(f"right to {name}", loc="right", pad=3)
        _draw_map(axes, plane[plane["series"] == name], order)
    maps[0].set_ylabel(r"$\hat f_{20}$")
    patches = [Patch(facecolor=shade, edgecolor=BLACK, label=name) for name, shade in zip(order, _SHADES, strict=False)]
    handles, _ = left.get_legend_handles_labels()
    figure.legend(handles=[*handles, *patches], loc="outside lower center", ncols=4, fontsize=8.5)
    return figure


def _draw_errors(axes, rows):
    """The worst of the cases, for each rung."""
    worst = rows.assign(rung=rows["label"].str.rsplit(", ", n=1).str[0])
    worst = worst.groupby(["series", "rung"], sort=False)[["cost", "error"]].max().reset_index()
    for series, style in STYLES.items():
        line = worst[worst["series"] == series]
        axes.plot(line["cost"], line["error"], **({"color": BLACK} | style), label=series)
    for row in worst[worst["series"].isin([THEORY, OF_U])].itertuples():
        aside = (
            {"xytext": (6, -2)}
            if row.rung == LEADING
            else {"xytext": (-5, 4 if row.rung == TWO_TERMS else -9), "ha": "right"}
        )
        axes.annotate(row.rung, (row.cost, row.error), **aside, textcoords="offset points", fontsize=7.5)
    cost = worst.loc[worst["series"] == EXACT, "cost"].max()
    axes.axvline(cost, color=BLACK, linewidth=0.8, linestyle=":")
    axes.annotate(
        "exact", (cost, 0.93), (-3, 0), xycoords=("data", "axes fraction"), textcoords="offset points", ha="right"
    )
    axes.set(xscale="log", xlabel="terms of the response summed", ylabel="largest relative error of $C$")
    if worst["error"].gt(0).any():
        axes.set_yscale("log")
    axes.margins(x=0.22, y=0.08)


def _draw_map(axes, rows, order):
    codes = rows.assign(code=rows["label"].map(order.index)).pivot(index="f20_hat", columns="f10_hat", values="code")
    norm = BoundaryNorm(np.arange(len(order) + 1) - 0.5, len(order)) if len(order) > 1 else None
    shades = ListedColormap(_SHADES[: len(order)])
    axes.pcolormesh(codes.columns, codes.index, codes.to_numpy(), cmap=shades, norm=norm, rasterized=True)
    axes.set(xlabel=r"$\hat f_{10}$", aspect="equal")
