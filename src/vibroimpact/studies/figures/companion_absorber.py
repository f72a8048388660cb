"""Companion: peak displacement over a band of frequencies with balls, without balls and with tuned absorbers.

Peaks and clearances are divided by the static deflection f = epsilon f10_hat.
"""

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
from vibroimpact.studies.sweeps.grid import axis
from vibroimpact.system.chapter import PARAMETERS

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
    "sweeps": {
        "frequency_response": {"along": [["sigma_e_hat"], ["f10_hat", "f20_hat"]],
            "observe": ["amplitudes", "energy", "regimes"]},
        "clearance": {"along": [["f10_hat", "f20_hat"]], "observe": ["peaks"]},
        "design": {"along": [["kappa"], ["f10_hat", "f20_hat"]], "observe": ["peaks"]}},
    "columns": {
        "sweep": {"meaning": "sweep of the config", "unit": "text", "values": ["clearance", "design"]},
        "kappa": {"compared": "algebra"},
        "clearance": {"meaning": "$1/f = k_1L/F$, clearance over static deflection", "unit": "dimensionless",
            "compared": "algebra"},
        "ratio": {"meaning": r"peak of $\lvert X_i\rvert/f$ in the band for the box that moves more: value exceeded in "
            "1 % of the cycles of all starts", "unit": "dimensionless", "compared": "extremes"},
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
                    "linear absorbers need on each side. For all frequencies at one force: greatest, the largest "
                    r"ratio of the largest $\lvert X_i\rvert$ with balls to that of `who`; impact share, the median "
                    "share of the work of the forces that impacts dissipate",
                    "unit": "text", "values": ["peak", "lowest peak", "plateau", "plateau from", "plateau to",
                    "stroke", "greatest", "impact share"]},
                "who": {"meaning": "balls at the kappa of the config, balls at the best kappa of the sweep `design`, "
                    "or the linear system for comparison",
                    "unit": "text", "values": ["balls", "balls, best kappa", "without balls",
                    "absorbers of the textbook", "best absorbers"]},
                "value": {"meaning": "value of the quantity. For a peak with balls, the two lowest peaks of the sweep "
                    "are measured again, from rest and seven other starts, also at frequencies half-way between; the "
                    "value is the lower result",
                    "unit": "dimensionless", "compared": {"greatest": "extremes", "impact share": "extremes",
                    "without balls": "algebra", "absorbers of the textbook": "trajectory",
                    "best absorbers": "trajectory", "others": "peaks"}},
                "spread": {"meaning": "standard error of `value` by the jackknife, with one start left out at a time",
                    "unit": "dimensionless", "compared": "spreads"},
                "kappa": {"compared": {"lowest peak": "algebra", "others": "places"}},
                "f10_hat, f20_hat": {"compared": {"peak": "places", "lowest peak": "places", "others": "algebra"}},
                "clearance": {"meaning": "$1/f = k_1L/F$, clearance over static deflection, at the lowest peak",
                    "unit": "dimensionless", "compared": "places"},
            },
        },
    },
}  # fmt: skip

BALLS, BEST_KAPPA = "balls", "balls, best kappa"
PEAK = "peak"
"""Names of rows and of a quantity in the summary."""
LIGHT = "#D55E00"
STAR = {"marker": "*", "markersize": 11, "markerfacecolor": "white", "markeredgewidth": 0.8, "linestyle": "none"}
"""LIGHT is the colour of the best restitution coefficient, STAR the marker of the lowest peaks."""
PLATEAU_FACTOR = 1.2
"""The plateau is the range of small kappa with lowest peaks of at most PLATEAU_FACTOR times the lowest of all."""
REMEASURED_PEAKS = 2
"""Number of the lowest peaks of a sweep that are measured again."""
REMEASURED_STARTS = 8
"""Number of starts, rest among them, in the second measurement of a lowest peak."""
SUMMARY_COLUMNS = ["quantity", "who", "value", "spread", "kappa", *FORCES, "clearance"]


