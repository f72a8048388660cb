"""Companion: errors of the theory's fixed points, slow rates and fast multipliers as epsilon tends to 0."""

from contextlib import suppress

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from vibroimpact.accuracy.second_term import NoOrbit, first_order
from vibroimpact.figures.plotting.style import BLACK, DOUBLE_COLUMN, GREY, LIGHT_GREY, new_figure, styled
from vibroimpact.studies.regimes.epsilon_limit import distance_to_orbit, order
from vibroimpact.tables import curve, join
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points

SPEC = {
    "title": "Error of the theory against epsilon",
    "caption": "Largest error of the leading-order theory over the fixed points of the three cases against "
        r":math:`\varepsilon`, compared with exact orbits: error of amplitudes and phases, of the rates of the slow "
        "flow, and of the fast multipliers. Grey: amplitudes and phases with the first-order term added, the second "
        "one of (10.7). Triangles: slopes 1 and 2.",
    "alt": "Errors of the theory against epsilon on logarithmic axes: three straight lines of slope 1, for fast "
        "multipliers, slow rates, and amplitudes and phases; a fourth, grey, has slope 2.",
    "method": "fixed points and exact symmetric responses at every epsilon",
    "columns": {
        "panel": {"meaning": "distance: between fixed point and orbit; slow, fast: largest error of a predicted slow "
            "rate or fast multiplier; two terms: distance with the first-order term added to the fixed point",
            "values": ["distance", "slow", "fast", "two terms"]},
        "series": {"meaning": "case and label of the fixed point"},
        "epsilon": {"compared": "algebra"},
        "error": {"meaning": "error named in `panel`: norm of the difference in $C_1$, $C_2$ and both impact phases "
            r"[radians]; largest $\lvert\log\mu/(2\pi\varepsilon/\Omega) - \lambda\rvert$ over the slow multipliers "
            r"$\mu$, with the eigenvalues $\lambda$ of the slow flow; largest $\lvert\mu - \mu_0\rvert$ over the fast "
            r"multipliers, with $\mu_0$ from the impact map", "unit": "dimensionless", "compared": "logarithm"},
    },
    "tables": {
        "orders": {
            "file": "results/regimes/epsilon_orders.csv",
            "about": r"Orders $p$ of error $\sim \varepsilon^p$ in `companion_epsilon`, fitted to the smallest "
                r"$\varepsilon$.",
            "columns": {
                "case": {}, "label": {"meaning": "label of the fixed point", "unit": "text"},
                "panel": {"meaning": "error, as in the panels of `companion_epsilon`", "unit": "text", "values": [
                    "distance", "slow", "fast", "two terms"]},
                "order": {"meaning": "exponent $p$, by least squares on the logarithms", "unit": "dimensionless",
                    "compared": "exponent"},
                "uncertainty": {"meaning": "standard error of `order`", "unit": "dimensionless",
                    "compared": "exponent"},
            },
        },
    },
}  # fmt: skip

TWO_TERMS = "two terms"
LOOKS = {
    "fast": ("fast multipliers", {"color": BLACK, "marker": "^", "markerfacecolor": "white"}),
    "slow": ("rates of the slow multipliers", {"color": BLACK, "marker": "s", "markerfacecolor": "white"}),
    "distance": ("amplitudes and phases", {"color": BLACK, "marker": "o"}),
    TWO_TERMS: ("amplitudes and phases\nwith the first-order term", {"color": GREY, "marker": "D"}),
}
"""Names and styles of the errors in the figure."""
SLOPES = {"slow": (1, 20.0), TWO_TERMS: (2, 0.1)}
"""For each curve with a triangle: the arguments `slope` and `times` of `_slope`."""


