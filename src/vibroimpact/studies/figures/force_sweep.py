"""Fixed points along the manifold as the force on the second module changes."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from scipy.optimize import linear_sum_assignment

from vibroimpact.accuracy.verdict_table import NO_ORBIT
from vibroimpact.exact.orbits.floquet import floquet
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.figures.plotting.manifold import branches
from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.figures.plotting.style import BLACK, DOUBLE_COLUMN, GREY, heading, new_figure, styled
from vibroimpact.studies.claims.verdict_grid import exact_orbits
from vibroimpact.studies.figures.plotting.regime_colours import COLOURS
from vibroimpact.studies.regimes.classification import ASYMMETRIC
from vibroimpact.studies.regimes.followed import followed
from vibroimpact.system.verdict import STABLE
from vibroimpact.tables import join
from vibroimpact.theory.criteria import CRITERIA, EXACT, THEORY, of_fixed_point
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points

SPEC = {
    "title": "Fixed points against the second force",
    "caption": r"Fixed points against :math:`\hat f_{20}` for :math:`\hat f_{10} = {f10_hat}`, with the chapter's "
        "letters at the force where most of them exist. Stable points are stable on both time scales. Broad dots: "
        "exact asymmetric orbits, which belong to no fixed point, darker if stable.",
    "alt": "Two panels with C1 and C2 of every fixed point against f20, one line per point. Markers are filled if both "
        "time scales are stable, hollow otherwise, and ringed if the exact orbit is stable. Broad dots show the "
        "asymmetric orbits.",
    "method": "fixed points and exact orbits at every value of the force",
    "file": "results/force_sweep/force_sweep.csv",
    "on_demand": "make report",
    "columns": {
        "value": {"meaning": r"value of $\hat f_{20}$", "unit": "dimensionless"},
        "track": {"meaning": "number, from 1, of the line of points that continue each other as the value increases",
            "unit": "number"},
        "C1, B1, C2, B2": {},
        "label": {"meaning": "label (a), (b), (c) in the chapter's order at this value", "unit": "text"},
        "printed_10_26, fast, slow, theory, exact": {},
    },
}  # fmt: skip

LINES = [(BLACK, "-"), (BLACK, (0, (4.5, 1.5))), (GREY, "-"), (GREY, (0, (4.5, 1.5)))]
"""Colour and line style of the tracks in turn; a track is a fixed point followed from force to force."""
MARKS = {
    "theory: stable": {"markerfacecolor": BLACK, "markersize": 3.6},
    "theory: unstable": {"markerfacecolor": "white", "markersize": 3.6},
    "exact orbit: stable": {"markerfacecolor": "none", "markersize": 7.0},
}
PAIRS = {"asymmetric orbits, stable": COLOURS[ASYMMETRIC], "asymmetric orbits, unstable": "#a9d8d2"}
MARKER_SPACING = 6
"""Number of values of the force from one marker on a track to the next. A marker is filled if the theory calls the
fixed point stable on both time scales, and has a ring if the exact orbit of the point is stable."""
ASYMMETRIC_TRACK = 0
"""Track number of all asymmetric orbits, since they belong to none of the followed fixed points."""
VERDICTS = (*CRITERIA, EXACT)


def compute(system, range, values: int, C_max: float) -> dict[str, pd.DataFrame]:
    """Return all fixed points at each value of f20_hat, followed from value to value, and the manifold.

    Parameters
    ----------
    system : System
        System; its f20_hat is replaced by each of the values.
    range : tuple of float
        Ends of the interval of f20_hat.
    values : int
        Number of values in the interval, both ends included.
    C_max : float
        The manifold is shown for 0 <= C <= C_max, or further if a fixed point lies beyond.

    Returns three tables. "csv": columns value, track (number from 1; see `_continued`), C1, B1, C2, B2, label (as in
    the chapter, see `theory.fixed_points.labels`), and one column for each of VERDICTS, the criteria of the theory and
    the exact orbit ("no orbit" if there is none). "orbits", with a row per multiplier of each exact orbit: columns
    value, track (that of the orbit's fixed point; ASYMMETRIC_TRACK for asymmetric orbits), C1, C2, exact, real, imag.
    "manifold": columns series, C, B as in figure 10.4.
    """
    rows, last, tracks = [], np.empty((0, 2)), 0
    names, multipliers = [], []
    systems = {value: system.with_(f20_hat=value) for value in _values(range, values)}
    for value, system in systems.items():
        points = fixed_points(system)
        now = np.array([point.C for point in points]).reshape(-1, 2)
        names, tracks = _continued(names, last, now, tracks)
        last = now
        exact = exact_orbits(system, now, symmetric_solutions(system)) if points else ()
        for track, point, orbit in zip(names, points, exact, strict=True):
            C, B, verdicts = point.C, point.B, of_fixed_point(system, point)
            row = {"value": value, "track": track, "C1": C[0], "B1": B[0], "C2": C[1], "B2": B[1], "label": point.label}
            rows.append(row | verdicts | {EXACT: floquet(orbit) if orbit else NO_ORBIT})
            multipliers += _multipliers(value, track, orbit) if orbit and orbit.admissible else []
    for value, orbit in followed(systems):
        multipliers += _multipliers(value, ASYMMETRIC_TRACK, orbit)
    points = pd.DataFrame(rows, columns=["value", "track", "C1", "B1", "C2", "B2", "label", *VERDICTS])
    end = np.fmax(C_max, 1.05 * points[["C1", "C2"]].astype(float).max().max())
    orbits = pd.DataFrame(multipliers, columns=["value", "track", "C1", "C2", EXACT, "real", "imag"])
    manifold = join(branches("SIM", system.kappa, end)).drop(columns="panel")
    return {"csv": points, "orbits": orbits, "manifold": manifold}


def _values(range, values):
    return np.round(np.linspace(*range, values), 6).tolist()


def page_data(tables: dict[str, pd.DataFrame], range, values: int, C_max: float) -> dict:
    """Return the data for the slider: branches of the manifold, and fixed points and exact orbits at each value."""
    manifold = {
        series: rows[["C", "B"]].round(4).to_numpy().tolist() for series, rows in tables["manifold"].groupby("series")
    }
    points = {value: [] for value in _values(range, values)}
    orbits = {value: [] for value in points}
    rows = tables["csv"].sort_values(["value", "label"]).round(dict.fromkeys(("C1", "B1", "C2", "B2"), 4))
    for row in rows.to_dict("records"):
        place = {"label": row["label"], "track": row["track"], "C": [row["C1"], row["C2"]], "B": [row["B1"], row["B2"]]}
        points[row["value"]].append(place | {"verdicts": {name: row[name] for name in VERDICTS}})
    for (value, track, C1, C2), rows in tables["orbits"].groupby(["value", "track", "C1", "C2"]):
        place = {"track": track, "C": [round(C1, 4), round(C2, 4)], "exact": rows[EXACT].iloc[0]}
        orbits[value].append(place | {"multipliers": rows[["real", "imag"]].round(4).to_numpy().tolist()})
    lists = {"points": list(points.values()), "orbits": list(orbits.values())}
    return {"manifold": manifold, "values": list(points), **lists}


def _multipliers(value, track, orbit):
    place = value, track, *orbit.C, floquet(orbit)
    return [(*place, multiplier.real, multiplier.imag) for multiplier in orbit.multipliers]


def _continued(names, last, now, tracks):
    """Return the track of each point at the current force, and the number of tracks so far.

    last, now: (C_1, C_2) of the points at the previous and at the current force. names: tracks of the points in `last`.
    tracks: number of tracks before. Points of `last` and `now` are paired so that the sum of their distances is
    smallest. A point of `now` has the track of its partner, or a new one if it has no partner.
    """
    gaps = np.linalg.norm(np.nan_to_num(last[:, None] - now[None]), axis=2)
    found = {new: names[old] for old, new in zip(*linear_sum_assignment(gaps), strict=True)}
    fresh = [new for new in range(len(now)) if new not in found]
    found |= {new: tracks + number for number, new in enumerate(fresh, start=1)}
    return [found[new] for new in range(len(now))], tracks + len(fresh)


@styled
def draw(tables: dict[str, pd.DataFrame]) -> Figure:
    """Draw C_1 and C_2 of each track against the second force, and the exact asymmetric orbits."""
    figure = new_figure(DOUBLE_COLUMN, 84.0)
    points, orbits = tables["csv"], tables["orbits"]
    pair = orbits[orbits["track"] == ASYMMETRIC_TRACK].drop_duplicates(["value", "C1", "C2"])
    # The letter of a track is its label at the force nearest to the middle one of those with the most fixed points.
    counts = points["value"].value_counts().sort_index()
    most = counts.index[counts == counts.max()]
    apart = (points["value"] - most[len(most) // 2]).abs() if len(most) else 0.0
    nearest = points.assign(apart=apart).sort_values("apart", kind="stable")
    letters, names = nearest.groupby("track")["label"].first(), {}
    for axes, module, letter in zip(figure.subplots(1, 2), (1, 2), "ab", strict=True):
        stable = pair[EXACT] == STABLE
        for (name, colour), shown in zip(PAIRS.items(), (stable, ~stable), strict=True):
            dots = {"linestyle": "none", "marker": "o", "markersize": 3.5, "color": colour, "label": name}
            axes.plot(pair["value"][shown], pair[f"C{module}"][shown], **dots)
        tracks = points.groupby("track")
        names[axes] = [(letters[track], _draw_track(axes, rows, module, letters[track])) for track, rows in tracks]
        axes.set(xlabel=r"$\hat f_{20}$", ylabel=f"$C_{module}$")
        if len(points):
            axes.set_xlim(points["value"].min(), points["value"].max())
        heading(axes, letter, f"module {module}")
    handles = dict(zip(*reversed(figure.axes[0].get_legend_handles_labels()), strict=True))
    figure.legend(handles.values(), handles, loc="outside lower center", ncols=3, fontsize=9)
    name_curves(figure, names, color=BLACK)
    return figure


def _draw_track(axes, rows, module, letter):
    """Draw C of a module along a track against the second force, with markers; return the line."""
    C, (colour, style) = f"C{module}", LINES[(rows["track"].iloc[0] - 1) % len(LINES)]
    line = axes.plot(rows["value"], rows[C], color=colour, linestyle=style, label=f"fixed point {letter}")
    marked = rows.iloc[::MARKER_SPACING]
    theory, exact = (marked[name] == STABLE for name in (THEORY, EXACT))
    for (name, look), shown in zip(MARKS.items(), (theory, ~theory, exact), strict=True):
        if shown.any():
            dots = {"linestyle": "none", "marker": "o", "color": BLACK, "label": name}
            axes.plot(marked["value"][shown], marked[C][shown], **dots, **look)
    return line
