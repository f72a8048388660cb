"""Companion: peak response with balls over a band of frequencies, compared with no balls and with tuned absorbers.

Peaks and clearances are divided by the static deflection: X / f and 1 / f, with f = epsilon f10_hat.
"""

from collections import Counter
from itertools import takewhile

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from vibroimpact.figures.plotting.style import BLACK, SINGLE_COLUMN, new_figure, styled
from vibroimpact.studies.absorbers.peaks import peak
from vibroimpact.studies.figures.companion_response import (
    FORCES,
    LINES,
    frequencies,
    linear_systems,
    logarithmic,
    per_force,
    ratios,
)
from vibroimpact.studies.regimes.classification import starts as spread_starts
from vibroimpact.studies.regimes.settling import Observation
from vibroimpact.studies.regimes.settling import settle as settled
from vibroimpact.studies.sweeps.grid import axis

SPEC = {
    "title": "Peak reduction by impacting balls",
    "caption": "Peak displacement in a band of frequencies against the clearance, both over the static deflection "
        r":math:`f = \varepsilon\hat f_{i0}`. A peak is the value exceeded in 1 % of the cycles at the worst "
        "frequency. Black: restitution coefficient of the chapter; orange: best one tested. Stars: the lowest peaks, "
        "measured again from more starts at twice as many frequencies. Level lines: without balls, and the best "
        "linear absorbers with the mass of the balls.",
    "alt": "Peak against clearance on logarithmic axes, with two valleys of dots. The valley of the small restitution "
        "coefficient is half as high as that of the chapter's. Of two level lines, the one without balls lies far "
        "above, the one of the best linear absorbers at half the height of the lower valley.",
    "method": "points of three sweeps; linear systems in closed form; absorbers tuned by optimisation",
    "sweeps": {"clearance": {"along": [["f10_hat", "f20_hat"]],
        "observe": ["peaks", "amplitudes", "energy", "regimes"]},
        "design": {"along": [["kappa"], ["f10_hat", "f20_hat"]], "observe": ["peaks"]}},
    "columns": {
        "sweep": {"meaning": "sweep of the config", "unit": "text", "values": ["clearance", "design"]},
        "kappa": {"compared": "algebra"},
        "clearance": {"meaning": "$1/f = k_1L/F$, clearance over static deflection", "unit": "dimensionless",
            "compared": "algebra"},
        "ratio": {"meaning": r"peak of $\lvert X_i\rvert/f$ in the band for the box that moves more: value exceeded in "
            "1 % of the cycles of all starts", "unit": "dimensionless", "compared": "extremes"},
        "one_ball": {"meaning": "the same for the start from rest, if only one ball ever hits its walls; otherwise "
            "blank",
            "unit": "dimensionless", "compared": "extremes"},
    },
    "tables": {
        "summary": {
            "file": "results/absorber.csv",
            "about": "Effect of the balls in numbers, for the system and the band of the sweep `clearance`.",
            "columns": {
                "quantity": {"meaning": r"peak: largest $\lvert X_i\rvert/f$ in the band (with balls, the value "
                    "exceeded in 1 % of the cycles) at the clearance (and kappa) with the lowest peak in the sweep. "
                    "lowest peak: the same at each kappa of the sweep `design`. plateau: largest kappa up to which all "
                    "lowest peaks are at most 1.2 times the lowest of all; plateau from, plateau to: the least and the "
                    r"greatest of these peaks. stroke: largest $\lvert X_i - Y_i\rvert/f$ in the band, the room that "
                    "linear absorbers need on each side; for balls, the clearance. For balls compared with `who` at "
                    "one force: frequencies won, share of frequencies at which the boxes move less with balls; least "
                    r"and greatest, extremes of the ratio of the largest $\lvert X_i\rvert$ to that of `who`",
                    "unit": "text", "values": ["peak", "lowest peak", "plateau", "plateau from", "plateau to",
                    "stroke", "frequencies won", "least", "greatest"]},
                "who": {"meaning": "balls at the kappa of the config, balls at the best kappa of the sweep `design`, "
                    "one ball at the kappa of the config while the other hits no wall, or the linear system for "
                    "comparison",
                    "unit": "text", "values": ["balls", "balls, best kappa", "one ball", "without balls", "balls fixed",
                    "absorbers of the textbook", "best absorbers"]},
                "value": {"meaning": "value of the quantity. For a peak with balls, the two lowest peaks of the sweep "
                    "are measured again, from rest and seven other starts, also at frequencies half-way between; the "
                    "value is the lower result. For one ball, it is the peak of the sweep, from rest",
                    "unit": "dimensionless", "compared": {
                    "without balls": "algebra", "balls fixed": "algebra",
                    "absorbers of the textbook": "trajectory", "best absorbers": "trajectory",
                    "frequencies won": "shares", "least": "extremes", "greatest": "extremes", "others": "peaks"}},
                "spread": {"meaning": "standard error of `value` by the jackknife, with one start left out at a time",
                    "unit": "dimensionless", "compared": "spreads"},
                "largest": {"meaning": r"largest $\lvert X_i\rvert/f$ in the same cycles. For a chaotic motion it "
                    "increases with their number, in contrast to `value`", "unit": "dimensionless",
                    "compared": "peaks"},
                "of_absorbers, of_without": {"meaning": "for a peak, ratio of the value to that of the best absorbers, "
                    "and to that without balls", "unit": "dimensionless", "compared": "peaks"},
                "swept": {"meaning": "peak at the same point in the sweep", "unit": "dimensionless",
                    "compared": "extremes"},
                "kappa": {"compared": {"lowest peak": "algebra", "others": "places"}},
                "f10_hat, f20_hat": {"compared": {"peak": "places", "lowest peak": "places", "others": "algebra"}},
                "sigma_e_hat": {"meaning": "detuning of the forcing, (10.6), at the peak",
                    "unit": "dimensionless", "compared": "places"},
                "clearance, narrowest, widest": {"meaning": "$1/f = k_1L/F$, clearance over static deflection, at the "
                    "lowest peak, and the ends of the range around it, on the grid of the sweep, in which the peak is "
                    "at most 1.25 times as high", "unit": "dimensionless", "compared": "places"},
                "regime": {"meaning": "`regime` that most starts reach there", "unit": "text",
                    "compared": "places"},
            },
        },
    },
}  # fmt: skip

