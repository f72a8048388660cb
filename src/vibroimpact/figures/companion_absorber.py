"""Companion: which clearance and restitution serve best, against no balls, fixed balls and tuned absorbers.

All is per force: X / f over 1 / f, displacement over static deflection, clearance over static deflection.
"""

from collections import Counter

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.companion_response import FORCES, frequencies, linear_systems, per_force, ratios
from vibroimpact.figures.kit.absorber_looks import BEST, DOTS, LEAST, LINES, MOST, draw_lines, logarithmic
from vibroimpact.figures.kit.style import BLACK, DOUBLE_COLUMN, hatch_gaps, letter_panel, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join, select
from vibroimpact.figures.sweep import SYMBOLS, edges
from vibroimpact.regimes.classification import starts
from vibroimpact.regimes.settling import Observation, settle
from vibroimpact.sweeps.grid import LOGARITHMIC

SPEC = {
    "title": "Which balls serve best",
    "caption": r"The highest :math:`|X_i|/f`, displacement per static deflection with :math:`f = \varepsilon\hat "
        "f_{i0}`, in a band of frequencies. a: over the clearance; triangles: from rest only one ball ever meets a "
        "wall; lines: linear systems in closed form, the absorbers of the mass of the balls. b: the same over the "
        "restitution, too. Stars: the lowest peak, with a bar where it is at most 1.25 times as high.",
    "alt": "Two panels. a: the peak over the clearance, a valley between two horizontal pairs of lines, triangles "
        "around its lowest dots. b: a map in grey with the lowest peak marked by a star.",
    "method": "the points of three sweeps; linear systems in closed form, absorbers tuned by optimisation",
    "case": "sweeps.clearance.case",
    "settings": {"band": "sweeps.clearance.band", "number": "sweeps.clearance.starts", "seed": "sweeps.clearance.seed",
        "observation": "regimes.observation"},
    "inputs": {"response": "results/sweeps/frequency_response.csv", "clearance": "results/sweeps/clearance.csv",
        "design": "results/sweeps/design.csv"},
    "columns": {
        "panel": {"values": ["clearance", "design"]},
        "series": {"meaning": "balls, as simulated, one ball where from rest the other never meets a wall, or the "
            "linear system", "values": ["balls", "one ball", "without balls", "balls fixed",
            "absorbers of the textbook", "best absorbers"]},
        "clearance": {"meaning": "$1/f = k_1L/F$, clearance over static deflection", "unit": "dimensionless",
            "compared": "algebra"},
        "ratio": {"meaning": r"peak of $\lvert X_i\rvert/f$ in the band, of the box that moves more, of balls also of "
            "all starts", "unit": "dimensionless", "compared": {"best absorbers": "trajectory", "balls": "extremes",
            "one ball": "extremes", "others": "algebra"}},
        "kappa": {"compared": "algebra"},
    },
    "tables": {
        "summary": {
            "file": "results/absorber.csv",
            "about": "What the balls are good for, in numbers, at the system of the sweep `clearance` and along its "
                "band.",
            "columns": {
                "quantity": {"meaning": r"peak: the largest $\lvert X_i\rvert/f$ in the band, of balls at the "
                    "clearance (and kappa) where it is lowest. Of balls against who, at one force: frequencies won, "
                    "the share of frequencies at which the boxes move less with balls; least and greatest of the "
                    r"largest $\lvert X_i\rvert$ over that of who", "unit": "text", "values": ["peak",
                    "frequencies won", "least", "greatest"]},
                "who": {"meaning": "balls at the kappa of the config, balls at the best kappa of the sweep `design`, "
                    "one ball at the kappa of the config while the other meets no wall, or what they are held against",
                    "unit": "text", "values": ["balls", "balls, best kappa", "one ball", "without balls", "balls fixed",
                    "absorbers of the textbook", "best absorbers"]},
                "value": {"meaning": "what the quantity says", "unit": "dimensionless", "compared": "extremes"},
                "of_absorbers, of_without": {"meaning": "of a peak: the value over that of the best absorbers, and "
                    "over that without balls", "unit": "dimensionless", "compared": "extremes"},
                "kappa, f10_hat, f20_hat": {"compared": "extremes"},
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
_MARGIN = {"color": BLACK, "linewidth": 2.6, "solid_capstyle": "butt", "label": "its margin"}
NEARLY = 1.25
"""The margin of a clearance: where the peak is at most so many times the lowest."""


def compute(system, response, clearance, design, band: dict, observation: dict, number: int, seed: int) -> dict:
    """What sweeps of the balls found, per force, beside linear systems in closed form.

    Args:
        system: whose other parameters the sweeps keep.
        response: table of a sweep over sigma_e_hat, then both forces, of regimes, amplitudes and envelopes.
        clearance, design: of peaks along `band`, over both forces; over kappa, then both forces.
        band: arguments of `sweeps.grid.axis`, along sigma_e_hat.
        observation, number, seed: how long, and from how many starts, the regime at an optimum is looked for.

    Returns "csv": columns panel ("clearance" or "design"), series, clearance, kappa, ratio (X / f).
    "summary": columns quantity, who, value, ... (docs/data.md).
    """
    linear = linear_systems(system, (1.0, 1.0), band)
    peaks = {name: one.peak(frequencies(system, band)) / system.epsilon for name, one in linear.items()}
    clearance, design = (_peaks(system, table) for table in (clearance, design))
    alone = clearance.assign(ratio=clearance["one_ball"]).dropna(subset="ratio")
    ends = clearance["clearance"].agg(["min", "max"]).to_numpy()
    curves = [curve("clearance", name, clearance=ends, ratio=peak) for name, peak in peaks.items()]
    for panel, series, table in (
        ("clearance", BALLS, clearance),
        ("clearance", ONE_BALL, alone),
        ("design", BALLS, design),
    ):
        curves.append(curve(panel, series, **{name: table[name] for name in ("clearance", "kappa", "ratio")}))
    optima = {BALLS: (clearance, number), BEST_KAPPA: (design, number), ONE_BALL: (alone, 1)}
    rows = [{"quantity": "peak", "who": name, "value": peak} for name, peak in peaks.items()]
    rows += [
        _optimum(system, who, table, observation, starts(several, seed))
        for who, (table, several) in optima.items()
        if len(table)
    ]
    rows += _held_against(system, per_force(system, response), band)
    summary = pd.DataFrame(rows)
    for column, name in (("of_without", "without balls"), ("of_absorbers", "best absorbers")):
        summary.insert(3, column, (summary["value"] / peaks[name]).where(summary["quantity"] == "peak"))
    return {"csv": join(curves), "summary": summary}


def _peaks(system, table):
    """The table with peaks over f, f = epsilon f10_hat, and 1 / f."""
    force = system.epsilon * table["f10_hat"]
    kappa = table.get("kappa", system.kappa)
    return table.assign(
        clearance=1 / force, kappa=kappa, ratio=table["peak"] / force, one_ball=table["peak_one_ball"] / force
    )


def _optimum(system, who, table, observation, states):
    """The clearance (and kappa) of the lowest peak, how wide clearances may be about it, and the regime at its peak."""
    best = table.loc[table["ratio"].idxmin()]
    beside = table[table["kappa"] == best["kappa"]].sort_values("clearance")
    far = ~(beside["ratio"] <= NEARLY * best["ratio"]).to_numpy()
    here = int(np.flatnonzero(beside["clearance"] == best["clearance"])[0])
    first, last = np.flatnonzero(np.r_[True, far[:here]])[-1], here + int(np.argmax(np.r_[far[here:], True])) - 1
    moved = {"kappa": "kappa", "f10_hat": "f10_hat", "f20_hat": "f10_hat", "sigma_e_hat": "peak_at"}
    there = system.with_(**{name: float(best[column]) for name, column in moved.items()})
    names = Counter(regime.name for regime in settle(there, states, Observation(**observation)))
    return {
        "quantity": "peak",
        "who": who,
        "value": best["ratio"],
        **{name: getattr(there, name) for name in ("kappa", "f10_hat", "f20_hat", "sigma_e_hat")},
        "clearance": best["clearance"],
        "narrowest": beside["clearance"].iloc[first],
        "widest": beside["clearance"].iloc[last],
        "regime": names.most_common(1)[0][0],
    }


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
    """Draw the tables of `compute`: the performance curve, and the map of kappa and clearance."""
    table, summary = tables["csv"], tables["summary"].query("quantity == 'peak'").set_index("who")
    peaks = summary.loc[list(LINES), "value"]
    figure = new_figure(DOUBLE_COLUMN, 82.0)
    left, right = figure.subplots(1, 2)
    _draw_clearance(left, table[table["panel"] == "clearance"], summary.loc[BALLS])
    logarithmic(left, "y", LEAST, MOST * peaks.max())
    _draw_design(right, select(table, "design", BALLS), summary.loc[BEST_KAPPA], peaks["without balls"])
    for axes, letter in ((left, "a"), (right, "b")):
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


def _draw_design(axes, cells, best, darkest):
    square = cells.pivot(index="kappa", columns="clearance", values="ratio")
    hatch_gaps(axes)
    sides = edges(square.columns, {"scale": LOGARITHMIC}), edges(square.index, {})
    mesh = axes.pcolormesh(*sides, square, cmap="Greys", vmin=0.0, vmax=darkest, rasterized=True)
    axes.figure.colorbar(mesh, ax=axes, label="peak $|X_i|\\,/\\,f$ of the band")
    _mark(axes, best, best["kappa"])
    logarithmic(axes, "x")
    axes.set(xlabel="clearance $1/f$", ylabel=SYMBOLS["kappa"])


def _mark(axes, best, height):
    """The optimum, and its margin."""
    axes.plot([best["narrowest"], best["widest"]], [height, height], **_MARGIN)
    axes.plot(best["clearance"], height, label="lowest peak", **BEST)
