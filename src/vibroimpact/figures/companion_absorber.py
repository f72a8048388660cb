"""Companion: which clearance and restitution serve best, against no balls, fixed balls and tuned absorbers.

All is per force: X / f over 1 / f, displacement over static deflection, clearance over static deflection.
"""

from collections import Counter
from itertools import takewhile

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.absorbers.peaks import peak
from vibroimpact.figures.companion_response import FORCES, frequencies, linear_systems, per_force, ratios
from vibroimpact.figures.kit.absorber_looks import BEST, DOTS, LEAST, LINES, MOST, draw_lines, logarithmic
from vibroimpact.figures.kit.style import BLACK, DOUBLE_COLUMN, hatch_gaps, letter_panel, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join, select
from vibroimpact.figures.sweep import SYMBOLS, edges
from vibroimpact.regimes.classification import starts as spread_starts
from vibroimpact.regimes.settling import Observation
from vibroimpact.regimes.settling import settle as settled
from vibroimpact.sweeps.grid import LOGARITHMIC, axis

SPEC = {
    "title": "Which balls serve best",
    "caption": r"Peaks of :math:`|X_i|/f`, displacement per static deflection with :math:`f = \varepsilon\hat f_{i0}`, "
        "in a band of frequencies: at its worst frequency, what one cycle in a hundred exceeds. a: over the clearance; "
        "triangles: from rest only one ball ever meets a wall; lines: linear systems in closed form, the absorbers of "
        "the mass of the balls. b: for each restitution the lowest peak over the clearances of c, the lower of two "
        "measured again from rest and seven other starts at twice as many frequencies; upright bars: its standard "
        "error to either side. c: the peak over both, lighter is better. Stars: the lowest peak of each panel, in a "
        "and b as high as measured again; level bars: clearances whose peak is at most 1.25 times as high.",
    "alt": "Three panels. a: the peak over the clearance, a valley between two horizontal pairs of lines, triangles "
        "around its lowest dots. b: dots with upright bars, level at small restitution, then rising to more than twice "
        "as much, all above the lines of linear absorbers. c: a map in grey with the lowest peak marked by a star.",
    "method": "the points of three sweeps; linear systems in closed form, absorbers tuned by optimisation",
    "sweeps": {"clearance": {"along": [["f10_hat", "f20_hat"]],
        "observe": ["peaks", "amplitudes", "envelopes", "energy", "regimes"]},
        "design": {"along": [["kappa"], ["f10_hat", "f20_hat"]], "observe": ["peaks"]}},
    "columns": {
        "panel": {"values": ["clearance", "restitution", "design"]},
        "series": {"meaning": "balls, as simulated, one ball where from rest the other never meets a wall, the lowest "
            "peak of the balls measured again, or the linear system", "values": ["balls", "one ball", "lowest peak",
            "without balls", "balls fixed", "absorbers of the textbook", "best absorbers"]},
        "clearance": {"meaning": "$1/f = k_1L/F$, clearance over static deflection", "unit": "dimensionless",
            "compared": {"lowest peak": "extremes", "others": "algebra"}},
        "ratio": {"meaning": r"peak of $\lvert X_i\rvert/f$ in the band, of the box that moves more; of balls what one "
            "cycle in a hundred of all starts exceeds", "unit": "dimensionless", "compared": {
            "best absorbers": "trajectory", "balls": "extremes", "one ball": "extremes", "lowest peak": "peaks",
            "others": "algebra"}},
        "kappa": {"compared": "algebra"},
        "low, high": {"meaning": "of a lowest peak: less and more its standard error, the `spread` of `absorber.csv`",
            "unit": "dimensionless", "compared": "peaks"},
    },
    "tables": {
        "summary": {
            "file": "results/absorber.csv",
            "about": "What the balls are good for, in numbers, at the system of the sweep `clearance` and along its "
                "band.",
            "columns": {
                "quantity": {"meaning": r"peak: the largest $\lvert X_i\rvert/f$ in the band, of balls what one "
                    "cycle in a hundred exceeds, at the clearance (and kappa) where it is lowest in the sweep. lowest "
                    "peak: the same at each kappa of the sweep `design`. plateau: the largest kappa up to which lowest "
                    "peaks are at most 1.2 times the lowest of all; plateau from, plateau to: the least and the "
                    r"greatest of these. stroke: the largest $\lvert X_i - Y_i\rvert/f$ in the band, the room that "
                    "linear absorbers need to each side; of balls the clearance. Of balls against who, at one "
                    "force: frequencies won, the share of frequencies at which the boxes move less with balls; least "
                    r"and greatest of the largest $\lvert X_i\rvert$ over that of who", "unit": "text",
                    "values": ["peak", "lowest peak", "plateau", "plateau from", "plateau to", "stroke",
                    "frequencies won", "least", "greatest"]},
                "who": {"meaning": "balls at the kappa of the config, balls at the best kappa of the sweep `design`, "
                    "one ball at the kappa of the config while the other meets no wall, or what they are held against",
                    "unit": "text", "values": ["balls", "balls, best kappa", "one ball", "without balls", "balls fixed",
                    "absorbers of the textbook", "best absorbers"]},
                "value": {"meaning": "what the quantity says; of a peak of balls the lower of two measured again where "
                    "the sweep has its lowest, from rest and seven other starts, at frequencies half-way between, too; "
                    "with one ball as in the sweep, from rest", "unit": "dimensionless", "compared": {
                    "without balls": "algebra",
                    "balls fixed": "algebra", "absorbers of the textbook": "trajectory", "best absorbers": "trajectory",
                    "frequencies won": "free", "least": "extremes", "greatest": "extremes", "others": "peaks"}},
                "spread": {"meaning": "standard error of `value`: the jackknife, one start left out at a time",
                    "unit": "dimensionless", "compared": "free"},
                "largest": {"meaning": r"the largest $\lvert X_i\rvert/f$ in the same cycles. Of a chaotic motion it "
                    "grows with their number, as `value` does not", "unit": "dimensionless", "compared": "peaks"},
                "of_absorbers, of_without": {"meaning": "of a peak: the value over that of the best absorbers, and "
                    "over that without balls", "unit": "dimensionless", "compared": "peaks"},
                "swept": {"meaning": "the peak there as the sweep has it", "unit": "dimensionless",
                    "compared": "extremes"},
                "kappa": {"compared": {"lowest peak": "algebra", "others": "extremes"}},
                "f10_hat, f20_hat": {"compared": "extremes"},
                "sigma_e_hat": {"meaning": "detuning of the forcing, (10.6), at which the peak is met",
                    "unit": "dimensionless", "compared": "free"},
                "clearance, narrowest, widest": {"meaning": "$1/f = k_1L/F$, clearance over static deflection, where "
                    "the peak is lowest; and how far about it, on the grid of the sweep, it is at most 1.25 times as "
                    "high", "unit": "dimensionless", "compared": "extremes"},
                "regime": {"meaning": "the `regime` that most starts end in there", "unit": "text",
                    "compared": "few outcomes"},
            },
        },
    },
}  # fmt: skip

