"""Companion: what the balls are good for, against no balls, fixed balls and tuned absorbers of the same mass.

All is per force: X / f over 1 / f, displacement over static deflection, clearance over static deflection.
"""

from collections import Counter

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.absorbers.tuning import compared
from vibroimpact.figures.companions.sweep import SYMBOLS, edges
from vibroimpact.figures.kit.absorber_looks import BEST, DOTS, LINES, draw_lines, logarithmic
from vibroimpact.figures.kit.style import (
    BLACK,
    DOUBLE_COLUMN,
    LIGHT_GREY,
    hatch_gaps,
    letter_panel,
    new_figure,
    side_by_side,
    styled,
)
from vibroimpact.figures.kit.tables import curve, join, select
from vibroimpact.regimes.classification import IDLE, NO_IMPACTS, PERIODIC, REGIMES, starts
from vibroimpact.regimes.settling import Observation, settle
from vibroimpact.sweeps.grid import LOGARITHMIC, axis

REPEATING, MODULATED = "balls, largest, repeating", "balls, largest, modulated"
LOOKS = {REPEATING: DOTS, MODULATED: {**DOTS, "markerfacecolor": "white"}}
BAND = "balls, 90 % of the cycles"
_MARGIN = {"color": BLACK, "linewidth": 2.6, "solid_capstyle": "butt", "label": "its margin"}
NEARLY = 1.25
"""The margin of a clearance: where the peak is at most so many times the lowest."""
LINE_POINTS = 451
LEAST, MOST = 0.2, 1.3
"""Ends of the axes of displacements, of the lowest and the highest peak of a linear system."""
OF_RESPONSE = ("label", "f10_hat", "sigma_e_hat", "clearance", "kappa", "ratio", "low", "high")


def compute(system, response, clearance, design, band: dict, observation: dict, number: int, seed: int) -> dict:
    """What sweeps of the balls found, per force, beside linear systems in closed form.

    Args:
        system: whose other parameters the sweeps keep.
        response: table of a sweep over sigma_e_hat, then both forces, of regimes, amplitudes and envelopes.
        clearance, design: of peaks along `band`, over both forces; over kappa, then both forces.
        band: arguments of `sweeps.grid.axis`, along sigma_e_hat.
        observation, number, seed: how long, and from how many starts, the regime at an optimum is looked for.

    Returns "csv": columns panel ("response", "clearance" or "design"), series, label (of a response with balls the
    regime of most starts), f10_hat, sigma_e_hat, clearance, kappa, ratio (X / f), low and high (its envelope).
    "summary": columns quantity, who, value, ... (docs/data.md).
    """
    detunings = np.array(axis(**band).values)
    frequencies = 1.0 + system.epsilon * detunings[[0, -1]]
    linear = compared(system.with_(f10_hat=1.0, f20_hat=1.0), frequencies)
    peaks = {name: one.peak(frequencies) / system.epsilon for name, one in linear.items()}
    response, clearance, design = (_per_force(system, table) for table in (response, clearance, design))
    ends = clearance["clearance"].agg(["min", "max"]).to_numpy()
    curves = [*_responses(system, linear, response)]
    curves += [curve("clearance", name, clearance=ends, ratio=peak) for name, peak in peaks.items()]
    for panel, table in (("clearance", clearance), ("design", design)):
        columns = {name: table[name] for name in ("clearance", "kappa", "ratio")}
        curves.append(curve(panel, "balls", **columns))
    optima = {"balls": clearance, "balls, best kappa": design}
    rows = [{"quantity": "peak", "who": name, "value": peak} for name, peak in peaks.items()]
    rows += [_optimum(system, who, table, observation, starts(number, seed)) for who, table in optima.items()]
    rows += _held_against(system, linear, response)
    summary = pd.DataFrame(rows)
    for column, name in (("of_without", "without balls"), ("of_absorbers", "best absorbers")):
        summary.insert(3, column, (summary["value"] / peaks[name]).where(summary["quantity"] == "peak"))
    return {"csv": join(curves), "summary": summary}


def _per_force(system, table):
    """The table with displacements over f, f = epsilon f10_hat, and 1 / f."""
    force = system.epsilon * table["f10_hat"]
    found = table.assign(clearance=1 / force, kappa=table.get("kappa", system.kappa))
    if "peak" in table:
        return found.assign(ratio=table["peak"] / force)
    boxes = table[["high_X1", "high_X2"]].to_numpy().argmax(axis=1)
    low, high = (table[[f"{name}_X1", f"{name}_X2"]].to_numpy()[range(len(table)), boxes] for name in ("low", "high"))
    largest = table[["largest_X1", "largest_X2"]].max(axis=1)
    return found.assign(
        ratio=largest / force, low=low / force, high=high / force, label=table[list(REGIMES)].idxmax(axis=1)
    )


