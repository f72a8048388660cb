"""Companion: errors of the method from weak to strong coupling, and power at the impacts; asymmetric patterns."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.accuracy.second_term import first_order
from vibroimpact.exact.orbits.search import symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.figures.plotting.style import (
    BLACK,
    DOUBLE_COLUMN,
    GREY,
    LEVEL,
    LIGHT_GREY,
    heading,
    new_figure,
    styled,
)
from vibroimpact.studies.absorbers.references import tuned
from vibroimpact.studies.absorbers.tuning import textbook_tuning
from vibroimpact.studies.claims.verdict_grid import exact_orbits
from vibroimpact.studies.regimes.basins import plane
from vibroimpact.studies.regimes.classification import starts
from vibroimpact.studies.regimes.coupling import (
    asymmetric_orbits,
    coupled,
    impact_power,
    patterns,
    shares,
    stable_ranges,
)
from vibroimpact.system import verdict
from vibroimpact.tables import join, select
from vibroimpact.theory import criteria
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points

SPEC = {
    "title": "From weak to strong coupling",
    "caption": "a: largest error of :math:`C` at leading order over the fixed points of the cases equal and unequal, "
        "with the coupling damper in proportion to the spring or held; marks in the grey band: a fixed point has no "
        "exact motion, and the lines are those of the others. b: mean power of the impacts over the squared force, "
        "for exact orbits and over all starts (mean and standard deviation), at the coupling of the case equal; "
        "dotted: dampers of linear absorbers with the mass of the balls.",
    "alt": "Two panels. First: errors near six per cent except for couplings from 1.4 to 2, with marks of missing "
        "motions there and near 40. Second: the mean over starts falls from above the dotted level to the diamonds of "
        "the asymmetric orbit.",
    "method": "fixed points, exact responses continued along the coupling, simulations from many starts",
    "columns": {
        "panel": {"meaning": "quantity of the panel", "values": ["error", "power"]},
        "series": {"meaning": "for error: damper in proportion or held; for power: type of motion"},
        "case": {"meaning": "for error: case of the config", "unit": "text"},
        "coupling": {"meaning": r"$\hat\alpha_{12}$", "unit": "dimensionless", "compared": "algebra"},
        "error": {"meaning": "largest error of $C_1$ or $C_2$ over the larger exact one; blank without a motion",
            "unit": "dimensionless", "compared": "roots"},
        "own_error": {"meaning": "largest error of $C_1$ or $C_2$, each over its own exact value; blank without a "
            "motion",
            "unit": "dimensionless", "compared": "roots"},
        "predicted": {"meaning": "True if the theory calls the point stable on both time scales",
            "unit": "true or false"},
        "orbits": {"meaning": "number of symmetric motions of the case at this coupling", "unit": "dimensionless",
            "compared": "algebra"},
        "stable": {"meaning": "True if all multipliers are inside the unit circle", "unit": "true or false"},
        "force": {"meaning": r"$\hat f_{10} = \hat f_{20}$", "unit": "dimensionless", "compared": "algebra"},
        "power": {"meaning": r"mean power over $\hat f_{10}^2$; for starts, the mean over them",
            "unit": "dimensionless",
            "compared": {"all starts": "extremes", "others": "roots"}},
        "spread": {"meaning": "standard deviation over starts", "unit": "dimensionless", "compared": "spreads"},
        "asymmetric_share": {"meaning": "share of the starts that reach the asymmetric orbit", "unit": "share",
            "compared": "shares"},
    },
    "tables": {
        "summary": {
            "file": "results/regimes/coupling.csv",
            "about": "Numbers of [strong coupling](coupling.md), by name.",
            "columns": {
                "quantity": {"meaning": "name of the measured quantity", "unit": "text"},
                "value": {"meaning": "coupling, share, ratio or number of points", "unit": "dimensionless"},
                "uncertainty": {"meaning": "standard error from the spread over starts; for a spread, that of a normal "
                    "distribution; 0 for motions that repeat", "unit": "dimensionless"},
            },
        },
    },
}  # fmt: skip

STRONG = ("equal", "unequal")
"""Cases in which the theory calls at least one fixed point stable."""
WEAK = "weak"
COUPLINGS = (0.0, 0.3, 1.0, 1.4, 1.5, 1.6, 1.7, 2.0, 3.0, 5.0, 10.0, 16.0, 25.0, 35.0, 40.0, 43.0, 50.0, 70.0, 100.0)
PROPORTION, HELD = "damper in proportion", "damper held"
ALIKE = {"sigma20_hat": 0.0, "f10_hat": 1.52, "f20_hat": 1.54}
"""Parameters with orbits on which both balls are asymmetric: modules tuned alike, impacts at different instants."""
LIMITS = (0.5, 100.0)
FORCES = (0.4, 0.45, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.0, 1.1, 1.2, 1.3)
SETTLED, OBSERVED = 1500, 500
SAME_POWER = 1e-3
"""Motions count as the same if their powers have at most this relative difference."""
STARTS, SEED, CYCLES = 32, 1, SETTLED + OBSERVED
LONG = 10000
"""Cycles of the longer runs from starts that have not reached the asymmetric orbit after SETTLED cycles."""
SIDE = 8
WATCHED, POINTS, ENOUGH = (1.0, 3.0, 30.0), 15, 600
SYMMETRIC, ASYMMETRIC, ALL, LINEAR = "symmetric", "asymmetric", "all starts", "linear absorber"
TRIED = (0.3, 1.0, 3.0, 10.0, 30.0, 100.0)
"""Couplings at which patterns are searched for with the parameters of each case in STRONG, instead of with ALIKE."""
NEXT_ORDER = (1.0, 10.0, 25.0, 100.0)
"""Couplings at which the second term of (10.7) is computed."""
ERRORS = ["panel", "series", "case", "coupling", "error", "own_error", "predicted", "orbits", "stable"]
WELL = 5.0
"""Errors and missing motions at couplings of at least this value are also reported separately."""
BAND = (14.0, 16.5)
"""Lower and upper edge [%] of the band above the errors; marks in the band are at couplings with missing orbits."""


def compute(systems: dict) -> dict:
    """Return the errors over the coupling, the power at the impacts, and a summary with the asymmetric patterns.

    Parameters
    ----------
    systems : dict
        Case -> system. Patterns and power are computed for the case "equal"; for patterns, the modules are tuned ALIKE.

    Returns "csv" and "summary". The panels of "csv" have different columns. "error", with two series, in which the
    coupling damper changes in proportion to the coupling spring or is held: case, coupling, error, own_error,
    predicted, orbits, stable. "power": force, power, spread, asymmetric_share, stable.
    """
    equal = systems["equal"]
    strong = {case: system for case, system in systems.items() if case in STRONG}
    found = [_errors(strong, held) for held in (False, True)]
    power = _power(equal)
    summary = _of_errors(found) | _two_terms(equal) | _of_patterns(equal.with_(**ALIKE)) | _of_power(power)
    tried = [coupled(system, value) for system in strong.values() for value in TRIED]
    summary |= {
        "searches at the forces of the cases": len(tried),
        "patterns at the forces of the cases": sum(len(patterns(system)) for system in tried),
    }
    if WEAK in systems:
        weak = _errors({WEAK: systems[WEAK]}, held=False)
        missing = weak[weak["error"].isna()]["coupling"]
        summary |= {
            "points, case weak": len(weak),
            "without a motion, case weak": len(missing),
            "without a motion, case weak, from coupling": missing.min(),
        }
    if "unequal" in systems:
        summary |= _coexisting(systems["unequal"])
    rows = [(name, *(value if isinstance(value, tuple) else (value, 0.0))) for name, value in summary.items()]
    summary = pd.DataFrame(rows, columns=["quantity", "value", "uncertainty"])
    return {"csv": join([*found, power]), "summary": summary}


def errors(system) -> list[dict]:
    """Return a row per fixed point: relative error of C, verdicts of the theory and of the exact orbit.

    error: larger difference in C_1 or C_2 between the point and its exact orbit, divided by the larger C_i of the
    orbit. own_error: larger relative difference, where the difference in C_i is divided by C_i of the orbit. Both
    errors are nan if the point has no exact orbit, or if this orbit is not a motion of the system. predicted: True if
    the theory calls the point stable on both time scales. stable: True if the orbit is a motion whose multipliers are
    all inside the unit circle. orbits: number of symmetric motions of the system, the same in all rows.
    """
    points, roots = fixed_points(system), symmetric_solutions(system)
    motions, rows = sum(symmetric_orbit(system, root).admissible for root in roots), []
    for point, orbit in zip(points, exact_orbits(system, [point.C for point in points], roots), strict=True):
        moves = orbit is not None and orbit.admissible
        C = orbit.C if moves else np.full(2, np.nan)
        apart = np.abs(point.C - C)
        predicted = criteria.of_fixed_point(system, point)[criteria.THEORY] == verdict.STABLE
        of_point = {"error": float(apart.max() / C.max()), "own_error": float((apart / C).max())}
        stable = moves and orbit.stability == verdict.STABLE
        rows.append(of_point | {"predicted": predicted, "orbits": motions, "stable": stable})
    return rows


def _errors(systems, held):
    rows = [
        {"panel": "error", "series": HELD if held else PROPORTION, "case": case, "coupling": value} | row
        for case, system in systems.items()
        for value in COUPLINGS
        for row in errors(coupled(system, value, held))
    ]
    return pd.DataFrame(rows, columns=ERRORS)


def _two_terms(system):
    """For each coupling, return the largest error of C with two terms of (10.7), and the largest second term."""
    summary = {}
    for value in NEXT_ORDER:
        here = coupled(system, value)
        points, roots = fixed_points(here), symmetric_solutions(here)
        pairs = zip(points, exact_orbits(here, [point.C for point in points], roots), strict=True)
        found = [
            (point.C, point.C + here.epsilon * first_order(here, point)[0], orbit.C)
            for point, orbit in pairs
            if orbit is not None
        ]
        if found:
            leading, C, exact = np.array(found).swapaxes(0, 1)
            error = np.abs(C - exact).max(axis=1) / exact.max(axis=1)
            summary[f"largest error with two terms, coupling {value:g}"] = error.max()
            summary[f"largest second term, coupling {value:g}"] = np.abs(C - leading).max() / here.epsilon
    return summary


def _of_patterns(system):
    """Return the ends of each stable range of a pattern, and the share of the starts that end on each pattern."""
    summary = {}
    for name, start, found, _ in stable_ranges(system, LIMITS):
        summary |= {f"{name}, from {start:g}: stable {end}": found[i][0] for end, i in (("from", 0), ("up to", -1))}
    for value in WATCHED:
        here = coupled(system, value)
        asymmetric = asymmetric_orbits(here)
        if asymmetric:
            ended = shares(asymmetric, plane(asymmetric[0].state, POINTS), ENOUGH)
            summary |= {f"share of starts, {name}, coupling {value:g}": share for name, share in ended.items()}
    return summary


def _power(equal):
    """Return the table of the powers at all FORCES."""
    rows = [row for force in FORCES for row in _power_at(equal.with_(f10_hat=force, f20_hat=force), force)]
    columns = ["panel", "series", "force", "power", "spread", "asymmetric_share", "stable"]
    return pd.DataFrame([("power", *row) for row in rows], columns=columns)


def _power_at(system, force):
    """Return the rows of the table of powers at one force.

    Starts that have not reached the asymmetric orbit after SETTLED cycles are simulated longer.
    """
    unit, begun = force**2, starts(STARTS, SEED)
    symmetric = [symmetric_orbit(system, root) for root in symmetric_solutions(system)]
    rows = [
        (SYMMETRIC, force, _power_on(orbit) / unit, 0.0, 0.0, bool(orbit.stable))
        for orbit in symmetric
        if orbit.admissible
    ]
    taken, share = impact_power(system, begun, CYCLES, SETTLED) / unit, 0.0
    for orbit in asymmetric_orbits(system, both=False)[:1]:
        alone = _power_on(orbit) / unit
        late = ~np.isclose(taken, alone, rtol=SAME_POWER)
        if late.any():
            taken[late] = impact_power(system, begun[late], LONG, LONG - CYCLES + SETTLED) / unit
        share = np.isclose(taken, alone, rtol=SAME_POWER).mean()
        rows.append((ASYMMETRIC, force, alone, 0.0, share, True))
    rows.append((ALL, force, taken.mean(), taken.std(), share, False))
    # The dampers of linear absorbers with the mass of the balls and textbook tuning
    tuning = textbook_tuning(system)
    damping = 2 * system.epsilon * np.multiply(tuning.frequency, tuning.damping)
    strokes = tuned(system, tuning).strokes(system.Omega)
    rows.append((LINEAR, force, damping @ strokes**2 * system.Omega**2 / 2 / unit, 0.0, 0.0, True))
    return rows


def _power_on(orbit):
    """Return the mean power at the impacts of an orbit."""
    return impact_power(orbit.system, [orbit.state], 1)[0]


def _coexisting(system):
    """Compare the power of starts that end modulated with that of the asymmetric orbit, on which the others end.

    Returns quantities for the summary: number of starts, share of those that end on the asymmetric orbit, and mean and
    spread of the power of the others over that of the orbit; nothing if there is no stable asymmetric orbit.
    """
    for orbit in asymmetric_orbits(system, both=False)[:1]:
        taken = impact_power(system, plane(orbit.state, SIDE), CYCLES, SETTLED) / _power_on(orbit)
        others = taken[~np.isclose(taken, 1.0, rtol=SAME_POWER)]
        summary = {
            "starts at unequal forces": len(taken),
            "asymmetric share, unequal forces": 1 - len(others) / len(taken),
        }
        if len(others):
            error = others.std() / len(others) ** 0.5
            summary["modulated over asymmetric, unequal forces"] = others.mean(), error
            summary["spread over asymmetric, unequal forces"] = others.std(), error / 2**0.5
        return summary
    return {}


def _of_errors(tables):
    summary = {}
    for name, table in zip((PROPORTION, HELD), tables, strict=True):
        known, missing = table.dropna(subset="error"), table[table["error"].isna()]["coupling"]
        at_1, at_100 = (table[table["coupling"] == coupling] for coupling in (1.0, 100.0))
        summary |= {
            f"points, {name}": len(table),
            f"largest error, {name}": known["error"].max(),
            f"largest error from coupling {WELL:g}, {name}": known[known["coupling"] >= WELL]["error"].max(),
            f"largest error at coupling 1, {name}": at_1["error"].max(),
            f"largest error over its own C, coupling 1, {name}": at_1["own_error"].max(),
            f"largest error over its own C, coupling 100, {name}": at_100["own_error"].max(),
            f"without a motion, {name}": len(missing),
            f"without a motion, from coupling {WELL:g}, {name}": int((missing >= WELL).sum()),
            f"called stable, {name}": int(table["predicted"].sum()),
            f"called stable and unstable, {name}": int((table["predicted"] & ~table["stable"]).sum()),
            f"called unstable and stable, {name}": int((~table["predicted"] & table["stable"]).sum()),
        }
    return summary


def _of_power(table):
    summary = {}
    for force, rows in table.groupby("force"):
        by = dict(list(rows.groupby("series")))
        mean, spread = by[ALL]["power"].iloc[0], by[ALL]["spread"].iloc[0]
        error, linear = spread / STARTS**0.5, by[LINEAR]["power"].iloc[0]
        summary[f"starts over linear, force {force:g}"] = mean / linear, error / linear
        if len(by.get(SYMMETRIC, ())) == 1:
            only = by[SYMMETRIC]["power"].iloc[0]
            summary[f"starts over symmetric, force {force:g}"] = mean / only, error / only
            summary[f"spread over symmetric, force {force:g}"] = spread / only, error / only / 2**0.5
    return summary


@styled
def draw(tables: dict) -> Figure:
    """Draw the table "csv" of `compute`: errors and power."""
    table = tables["csv"]
    figure = new_figure(DOUBLE_COLUMN, 82.0)
    grid = figure.subplots(1, 2)
    for axes, letter, words in zip(grid, "ab", ("error of leading order", "power at the impacts"), strict=True):
        heading(axes, letter, words)
    _draw_errors(grid[0], table)
    _draw_power(grid[1], table)
    return figure


def _draw_errors(axes, table):
    axes.axhspan(*BAND, color=LIGHT_GREY, linewidth=0)
    axes.text(8.0, np.mean(BAND), "no exact motion", ha="center", va="center", fontsize=8)
    looks = {PROPORTION: ("o", BLACK, 3.2, "-"), HELD: ("s", "white", 3.8, (0, (3, 1.5)))}
    for (name, (marker, face, size, style)), row in zip(looks.items(), np.linspace(*BAND, 4)[2:0:-1], strict=True):
        look = {"marker": marker, "markerfacecolor": face, "markersize": size, "color": BLACK, "markeredgewidth": 0.7}
        rows = select(table, "error", name)
        largest = 100 * rows.groupby("coupling")["error"].max()
        axes.plot(largest.index, largest, label=name, linestyle=style, linewidth=0.8, **look)
        missing = rows[rows["error"].isna()]["coupling"].unique()
        axes.plot(missing, np.full(len(missing), row), linestyle="none", **look)
    axes.set(xlabel=r"coupling $\hat\alpha_{12}$", ylabel="largest error of $C$ in %", ylim=(0, BAND[1]))
    axes.set_yticks(np.arange(0, BAND[0], 2))
    axes.set_xscale("symlog", linthresh=1.0, linscale=0.4)
    axes.set_xlim(-0.15, 150)
    axes.legend(fontsize=8)


def _draw_power(axes, table):
    marks = {
        SYMMETRIC: {"marker": "o", "markerfacecolor": "none", "markersize": 4.6, "zorder": 3},
        ASYMMETRIC: {"marker": "D", "markerfacecolor": BLACK, "markersize": 2.6},
    }
    for name, look in marks.items():
        rows = select(table, "power", name)
        axes.plot(rows["force"], 100 * rows["power"], linestyle="none", color=BLACK, label=f"{name} orbit", **look)
    rows = select(table, "power", ALL)
    axes.errorbar(
        rows["force"],
        100 * rows["power"],
        100 * rows["spread"],
        color=GREY,
        capsize=2,
        linewidth=1.2,
        label="simulated, mean over starts",
    )
    rows = select(table, "power", LINEAR)
    axes.plot(rows["force"], 100 * rows["power"], **LEVEL, label="linear absorbers")
    axes.set(
        xlabel=r"force $\hat f_{10} = \hat f_{20}$",
        ylabel=r"absorbed power over $\hat f_{10}^2$ $[10^{-2}]$",
        ylim=(0, None),
        xlim=(FORCES[0] - 0.05, FORCES[-1] + 0.05),
    )
    axes.legend(fontsize=8)