BALLS, ONE_BALL, BEST_KAPPA = "balls", "one ball", "balls, best kappa"
PEAK, LOWEST, PLATEAU, STROKE = "peak", "lowest peak", "plateau", "stroke"
"""Names of quantities in the summary; `_response_ratios` defines further names."""
LIGHT = "#D55E00"
STAR = {"marker": "*", "markersize": 9, "markeredgecolor": "white", "markeredgewidth": 0.4, "linestyle": "none"}
"""LIGHT is the colour of the best restitution coefficient, STAR the marker of the lowest peaks."""
MARGIN_FACTOR = 1.25
"""The margin of the best clearance is the range of clearances with peaks up to MARGIN_FACTOR times the lowest peak."""
PLATEAU_FACTOR = 1.2
"""The plateau is the range of small kappa with lowest peaks of at most PLATEAU_FACTOR times the lowest of all."""
FROM, TO = "plateau from", "plateau to"
REMEASURED_PEAKS = 2
"""Number of the lowest peaks of a sweep that are measured again."""
REMEASURED_STARTS = 8
"""Number of starts, rest among them, in the second measurement of a lowest peak."""
PLACE = "kappa", *FORCES, "sigma_e_hat", "clearance"
SUMMARY_COLUMNS = ["quantity", "who", "value", "spread", "largest", "swept", *PLACE, "narrowest", "widest", "regime"]