BALLS, ONE_BALL, BEST_KAPPA = "balls", "one ball", "balls, best kappa"
SWEPT = {
    BALLS: {**DOTS, "linestyle": "-", "linewidth": 0.6},
    ONE_BALL: {**DOTS, "marker": "^", "markersize": 6.5, "markerfacecolor": "none"},
}
PEAK, LOWEST, PLATEAU, STROKE = "peak", "lowest peak", "plateau", "stroke"
"""Quantities of the summary, beside those of `_held_against`."""
NEARLY = 1.25
"""The margin of a clearance: where the peak is at most so many times the lowest."""
_MARGIN = {"color": BLACK, "linewidth": 2.6, "solid_capstyle": "butt", "label": f"at most {NEARLY} times the lowest"}
LEVEL = 1.2
"""The plateau of the restitution: from the least kappa on, lowest peaks at most so many times the lowest of all."""
FROM, TO = "plateau from", "plateau to"
FEW = 2
"""The lowest peaks of a sweep that are measured again."""
FRESH = 8
"""Starts that a lowest peak is measured from again, rest among them."""
PANELS = {"clearance": "clearance", "kappa": "restitution"}
"""Panels of curves, by what they are over."""
TOLD = ("value", "spread", "largest", "swept", "kappa", *FORCES, "sigma_e_hat", "clearance", "narrowest", "widest")
"""Columns of the summary."""