def compute(system, response, clearance, design, band: dict, seed: int, cycles: int, settle: int) -> dict:
    """Return the peaks with balls, and a summary that compares them with linear systems.

    The lowest peak of a sweep is too low, since it is the lowest of many values with random errors. Therefore the
    lowest peaks are measured again from other initial states. The new value is a lower bound, since possibly no initial
    state leads to the largest motion.

    Parameters
    ----------
    response
        Table of a sweep over sigma_e_hat and the pair of forces, with regimes, amplitudes and energy.
    clearance, design
        Tables of two sweeps that observe the peaks in the band. Both sweeps vary the pair of forces. The sweep `design`
        also varies kappa.
    band : dict
        Arguments of `sweeps.grid.axis` for the band of detunings sigma_e_hat.
    seed : int
        Seed of the initial states in the sweeps.
    cycles, settle : int
        Length of each run, and length of the omitted transient at its start, in forcing periods.

    Returns
    -------
    dict
        The tables in SPEC.
    """
    linear = linear_systems(system, (1.0, 1.0), band)
    peaks = {name: one.peak(frequencies(system, band)) / system.epsilon for name, one in linear.items()}
    clearance, design = (_peaks(system, table) for table in (clearance, design))
    again = {"band": band, "states": spread_starts(REMEASURED_STARTS, seed + 1), "cycles": cycles, "settle": settle}
    own = _lowest_again(system, clearance, **again)
    restitution = [_lowest_again(system, mine, **again) for _, mine in design.dropna(subset="ratio").groupby("kappa")]
    best = min(restitution, key=lambda place: place["value"])

    rows = [{"quantity": PEAK, "who": name, "value": peak} for name, peak in peaks.items()]
    rows += [{"quantity": PEAK, "who": who, **place} for who, place in ((BALLS, own), (BEST_KAPPA, best))]
    rows += [{"quantity": "lowest peak", "who": BALLS, **place} for place in restitution]
    named = zip(("plateau", "plateau from", "plateau to"), plateau(restitution), strict=True)
    rows += [{"quantity": quantity, "who": BALLS, "value": value} for quantity, value in named]
    stroke = linear["best absorbers"].stroke(frequencies(system, band)) / system.epsilon
    rows.append({"quantity": "stroke", "who": "best absorbers", "value": stroke})
    rows += _over_frequencies(system, per_force(system, response), band)
    swept = pd.concat([clearance.assign(sweep="clearance"), design.assign(sweep="design")])
    return {
        "csv": swept[["sweep", "kappa", "clearance", "ratio"]],
        "summary": pd.DataFrame(rows, columns=SUMMARY_COLUMNS),
    }


def _peaks(system, table):
    """Return the table of a sweep with three more columns, where f is epsilon f10_hat.

    clearance: 1 / f.
    kappa: restitution coefficient.
    ratio: peak / f.
    """
    force, kappa = system.epsilon * table["f10_hat"], table.get("kappa", system.kappa)
    return table.assign(clearance=1 / force, kappa=kappa, ratio=table["peak"] / force)


def _lowest_again(system, table, band, states, cycles, settle):
    """Measure the lowest peaks of a sweep again, and return the row with the lowest new peak.

    The row has two new entries: `value` (the new peak) and `spread` (its standard error), both divided by f.
    """
    detunings = np.sort(np.ravel(axis(**band).values))
    detunings = np.sort(np.r_[detunings, 0.5 * (detunings[1:] + detunings[:-1])])
    places = table.nsmallest(REMEASURED_PEAKS, "ratio").to_dict("records")
    for place in places:
        there = system.with_(**{name: place[name] for name in ("kappa", *FORCES)})
        value, error = peak([there.with_(sigma_e_hat=float(value)) for value in detunings], states, cycles, settle)
        place |= {"value": value * place["clearance"], "spread": error * place["clearance"]}
    return min(places, key=lambda place: place["value"])


def plateau(places):
    """Return the largest kappa, the smallest peak and the largest peak on the plateau.

    places: rows with the lowest peak at each kappa, in ascending order of kappa. The plateau ends before the first peak
    that exceeds PLATEAU_FACTOR times the lowest of all peaks. If the plateau is empty, all three results are nan.
    """
    level = PLATEAU_FACTOR * min(place["value"] for place in places)
    on = list(takewhile(lambda place: place["value"] <= level, places))
    peaks = [place["value"] for place in on]
    return (on[-1]["kappa"], min(peaks), max(peaks)) if on else (float("nan"),) * 3


def _over_frequencies(system, response, band):
    """Yield two rows of the summary for each pair of forces.

    One row has the largest ratio of the response with balls to the response without balls, over all frequencies. The
    other row has the median of the share of the work that impacts dissipate.
    """
    for pair, rows in response.groupby(FORCES, sort=False):
        without, place = linear_systems(system, pair, band)["without balls"], dict(zip(FORCES, pair, strict=True))
        greatest = (rows["ratio"] / ratios(system, without, rows["sigma_e_hat"])).max()
        yield {"quantity": "greatest", "who": "without balls", "value": greatest, **place}
        yield {"quantity": "impact share", "who": BALLS, "value": rows["impact_share"].median(), **place}


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
        axes.plot(best["clearance"], best["value"], **STAR | {"color": colour}, zorder=1)
        chapter = "\n(chapter)" if best["kappa"] == PARAMETERS["kappa"] else ""
        below = {"textcoords": "offset points", "va": "top", "color": colour}
        axes.annotate(rf"balls, $\kappa = {best['kappa']:g}${chapter}", best[["clearance", "value"]], (0, -7), **below)
    named = {"without balls": "without balls", "best absorbers": "best linear absorbers"}
    for name, words in named.items():
        place = {"xycoords": axes.get_yaxis_transform(), "textcoords": "offset points"}
        axes.annotate(words, (0.03, peaks.loc[name, "value"]), (0, 4), **place)
    axes.set(xlabel="clearance over static deflection, $1/f$", ylabel="peak over static deflection, $|X_i|\\,/\\,f$")
    star = Line2D([], [], **STAR, color=BLACK, label="lowest, measured again with more starts")
    figure.legend(handles=[star], loc="outside lower center", fontsize=9)
    return figure