def compute(
    system, response, clearance, design, band: dict, observation: dict, starts: int, seed: int, cycles: int, settle: int
) -> dict:
    """Return the peaks with balls per unit force, and a summary that compares them with linear systems.

    The lowest peak of a sweep is biased: the lowest of many values with random errors is too low. So the
    REMEASURED_PEAKS lowest peaks are measured again (`absorbers.peaks`), from rest and other starts, at the
    frequencies of the band and half-way between them. The lowest of the new values is reported, with its standard
    error. It is a lower bound, since a motion that no start reaches may move the boxes further.

    Parameters
    ----------
    system
        System of the sweeps, for the parameters that do not vary.
    response
        Table of a sweep over sigma_e_hat, then both forces, with regimes and amplitudes.
    clearance, design
        Tables of two sweeps with the peaks along `band`: `clearance` over both forces, `design` over kappa and then
        both forces.
    band : dict
        Arguments of `sweeps.grid.axis`, along sigma_e_hat.
    observation, starts
        Arguments of `regimes.settling.Observation`, and number of starts, to find the regime at a lowest peak.
    seed : int
        Seed of the starts in the sweeps.
    cycles, settle : int
        Forcing periods of each run in the sweeps, and how many of them are left out at its start.

    Returns "csv", the peaks of both sweeps: columns sweep, kappa, clearance, ratio (X / f), one_ball; and "summary":
    columns quantity, who, value, ... (see SPEC).
    """
    linear = linear_systems(system, (1.0, 1.0), band)
    peaks = {name: one.peak(frequencies(system, band)) / system.epsilon for name, one in linear.items()}
    clearance, design = (_peaks(system, table) for table in (clearance, design))
    alone = clearance.assign(ratio=clearance["one_ball"]).dropna(subset="ratio")
    again = {"band": band, "states": spread_starts(REMEASURED_STARTS, seed + 1), "cycles": cycles, "settle": settle}
    own = _lowest_again(system, clearance, **again)
    restitution = [_lowest_again(system, mine, **again) for _, mine in design.dropna(subset="ratio").groupby("kappa")]
    best = min(restitution, key=lambda place: place["value"])
    optima = {BALLS: own, BEST_KAPPA: best}
    if len(alone):  # this peak is for the start from rest, so it is not measured again with other starts
        (one_ball,) = _lowest(alone, 1)
        optima[ONE_BALL] = {**one_ball, "value": one_ball["swept"], "sigma_e_hat": one_ball["peak_at"]}

    rows = [{"quantity": PEAK, "who": name, "value": peak} for name, peak in peaks.items()]
    for who, place in optima.items():
        there = system.with_(**{name: place[name] for name in ("kappa", *FORCES, "sigma_e_hat")})
        begun = spread_starts(1 if who == ONE_BALL else starts, seed)
        regimes = Counter(regime.name for regime in settled(there, begun, Observation(**observation)))
        rows.append({"quantity": PEAK, "who": who, **place, "regime": regimes.most_common(1)[0][0]})
    rows += [{"quantity": LOWEST, "who": BALLS, **place} for place in restitution]
    named = zip((PLATEAU, FROM, TO), plateau(restitution), strict=True)
    rows += [{"quantity": quantity, "who": BALLS, "value": value} for quantity, value in named]
    strokes = {
        name: linear[name].stroke(frequencies(system, band)) / system.epsilon
        for name in ("absorbers of the textbook", "best absorbers")
    }
    strokes |= {who: optima[who]["clearance"] for who in (BALLS, BEST_KAPPA)}
    rows += [{"quantity": STROKE, "who": who, "value": stroke} for who, stroke in strokes.items()]
    rows += _response_ratios(system, per_force(system, response), band)
    summary = pd.DataFrame(rows, columns=SUMMARY_COLUMNS)
    for column, name in (("of_without", "without balls"), ("of_absorbers", "best absorbers")):
        summary.insert(5, column, (summary["value"] / peaks[name]).where(summary["quantity"] == PEAK))
    swept = pd.concat([clearance.assign(sweep="clearance"), design.assign(sweep="design")])
    return {"csv": swept[["sweep", "kappa", "clearance", "ratio", "one_ball"]], "summary": summary}


def _peaks(system, table):
    """Return the table with the clearance 1 / f and the peaks divided by f = epsilon f10_hat."""
    force = system.epsilon * table["f10_hat"]
    kappa = table.get("kappa", system.kappa)
    return table.assign(
        clearance=1 / force, kappa=kappa, ratio=table["peak"] / force, one_ball=table["peak_one_ball"] / force
    )


def _lowest(table, number):
    """Return the `number` points with the lowest peaks in a sweep over the clearance.

    Each point has the margin of its clearance (see MARGIN_FACTOR) as "narrowest" and "widest".
    """
    beside, places = table.sort_values("clearance").reset_index(drop=True), []
    for here in beside["ratio"].nsmallest(number).index:
        place = beside.loc[here].to_dict()
        far = ~(beside["ratio"] <= MARGIN_FACTOR * place["ratio"]).to_numpy()
        first, last = np.flatnonzero(np.r_[True, far[:here]])[-1], here + int(np.argmax(np.r_[far[here:], True])) - 1
        margin = {"narrowest": beside["clearance"][first], "widest": beside["clearance"][last]}
        places.append({**place, "swept": place["ratio"], **margin})
    return places