def compute(
    system, response, clearance, design, band: dict, observation: dict, starts: int, seed: int, cycles: int, settle: int
) -> dict:
    """Return results of the sweeps with balls, per force, beside linear systems in closed form.

    A lowest peak of a sweep is too low: the lowest of many places is where chance was kind. So the FEW lowest are
    measured again at their places, from rest and other starts and at the frequencies of the band and those half-way
    between them (`absorbers.peaks`), and the lowest of these is taken, with its standard error. A motion that none of
    the starts meets may still move the boxes further.

    Args:
        system: whose other parameters the sweeps keep.
        response: table of a sweep over sigma_e_hat, then both forces, of regimes, amplitudes and envelopes.
        clearance, design: of peaks along `band`, over both forces; over kappa, then both forces.
        band: arguments of `sweeps.grid.axis`, along sigma_e_hat.
        observation, starts: how long, and from how many starts, the regime at an optimum is looked for.
        seed: of the starts of the sweeps. cycles, settle: of their runs.

    Returns "csv": columns panel ("clearance", "restitution" or "design"), series, clearance, kappa, ratio (X / f), low
    and high (of a lowest peak, by its standard error).
    "summary": columns quantity, who, value, ... (see SPEC).
    """
    linear = linear_systems(system, (1.0, 1.0), band)
    peaks = {name: one.peak(frequencies(system, band)) / system.epsilon for name, one in linear.items()}
    clearance, design = (_peaks(system, table) for table in (clearance, design))
    alone = clearance.assign(ratio=clearance["one_ball"]).dropna(subset="ratio")
    again = {"band": band, "states": spread_starts(FRESH, seed + 1), "cycles": cycles, "settle": settle}
    own = _lowest_again(system, clearance, **again)
    restitution = [_lowest_again(system, mine, **again) for _, mine in design.dropna(subset="ratio").groupby("kappa")]
    best = min(restitution, key=lambda place: place["value"])
    optima = {BALLS: (own, starts), BEST_KAPPA: (best, starts)}
    if len(alone):  # from rest only: there are no starts to draw again
        (one_ball,) = _lowest(alone, 1)
        optima[ONE_BALL] = {**one_ball, "value": one_ball["swept"], "sigma_e_hat": one_ball["peak_at"]}, 1

    swept = (("clearance", BALLS, clearance), ("clearance", ONE_BALL, alone), ("design", BALLS, design))
    columns = "clearance", "kappa", "ratio"
    curves = [curve(panel, who, **{name: table[name] for name in columns}) for panel, who, table in swept]
    levels = _levels(peaks, "clearance", clearance) + _levels(peaks, "kappa", design)
    rows = [{"quantity": PEAK, "who": name, "value": peak} for name, peak in peaks.items()]
    rows += [
        {"quantity": PEAK, "who": who, **_told(place), "regime": _regime(system, place, observation, several, seed)}
        for who, (place, several) in optima.items()
    ]
    rows += _of_restitution(restitution)
    rows += _strokes(system, linear, band)
    rows += [{"quantity": STROKE, "who": who, "value": optima[who][0]["clearance"]} for who in (BALLS, BEST_KAPPA)]
    rows += _held_against(system, per_force(system, response), band)
    summary = pd.DataFrame(rows)
    for column, name in (("of_without", "without balls"), ("of_absorbers", "best absorbers")):
        summary.insert(5, column, (summary["value"] / peaks[name]).where(summary["quantity"] == PEAK))
    return {"csv": join([*levels, *curves, _lowest_peaks(restitution)]), "summary": summary}


