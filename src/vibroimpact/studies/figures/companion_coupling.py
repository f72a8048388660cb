"""Companion: effect of the coupling on errors of the theory, false predictions and asymmetric flights.

A false prediction is a fixed point of the theory to which no exact motion corresponds.
"""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.figures.plotting.style import BLACK, DOUBLE_COLUMN, GREY, LEVEL, heading, new_figure, styled
from vibroimpact.studies.claims.verdict_grid import exact_orbits
from vibroimpact.studies.regimes.coupling import coupled, patterns, stable_ranges
from vibroimpact.system import verdict
from vibroimpact.system.chapter import PARAMETERS
from vibroimpact.theory import criteria
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points

SPEC = {
    "title": "From weak to strong coupling",
    "caption": "Fixed points and exact motions over the coupling, whose damper changes in proportion to the spring. "
        "a: largest error of :math:`C` at leading order, over the fixed points that have an exact motion. b: share of "
        "the fixed points that have none. Dotted: the coupling of the chapter.",
    "alt": "Two panels. First: errors near six per cent for all forces, up to twelve at couplings from 1.4 to 3. "
        "Second: no motion is missing except some at couplings from 1.4 to 1.7 and, for weak forces, most from 16 on.",
    "method": "fixed points, and exact responses continued along the coupling",
    "columns": {
        "case": {},
        "coupling": {"meaning": r"$\hat\alpha_{12}$", "unit": "dimensionless", "compared": "algebra"},
        "error": {"meaning": "largest error of $C_1$ or $C_2$ over the larger exact one; blank without a motion",
            "unit": "dimensionless", "compared": "roots"},
        "own_error": {"meaning": "largest error of $C_1$ or $C_2$, each over its own exact value; blank without a "
            "motion",
            "unit": "dimensionless", "compared": "roots"},
        "predicted": {"meaning": "True if the theory calls the point stable on both time scales",
            "unit": "true or false"},
        "stable": {"meaning": "True if all multipliers are inside the unit circle", "unit": "true or false"},
    },
    "tables": {
        "summary": {
            "file": "results/regimes/coupling.csv",
            "about": "Numbers of [strong coupling](coupling.md), by name.",
            "columns": {
                "quantity": {"meaning": "name of the measured quantity", "unit": "text"},
                "value": {"meaning": "coupling, error or number of points", "unit": "dimensionless"},
            },
        },
    },
}  # fmt: skip

STRONG = ("equal", "unequal")
"""Cases in which the theory calls at least one fixed point stable."""
WEAK = "weak"
COUPLINGS = (0.0, 0.3, 1.0, 1.4, 1.5, 1.6, 1.7, 2.0, 3.0, 5.0, 10.0, 16.0, 25.0, 35.0, 40.0, 43.0, 50.0, 70.0, 100.0)
WELL = 5.0
"""Errors at couplings of at least this value are also reported separately."""
ALIKE = {"sigma20_hat": 0.0, "f10_hat": 1.52, "f20_hat": 1.54}
"""Parameters with orbits on which both balls are asymmetric: modules tuned alike, impacts at different instants."""
LIMITS = (0.5, 100.0)
TRIED = (0.3, 1.0, 3.0, 10.0, 30.0, 100.0)
"""Couplings at which patterns are searched for with the parameters of each case in STRONG, instead of with ALIKE."""
SHOWN = {
    "equal and unequal forces": (STRONG, {"color": BLACK, "marker": "o", "markersize": 4.2}),
    "weak forces": ([WEAK], {"color": GREY, "marker": "^", "markersize": 5.2, "linestyle": (0, (4, 1.5))}),
}
"""Cases and look of each curve."""


def compute(systems: dict) -> dict:
    """Return the errors of the theory at several couplings, and a summary with the patterns of asymmetric flights.

    Parameters
    ----------
    systems : dict
        System of each case, by name of the case. The case "equal" is required. Only the cases in STRONG and
        WEAK are used.

    Returns
    -------
    dict
        The tables in SPEC.
    """
    rows = [
        {"case": case, "coupling": value} | row
        for case in (*STRONG, WEAK)
        if case in systems
        for value in COUPLINGS
        for row in errors(coupled(systems[case], value))
    ]
    table = pd.DataFrame(rows, columns=list(SPEC["columns"]))
    weak = table["case"] == WEAK
    summary = _of_errors(table[~weak]) | _of_patterns(systems["equal"].with_(**ALIKE))
    tried = [coupled(systems[case], value) for case in STRONG if case in systems for value in TRIED]
    summary["patterns at the forces of the cases"] = sum(len(patterns(system)) for system in tried)
    if WEAK in systems:
        missing = table["coupling"][weak & table["error"].isna()]
        summary |= {
            "points, case weak": weak.sum(),
            "without a motion, case weak": len(missing),
            "without a motion, case weak, from coupling": missing.min(),
        }
    return {"csv": table, "summary": pd.DataFrame(summary.items(), columns=["quantity", "value"])}