def _lowest_again(system, table, band, states, cycles, settle):
    """Measure the REMEASURED_PEAKS lowest peaks of a sweep again, and return the point with the lowest result.

    Its new entries are value, spread and largest, all divided by the force, and the sigma_e_hat of the peak.
    """
    detunings = np.sort(np.ravel(axis(**band).values))
    detunings = np.sort(np.r_[detunings, 0.5 * (detunings[1:] + detunings[:-1])])
    places = []
    for place in _lowest(table, REMEASURED_PEAKS):
        there = system.with_(**{name: place[name] for name in ("kappa", *FORCES)})
        found = peak([there.with_(sigma_e_hat=float(value)) for value in detunings], states, cycles, settle)
        measured = {"value": found.value, "spread": found.error, "largest": found.largest}
        measured = {name: value * place["clearance"] for name, value in measured.items()}
        places.append({**place, **measured, "sigma_e_hat": float(detunings[found.at])})
    return min(places, key=lambda place: place["value"])


def plateau(places):
    """Return the largest kappa on the plateau, and the least and the greatest of the lowest peaks on the plateau.

    places: the point with the lowest peak for each kappa, ascending in kappa. Up to the end of the plateau, each lowest
    peak is at most PLATEAU_FACTOR times the lowest of all. If the lowest peak at the least kappa is already higher, all
    three results are nan.
    """
    level = PLATEAU_FACTOR * min(place["value"] for place in places)
    on = list(takewhile(lambda place: place["value"] <= level, places))
    peaks = [place["value"] for place in on]
    return (on[-1]["kappa"], min(peaks), max(peaks)) if on else (float("nan"),) * 3


def _response_ratios(system, response, band):
    """For each pair of forces and each linear system, yield statistics of a ratio over the frequencies.

    The ratio is the response with balls divided by the response of the linear system.
    """
    for pair, rows in response.groupby(FORCES, sort=False):
        for name, one in linear_systems(system, pair, band).items():
            times = rows["ratio"] / ratios(system, one, rows["sigma_e_hat"])
            measures = {"frequencies won": (times < 1).mean(), "least": times.min(), "greatest": times.max()}
            place = dict(zip(FORCES, pair, strict=True))
            yield from ({"quantity": q, "who": name, "value": v, **place} for q, v in measures.items())


@styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`: peaks against clearance for two restitution coefficients and two linear systems."""
    swept, peaks = tables["csv"], tables["summary"].query(f"quantity == '{PEAK}'").set_index("who")
    figure = new_figure(SINGLE_COLUMN, 72.0)
    axes = figure.add_subplot()
    logarithmic(axes, "x", *swept["clearance"].agg(["min", "max"]))
    logarithmic(axes, "y", 3.0, 80.0)
    for name in ("without balls", "best absorbers"):
        axes.axhline(peaks.loc[name, "value"], **LINES[name])
    for who, sweep, colour, marker in ((BALLS, "clearance", BLACK, "o"), (BEST_KAPPA, "design", LIGHT, "s")):
        best = peaks.loc[who]
        rows = swept[(swept["sweep"] == sweep) & (swept["kappa"] == best["kappa"])]
        axes.plot(rows["clearance"], rows["ratio"], f"{marker}-", color=colour, markersize=3, linewidth=0.7)
        axes.plot(best["clearance"], best["value"], **STAR | {"color": colour}, zorder=4)
        below = {"textcoords": "offset points", "va": "top", "color": colour}
        axes.annotate(rf"balls, $\kappa = {best['kappa']:g}$", best[["clearance", "value"]], (0, -7), **below)
    named = {"without balls": "without balls", "best absorbers": "best linear absorbers"}
    for name, words in named.items():
        place = {"xycoords": axes.get_yaxis_transform(), "textcoords": "offset points"}
        axes.annotate(words, (0.03, peaks.loc[name, "value"]), (0, 4), **place)
    axes.set(xlabel="clearance over static deflection, $1/f$", ylabel="peak over static deflection, $|X_i|\\,/\\,f$")
    star = Line2D([], [], **STAR, color=BLACK, label="lowest, measured again with more starts")
    figure.legend(handles=[star], loc="outside lower center", fontsize=9)
    return figure