def _peaks(system, table):
    """The table with peaks over f, f = epsilon f10_hat, and 1 / f."""
    force = system.epsilon * table["f10_hat"]
    kappa = table.get("kappa", system.kappa)
    return table.assign(
        clearance=1 / force, kappa=kappa, ratio=table["peak"] / force, one_ball=table["peak_one_ball"] / force
    )


def _lowest(table, number):
    """The places of a sweep over the clearance with the lowest peaks, and the margin of the clearance of each."""
    beside, places = table.sort_values("clearance").reset_index(drop=True), []
    for here in beside["ratio"].nsmallest(number).index:
        place = beside.loc[here].to_dict()
        far = ~(beside["ratio"] <= NEARLY * place["ratio"]).to_numpy()
        first, last = np.flatnonzero(np.r_[True, far[:here]])[-1], here + int(np.argmax(np.r_[far[here:], True])) - 1
        margin = {"narrowest": beside["clearance"][first], "widest": beside["clearance"][last]}
        places.append({**place, "swept": place["ratio"], **margin})
    return places


def _lowest_again(system, table, **again):
    """The lowest of the FEW lowest peaks of a sweep, measured again."""
    return min((_again(system, place, **again) for place in _lowest(table, FEW)), key=lambda place: place["value"])


def _again(system, place, band, states, cycles, settle):
    """A place with its peak measured again: value, spread, largest, per force, and sigma_e_hat where it is met."""
    there = system.with_(**{name: place[name] for name in ("kappa", *FORCES)})
    detunings = np.sort(np.ravel(axis(**band).values))
    detunings = np.sort(np.r_[detunings, 0.5 * (detunings[1:] + detunings[:-1])])
    found = peak([there.with_(sigma_e_hat=float(value)) for value in detunings], states, cycles, settle)
    measured = {"value": found.value, "spread": found.error, "largest": found.largest}
    measured = {name: value * place["clearance"] for name, value in measured.items()}
    return {**place, **measured, "sigma_e_hat": float(detunings[found.at])}


def _told(place):
    return {name: place[name] for name in TOLD if name in place}


def _regime(system, place, observation, number, seed):
    """The regime that most starts end in at a place, at the frequency of its peak."""
    there = system.with_(**{name: place[name] for name in ("kappa", *FORCES, "sigma_e_hat")})
    names = Counter(regime.name for regime in settled(there, spread_starts(number, seed), Observation(**observation)))
    return names.most_common(1)[0][0]


def _lowest_peaks(places):
    """Rows of the lowest peak at each kappa, with its standard error."""
    table = pd.DataFrame(places)
    low, high = (table["value"] + sign * table["spread"] for sign in (-1, 1))
    return curve("restitution", LOWEST, **table[["clearance", "kappa"]], ratio=table["value"], low=low, high=high)


def _levels(peaks, over, table):
    """Rows of the linear systems over all that was tried of a column."""
    panel, ends = PANELS[over], table[over].agg(["min", "max"]).to_numpy()
    return [curve(panel, name, **{over: ends}, ratio=peak) for name, peak in peaks.items()]


def _of_restitution(places):
    rows = [{"quantity": LOWEST, "who": BALLS, **_told(place)} for place in places]
    told = zip((PLATEAU, FROM, TO), plateau(places), strict=True)
    return [*rows, *({"quantity": quantity, "who": BALLS, "value": value} for quantity, value in told)]


def plateau(places):
    """The largest kappa up to which all lowest peaks are at most LEVEL times the lowest, and the least and the greatest
    of these; nan if the first is not.
    """
    level = LEVEL * min(place["value"] for place in places)
    on = list(takewhile(lambda place: place["value"] <= level, places))
    peaks = [place["value"] for place in on]
    return (on[-1]["kappa"], min(peaks), max(peaks)) if on else (float("nan"),) * 3