def _responses(system, linear, response):
    """A curve per force of the box that moves more."""
    for force, rows in response.groupby("f10_hat"):
        detunings = rows["sigma_e_hat"]
        fine = np.linspace(detunings.min(), detunings.max(), LINE_POINTS)
        for name, one in linear.items():
            yield curve("response", name, f10_hat=force, sigma_e_hat=fine, ratio=_ratios(system, one, fine))
        yield curve("response", "balls", **{name: rows[name] for name in OF_RESPONSE})


def _ratios(system, linear, detunings):
    """The larger |X_i| / f of a linear system."""
    return linear.amplitudes(1.0 + system.epsilon * np.asarray(detunings)).max(axis=1) / system.epsilon


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
        **{name: getattr(there, name) for name in ("kappa", "f10_hat", "sigma_e_hat")},
        "clearance": best["clearance"],
        "narrowest": beside["clearance"].iloc[first],
        "widest": beside["clearance"].iloc[last],
        "regime": names.most_common(1)[0][0],
    }


def _held_against(system, linear, response):
    """At each force, of each reference: at how many frequencies boxes move less with balls, and times how much."""
    for force, rows in response.groupby("f10_hat"):
        for name, one in linear.items():
            times = rows["ratio"] / _ratios(system, one, rows["sigma_e_hat"])
            measures = {"frequencies won": (times < 1).mean(), "least": times.min(), "greatest": times.max()}
            yield from ({"quantity": q, "who": name, "value": v, "f10_hat": force} for q, v in measures.items())


@styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`: a panel per force, the performance curve, the map of kappa and clearance."""
    table, summary = tables["csv"], tables["summary"].set_index("who")
    forces = select(table, "response", "balls")["f10_hat"].unique()
    columns, rows = side_by_side(len(forces) + 2, most=2)
    figure = new_figure(DOUBLE_COLUMN, 68.0 * rows + 12.0)
    places = [*figure.subplots(rows, columns, squeeze=False).flat]
    peaks = summary.loc[list(LINES)].query("quantity == 'peak'")["value"]
    for force, axes in zip(forces, places, strict=False):
        _draw_response(axes, table[(table["panel"] == "response") & (table["f10_hat"] == force)])
        logarithmic(axes, "y", LEAST * peaks.min(), MOST * peaks.max())
        axes.set_title(rf"$\hat f_{{10}} = \hat f_{{20}} = {force:g}$", loc="right", pad=3)
    last = places[len(forces) :]
    _draw_clearance(last[0], table[table["panel"] == "clearance"], summary.loc["balls"])
    logarithmic(last[0], "y", LEAST * peaks.min(), MOST * peaks.max())
    _draw_design(last[1], select(table, "design", "balls"), summary.loc["balls, best kappa"], peaks["without balls"])
    for axes in last[2:]:
        axes.set_axis_off()
    for axes, letter in zip(places, "abcdefghijklmnop"[: len(forces) + 2], strict=False):
        letter_panel(axes, letter)
    handles, names = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside lower center", ncols=4, fontsize=8)
    return figure


def _draw_response(axes, rows):
    balls = select(rows, "response", "balls")
    axes.fill_between(balls["sigma_e_hat"], balls["low"], balls["high"], color=LIGHT_GREY, linewidth=0, label=BAND)
    draw_lines(axes, rows, "sigma_e_hat", "ratio")
    repeating = balls["label"].isin([*PERIODIC, IDLE, NO_IMPACTS])
    for (name, look), shown in zip(LOOKS.items(), (repeating, ~repeating), strict=True):
        axes.plot(balls["sigma_e_hat"][shown], balls["ratio"][shown], label=name, **look)
    axes.set(xlabel=SYMBOLS["sigma_e_hat"], ylabel="largest $|X_i|\\,/\\,f$")


def _draw_clearance(axes, rows, best):
    balls = select(rows, "clearance", "balls")
    draw_lines(axes, rows, "clearance", "ratio")
    axes.plot(balls["clearance"], balls["ratio"], label="balls", **{**DOTS, "linestyle": "-", "linewidth": 0.6})
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
