"""Fixed points along the manifold as the forcing of the second module changes."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from scipy.optimize import linear_sum_assignment

from vibroimpact.claims.verdict_grid import exact_orbits
from vibroimpact.claims.verdict_table import NO_ORBIT
from vibroimpact.exact.orbits.floquet import floquet
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.figures.kit.manifold import branches
from vibroimpact.figures.kit.style import BLACK, DOUBLE_COLUMN, GREY, letter_panel, new_figure, styled
from vibroimpact.figures.kit.tables import join
from vibroimpact.regimes.followed import followed
from vibroimpact.system.verdict import STABLE
from vibroimpact.theory.criteria import CRITERIA, EXACT, THEORY, of_fixed_point
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points, labels

SPEC = {
    "title": "Fixed points over the second force",
    "caption": r"Fixed points over :math:`\hat f_{20}` with :math:`\hat f_{10} = {f10_hat}`. Filled markers: stable by "
        "both time scales; hollow: not; in a ring: the exact orbit is stable. Broad and pale: exact asymmetric orbits, "
        "which belong to no fixed point, darker where they are stable. Letters, right: as in the chapter, where they "
        "change.",
    "alt": "Two panels with C1 and C2 of every fixed point over f20, one line style per point, filled markers where "
        "both time scales are stable, hollow ones where not, rings around those whose exact orbit is stable; broad "
        "pale dots for the asymmetric orbits.",
    "method": "fixed points and exact orbits at every value of the force",
    "file": "results/force_sweep/force_sweep.csv",
    "on_demand": "make report",
    "columns": {
        "value": {"meaning": r"the value of $\hat f_{20}$", "unit": "dimensionless"},
        "track": {"meaning": "number, from 1 on, of the line of points that follow each other as the value grows",
            "unit": "number"},
        "C1, B1, C2, B2": {},
        "label": {"meaning": "label (a), (b), (c) as the chapter would give it at this value", "unit": "text"},
        "printed_10_26, fast, slow, theory, exact, masri_derived, slow_flow, floquet": {},
        "fast_and_slow": {"meaning": "former name of `theory`, until the next release", "unit": "text"},
    },
}  # fmt: skip

LOOKS = [(BLACK, "-", "o"), (BLACK, (0, (4.5, 1.5)), "s"), (GREY, "-", "^"), (GREY, (0, (4.5, 1.5)), "D")]
"""Colour, line and marker of each track."""
EVERY = 6
"""Markers stand at every so many values: filled where both time scales are stable, in a ring if the exact orbit is."""
PAIR = 0
"""Track of the asymmetric orbits, which belong to no fixed point."""
VERDICTS = (*CRITERIA, EXACT)


def compute(systems: dict, C_max: float) -> dict[str, pd.DataFrame]:
    """All fixed points at each value of a parameter, followed from value to value, and the manifold.

    Args:
        systems: value of the parameter (ascending) -> system; kappa is the same in all of them.
        C_max: the manifold is shown for 0 <= C <= C_max, and further where a fixed point lies beyond.

    Returns "points": columns value, track (from 1 on; nearest neighbours in the plane (C1, C2) share a track), C1, B1,
    C2, B2, label (as in the chapter: `theory.fixed_points.labels`), and VERDICTS: those of the theory's criteria, of
    both time scales together, and of the multipliers of the exact orbit, "no orbit" where there is none; "orbits": a
    row per multiplier of each exact orbit, columns value, track (that of its fixed point; PAIR of the stable asymmetric
    orbits and what becomes of them), C1, C2, exact, real, imag; "manifold": columns series, C, B as in figure 10.4.
    """
    rows, last, tracks = [], np.empty((0, 2)), 0
    names, multipliers = [], []
    for value, system in systems.items():
        points = fixed_points(system)
        now = np.array([point.C for point in points]).reshape(-1, 2)
        names, tracks = _continued(names, last, now, tracks)
        last = now
        exact = exact_orbits(system, now, symmetric_solutions(system)) if points else ()
        for track, point, label, orbit in zip(names, points, labels(system, points), exact, strict=True):
            says = of_fixed_point(system, point)
            row = {"value": value, "track": track, "C1": point.C[0], "B1": point.B[0], "C2": point.C[1]}
            row |= {"B2": point.B[1], "label": label, **says}
            rows.append(row | {EXACT: floquet(orbit) if orbit else NO_ORBIT})
            multipliers += _multipliers(value, track, orbit) if orbit and orbit.admissible else []
    for value, orbit in followed(systems):
        multipliers += _multipliers(value, PAIR, orbit)
    points = pd.DataFrame(rows, columns=["value", "track", "C1", "B1", "C2", "B2", "label", *VERDICTS])
    end = max(C_max, 1.05 * points[["C1", "C2"]].to_numpy(float).max(initial=0.0))
    kappa = next(iter(systems.values())).kappa
    orbits = pd.DataFrame(multipliers, columns=["value", "track", "C1", "C2", EXACT, "real", "imag"])
    return {"points": points, "orbits": orbits, "manifold": join(branches("SIM", kappa, end)).drop(columns="panel")}


def _draw_pair(axes, orbits, C):
    pair = orbits[orbits["track"] == PAIR].drop_duplicates(["value", "C1", "C2"])
    stable = pair[EXACT] == STABLE
    for shown, grey, name in ((stable, "0.6", "asymmetric, stable"), (~stable, "0.85", "asymmetric, unstable")):
        dots = {"color": grey, "linestyle": "none", "marker": "o", "markersize": 3.5}
        axes.plot(pair["value"][shown], pair[C][shown], label=name, **dots)


def _multipliers(value, track, orbit):
    place = value, track, *orbit.C, floquet(orbit)
    return [(*place, multiplier.real, multiplier.imag) for multiplier in orbit.multipliers]


def _continued(names, last, now, tracks):
    """The track of each point: that of the nearest point before, or a new one; and how many tracks there are."""
    gaps = np.linalg.norm(last[:, None] - now[None], axis=2)
    found = {new: names[old] for old, new in zip(*linear_sum_assignment(gaps), strict=True)}
    fresh = [new for new in range(len(now)) if new not in found]
    found |= {new: tracks + number for number, new in enumerate(fresh, start=1)}
    return [found[new] for new in range(len(now))], tracks + len(fresh)


@styled
def draw(tables: dict[str, pd.DataFrame]) -> Figure:
    """C_1 and C_2 of each track over the second force.

    Filled markers: stable by both time scales; in a ring: its exact orbit is stable. Letters: where the label changes.
    Broad and pale: exact asymmetric orbits, darker where they are stable.
    """
    figure = new_figure(DOUBLE_COLUMN, 62.0)
    points = tables["points"]
    for axes, module, letter in zip(figure.subplots(1, 2), (1, 2), "ab", strict=True):
        _draw_pair(axes, tables["orbits"], f"C{module}")
        for track, rows in points.groupby("track"):
            colour, line, marker = LOOKS[(track - 1) % len(LOOKS)]
            axes.plot(rows["value"], rows[f"C{module}"], color=colour, linestyle=line)
            renamed = (
                rows[rows["label"] != rows["label"].shift()] if module == 2 else rows[:0]
            )  # there the lines keep apart
            for value, C, label in renamed[["value", "C2", "label"]].itertuples(index=False):
                axes.annotate(label, (value, C), (3, 4), textcoords="offset points", color=colour, fontsize=8)
            marked = rows.iloc[::EVERY]
            theory, exact = (marked[name] == STABLE for name in (THEORY, EXACT))
            for shown, face, size in ((theory, colour, 3.6), (~theory, "white", 3.6), (exact, "none", 6.6)):
                style = {"color": colour, "markerfacecolor": face, "markersize": size, "linestyle": "none"}
                axes.plot(marked["value"][shown], marked[f"C{module}"][shown], marker=marker, **style)
        axes.set(xlabel=r"$\hat f_{20}$", ylabel=f"$C_{module}$")
        if len(points):
            axes.set_xlim(points["value"].min(), points["value"].max())
        letter_panel(axes, letter)
    if (tables["orbits"]["track"] == PAIR).any():
        figure.axes[0].legend(loc="upper left", fontsize=8)
    return figure