def _strokes(system, linear, band):
    """Yield the strokes of the absorbers in their boxes."""
    for name in ("absorbers of the textbook", "best absorbers"):
        stroke = linear[name].stroke(frequencies(system, band)) / system.epsilon
        yield {"quantity": STROKE, "who": name, "value": stroke}


def _held_against(system, response, band):
    """At each pair of forces, of each reference: at how many frequencies boxes move less with balls, times how much."""
    for pair, rows in response.groupby(FORCES, sort=False):
        for name, one in linear_systems(system, pair, band).items():
            times = rows["ratio"] / ratios(system, one, rows["sigma_e_hat"])
            measures = {"frequencies won": (times < 1).mean(), "least": times.min(), "greatest": times.max()}
            place = dict(zip(FORCES, pair, strict=True))
            yield from ({"quantity": q, "who": name, "value": v, **place} for q, v in measures.items())


@styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`: peaks over the clearance, lowest ones over kappa, and the map of both."""
    table, summary = tables["csv"], tables["summary"].query(f"quantity == '{PEAK}'").set_index("who")
    peaks = summary.loc[list(LINES), "value"]
    figure = new_figure(DOUBLE_COLUMN, 78.0)
    left, middle, right = figure.subplots(1, 3, width_ratios=[1.0, 0.85, 1.15])
    _draw_clearance(left, table[table["panel"] == "clearance"], summary.loc[BALLS])
    logarithmic(left, "y", LEAST, MOST * peaks.max())
    _draw_restitution(middle, table[table["panel"] == "restitution"], summary.loc[BEST_KAPPA])
    middle.set(xlim=(0.0, 1.0), ylim=(0.0, 0.5 * peaks["without balls"]))
    _draw_design(right, select(table, "design", BALLS), summary.loc[BEST_KAPPA], peaks["without balls"])
    for axes, letter in zip((left, middle, right), "abc", strict=True):
        letter_panel(axes, letter)
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=4, fontsize=8)
    return figure


def _draw_clearance(axes, rows, best):
    draw_lines(axes, rows, "clearance", "ratio")
    for series, look in SWEPT.items():
        mine = select(rows, "clearance", series)
        axes.plot(mine["clearance"], mine["ratio"], label=series, **look)
    _mark(axes, best, best["value"])
    logarithmic(axes, "x")
    axes.set(xlabel="clearance $1/f$", ylabel="peak $|X_i|\\,/\\,f$ of the band")


def _draw_restitution(axes, rows, best):
    draw_lines(axes, rows, "kappa", "ratio")
    mine = select(rows, "restitution", LOWEST)
    axes.vlines(mine["kappa"], mine["low"], mine["high"], color=BLACK, linewidth=0.9, label="standard error")
    axes.plot(mine["kappa"], mine["ratio"], label="lowest peaks", **DOTS)
    axes.plot(best["kappa"], best["value"], label=LOWEST, **BEST)
    axes.set(xlabel=SYMBOLS["kappa"], ylabel="lowest peak over the clearance")


def _draw_design(axes, cells, best, darkest):
    square = cells.pivot(index="kappa", columns="clearance", values="ratio")
    hatch_gaps(axes)
    sides = edges(square.columns, {"scale": LOGARITHMIC}), edges(square.index, {})
    mesh = axes.pcolormesh(*sides, square, cmap="Greys", vmin=0.0, vmax=darkest, rasterized=True)
    axes.figure.colorbar(mesh, ax=axes, label="peak $|X_i|\\,/\\,f$ (lighter is better)")
    _mark(axes, best, best["kappa"])
    logarithmic(axes, "x")
    axes.set(xlabel="clearance $1/f$", ylabel=SYMBOLS["kappa"])


def _mark(axes, best, height):
    """The optimum, and its margin."""
    axes.plot([best["narrowest"], best["widest"]], [height, height], **_MARGIN)
    axes.plot(best["clearance"], height, label=LOWEST, **BEST)