def compute(systems: dict, epsilon, values: int, fit_below: float, mixed: dict | None = None) -> dict:
    """Return the errors of the theory for each fixed point at each epsilon, and the orders of these errors.

    Parameters
    ----------
    systems : dict
        System of each case, by name of the case.
    epsilon
        First and last value of epsilon.
    values : int
        Number of values of epsilon, evenly spaced on a log scale.
    fit_below : float
        Upper limit of epsilon in the fit of the orders.
    mixed : dict, optional
        `case` and `label` of a fixed point that is left out. Its fast and slow multipliers cannot be distinguished.

    Returns
    -------
    dict
        The tables in SPEC.

    Raises
    ------
    ValueError
        If the case of `mixed` has no fixed point with its label.
    """
    epsilon = np.geomspace(*epsilon, values)
    curves, orders = [], []
    points = {case: {point.label: point for point in fixed_points(system)} for case, system in systems.items()}
    if mixed and mixed["label"] not in (known := sorted(points[mixed["case"]])):
        what = f"case {mixed['case']!r} has no fixed point {mixed['label']!r} (labels: {', '.join(known) or 'none'})"
        raise ValueError(f"mixed.label: {what}; set mixed to null to keep all points")
    for case, system in systems.items():
        for label, point in sorted(points[case].items()):
            if {"case": case, "label": label} == mixed:
                continue
            found = []
            for value in epsilon:
                with suppress(NoOrbit):
                    found.append(distance_to_orbit(system.with_(epsilon=value), point))
            reached = np.array([c.epsilon for c in found])
            for panel, errors in {
                "distance": np.array([c.distance for c in found]),
                "slow": np.array([c.slow_error for c in found]),
                "fast": np.array([c.fast_error for c in found]),
                TWO_TERMS: _two_terms(system, point, found),
            }.items():
                curves.append(curve(panel, f"{case}, {label}", epsilon=reached, error=errors))
                small = (reached < fit_below) & np.isfinite(errors)
                if np.count_nonzero(small) > 1:
                    slope, uncertainty = order(reached[small], errors[small])
                    named = {"panel": panel, "order": slope, "uncertainty": uncertainty}
                    orders.append({"case": case, "label": label, **named})
    nothing = pd.DataFrame(columns=["panel", "series", "epsilon", "error"])
    columns = ["case", "label", "panel", "order", "uncertainty"]
    return {"csv": join(curves or [nothing]), "orders": pd.DataFrame(orders, columns=columns)}


def _two_terms(system, point, found):
    """Return the distance of each exact orbit from a prediction with two terms.

    The prediction is the fixed point plus its first-order term in epsilon. If the first-order term does not exist, all
    distances are nan.

    found: list of `Comparison`, one for each exact orbit.
    """
    added = np.nan
    with suppress(NoOrbit):
        added = first_order(system, point)[:, np.isfinite(point.C)].ravel()
    return np.array([np.linalg.norm(c.offset - c.epsilon * added) for c in found])


@styled
def draw(tables: dict) -> Figure:
    """Draw the table "csv" of `compute`: the largest error of each kind over all fixed points, with slope triangles."""
    table = tables["csv"]
    figure = new_figure(DOUBLE_COLUMN, 92.0)
    axes = figure.add_subplot()
    axes.set(xscale="log", yscale="log", xlabel=r"$\varepsilon$", ylabel="largest error over all fixed points")
    for panel, (name, look) in LOOKS.items():
        largest = table[table["panel"] == panel].groupby("epsilon")["error"].max().dropna()
        if len(largest):
            axes.plot(largest.index, largest, label=name, markersize=3.6, linewidth=0.8, **look)
            middle = largest.index[len(largest) // 2]
            beside = {"xytext": (-3, 5), "ha": "right", "va": "bottom"} if panel != "distance" else {"xytext": (4, -12)}
            axes.annotate(name, (middle, largest[middle]), textcoords="offset points", **beside)
            if panel in SLOPES:
                _slope(axes, largest.index[-1], largest.iloc[-1], *SLOPES[panel])
    axes.margins(x=0.02, y=0.12)
    return figure


def _slope(axes, epsilon, error, slope, times):
    """Draw a triangle on logarithmic axes. Its sloping side has the given slope.

    The line along the sloping side passes through the point (epsilon, times * error).
    """
    x = epsilon * np.array([0.05, 0.5])
    y = error * times * (x / epsilon) ** slope
    axes.add_patch(Polygon([(x[0], y[0]), (x[1], y[0]), (x[1], y[1])], facecolor=LIGHT_GREY, edgecolor=GREY))
    axes.annotate(f"slope {slope}", (x[1], np.sqrt(y.prod())), (4, 0), textcoords="offset points", va="center")