def errors(system) -> list[dict]:
    """Return one row for each fixed point, with the errors of the theory and the stability.

    error: larger error of C_1 and C_2, divided by the larger of C_1 and C_2 of the exact orbit.
    own_error: larger relative error of C_1 and C_2. The error of C_i is divided by C_i of the exact orbit.
    predicted: True if the theory calls the fixed point stable.
    stable: True if the exact orbit is admissible and stable.

    If a fixed point has no admissible exact orbit, both errors are nan.
    """
    points, rows = fixed_points(system), []
    orbits = exact_orbits(system, [point.C for point in points], symmetric_solutions(system))
    for point, orbit in zip(points, orbits, strict=True):
        moves = orbit is not None and orbit.admissible
        C = orbit.C if moves else np.full(2, np.nan)
        apart = np.abs(point.C - C)
        predicted = criteria.of_fixed_point(system, point)[criteria.THEORY] == verdict.STABLE
        of_point = {"error": float(apart.max() / C.max()), "own_error": float((apart / C).max())}
        rows.append(of_point | {"predicted": predicted, "stable": moves and orbit.stability == verdict.STABLE})
    return rows


def _of_errors(table):
    at_1, at_100 = (table[table["coupling"] == coupling] for coupling in (1.0, 100.0))
    return {
        "points": len(table),
        "largest error": table["error"].max(),
        f"largest error from coupling {WELL:g}": table["error"][table["coupling"] >= WELL].max(),
        "largest error at coupling 1": at_1["error"].max(),
        "largest error over its own C, coupling 1": at_1["own_error"].max(),
        "largest error over its own C, coupling 100": at_100["own_error"].max(),
        "without a motion": table["error"].isna().sum(),
        "called stable": table["predicted"].sum(),
        "called stable and unstable": (table["predicted"] & ~table["stable"]).sum(),
    }


def _of_patterns(system):
    """Return the ends of each range of the coupling in which a pattern of flights has a stable orbit.

    The result is a dict from a description of the end to the coupling at this end.
    """
    return {
        f"{name}, from {start:g}: stable {end}": found[i][0]
        for name, start, found, _ in stable_ranges(system, LIMITS)
        for end, i in (("from", 0), ("up to", -1))
    }


@styled
def draw(tables: dict) -> Figure:
    """Draw the table "csv" of `compute` against the coupling.

    The left panel shows the errors. The right panel shows the share of predicted motions that do not exist.
    """
    table = tables["csv"]
    figure = new_figure(DOUBLE_COLUMN, 78.0)
    left, right = figure.subplots(1, 2)
    heading(left, "a", "error of $C$, where the motion exists")
    heading(right, "b", "predicted motions that do not exist")
    for name, (cases, look) in SHOWN.items():
        rows = table[table["case"].isin(cases)].groupby("coupling")["error"]
        for axes, values in ((left, rows.max()), (right, rows.agg(lambda error: error.isna().mean()))):
            if len(values):  # with clip_on=False, a line without data would spoil the layout
                axes.plot(100 * values, linewidth=0.9, clip_on=False, label=name, **look)
    for axes, words, highest in ((left, "largest error in %", None), (right, "share of fixed points in %", 100)):
        axes.axvline(PARAMETERS["alpha12_hat"], zorder=0, **LEVEL)
        axes.set_xscale("symlog", linthresh=1.0, linscale=0.4)
        axes.set(xlabel=r"coupling $\hat\alpha_{12}$", ylabel=words, xlim=(-0.15, 150), ylim=(0, highest))
        axes.xaxis.set_major_formatter("{x:g}")
    left.annotate("chapter", (PARAMETERS["alpha12_hat"], 1.0), (4, 0), textcoords="offset points")
    left.legend(handles=left.get_legend_handles_labels()[0])
    return figure
