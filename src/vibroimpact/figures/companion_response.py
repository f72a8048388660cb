"""Companion: how far the boxes move with balls, over the frequency of the forcing and over its amplitude.

All is per force: |X_i| / f of the box that moves more, f the larger force.
"""

from functools import lru_cache

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.absorbers.tuning import compared
from vibroimpact.figures.kit.absorber_looks import DOTS, LEAST, LINES, MOST, logarithmic
from vibroimpact.figures.kit.style import (
    DOUBLE_COLUMN,
    LIGHT_GREY,
    letter_panel,
    new_figure,
    side_by_side,
    styled,
)
from vibroimpact.figures.kit.tables import curve, join
from vibroimpact.figures.sweep import SYMBOLS
from vibroimpact.regimes.classification import IDLE, NO_IMPACTS, PERIODIC, REGIMES
from vibroimpact.regimes.one_to_one import by_exact_orbits, by_theory
from vibroimpact.sweeps.grid import axis

SPEC = {
    "title": "How far the boxes move with balls",
    "caption": "Displacement per static deflection, :math:`|X_i|/f`, of the box that moves more, :math:`f` the larger "
        r"of the forces :math:`\varepsilon\hat f_{i0}`. a to c: over the frequency, forces on both boxes and on one; "
        "d: over the force. Dots: balls, the largest of three starts, filled where most of them repeat; grey: between "
        "5 % and 95 % of the cycles; lines: linear systems in closed form. The table also has balls fixed, absorbers "
        "of the textbook, and symmetric 1:1 responses.",
    "alt": "Four panels. a to c: response over the detuning; a high resonance peak without balls, dots and a grey band "
        "of the balls below it near resonance and above it beside it, a flat line of the best absorbers below nearly "
        "all dots. d: over the force the dots fall from the line without balls to a lowest place near force 1 and rise "
        "slowly.",
    "method": "the points of two sweeps; fixed points, exact symmetric orbits and linear systems in closed form",
    "sweeps": {"frequency_response": {"along": [["sigma_e_hat"], ["f10_hat", "f20_hat"]],
        "observe": ["amplitudes", "envelopes", "energy", "regimes"]}},
    "columns": {
        "panel": {"values": ["frequency", "force"]},
        "series": {"meaning": "balls, as simulated; symmetric 1:1 responses by the theory and exact; or the linear "
            "system", "values": ["balls", "theory", "symmetric orbits", "without balls", "balls fixed",
            "absorbers of the textbook", "best absorbers"]},
        "label": {"meaning": "of balls: the `regime` that most starts end in", "unit": "text", "compared": {
            "balls": "few outcomes"}},
        "f10_hat, f20_hat": {"compared": "algebra"},
        "sigma_e_hat": {"meaning": "detuning of the forcing, (10.6)", "unit": "dimensionless", "compared": "algebra"},
        "ratio": {"meaning": r"largest $\lvert X_i\rvert/f$ of the box that moves more, of balls also of all starts",
            "unit": "dimensionless", "compared": {"best absorbers": "trajectory", "balls": "extremes",
            "theory": "roots", "symmetric orbits": "roots", "others": "algebra"}},
        "low, high": {"meaning": "of balls: amplitude cycle by cycle, per $f$, that is exceeded in 95 % and in 5 % of "
            "the cycles", "unit": "dimensionless", "compared": "extremes"},
        "impact_share": {"compared": {"balls": "extremes", "others": "roots"}},
        "stable": {"meaning": "all multipliers of the orbit are inside the unit circle; of the theory, Masri's "
            "analysis and the slow flow say so", "unit": "true or false"},
    },
    "tables": {
        "shares": {
            "file": "results/impact_shares.csv",
            "about": "What impacts take of the work of the forces, over the frequencies of `companion_response`.",
            "columns": {
                "source": {"meaning": "balls, as simulated, or the symmetric 1:1 responses by the theory or exact, "
                    "stable or not", "unit": "text", "values": ["balls", "theory", "symmetric orbits"]},
                "f10_hat, f20_hat": {},
                "points": {"meaning": "how many frequencies, or responses at all of them, there are", "unit": "number"},
                "least, middle, greatest": {"meaning": "the least share, the median, and the greatest", "unit": "share"
                    },
            },
        },
    },
}  # fmt: skip

FORCES = ["f10_hat", "f20_hat"]
PLACE = [*FORCES, "sigma_e_hat"]
OF_BALLS = ("label", *PLACE, "ratio", "low", "high", "impact_share")
BALLS, THEORY, ORBITS = "balls", "theory", "symmetric orbits"
ONE_TO_ONE = {THEORY: by_theory, ORBITS: by_exact_orbits}
DRAWN = {"without balls": LINES["without balls"], "best absorbers": LINES["best absorbers"]}
REPEATING, MODULATED = "balls, largest, repeating", "balls, largest, modulated"
LOOKS = {REPEATING: DOTS, MODULATED: {**DOTS, "markerfacecolor": "white"}}
BAND = "balls, 90 % of the cycles"
LINE_POINTS = 451


def compute(system, frequency: pd.DataFrame, force: pd.DataFrame, band: dict) -> dict:
    """Return results of the sweeps with balls, per force, beside theory, exact orbits, and linear systems.

    Args:
        system: whose other parameters the sweeps keep.
        frequency: table of a sweep over sigma_e_hat, then both forces; force: over both forces, which are equal. Of
            regimes, amplitudes, envelopes and energy.
        band: arguments of `sweeps.grid.axis`, along sigma_e_hat, over which the best absorbers are tuned.

    Returns "csv": columns panel ("frequency" or "force"), series, label (of balls the regime of most starts), f10_hat,
    f20_hat, sigma_e_hat, ratio (X / f), low and high (its envelope), impact_share, stable (of 1:1 responses).
    "shares": what impacts take of the work, columns panel, source, f10_hat, f20_hat, points, least, middle, greatest.
    """
    frequency, force = per_force(system, frequency), per_force(system, force.assign(sigma_e_hat=system.sigma_e_hat))
    curves = []
    for pair, rows in frequency.groupby(FORCES, sort=False):
        linear = linear_systems(system, pair, band)
        fine = np.linspace(rows["sigma_e_hat"].min(), rows["sigma_e_hat"].max(), LINE_POINTS)
        at = dict(zip(FORCES, pair, strict=True)) | {"sigma_e_hat": fine}
        curves += [curve("frequency", name, **at, ratio=ratios(system, one, fine)) for name, one in linear.items()]
    for name, one in linear_systems(system, (1.0, 1.0), band).items():
        level = float(ratios(system, one, system.sigma_e_hat))
        ends = force[FORCES].iloc[[0, -1]]
        curves.append(curve("force", name, **ends, sigma_e_hat=system.sigma_e_hat, ratio=level))
    for panel, table in (("frequency", frequency), ("force", force)):
        curves.append(curve(panel, BALLS, **{name: table[name] for name in OF_BALLS}))
        curves += [_one_to_one(system, panel, series, table) for series in ONE_TO_ONE]
    table = join(curves)
    return {"csv": table, "shares": _shares(table)}


def per_force(system, table: pd.DataFrame) -> pd.DataFrame:
    """The table of a sweep of amplitudes, envelopes and regimes with ratio, low and high, over f, and label."""
    force = system.epsilon * table[FORCES].max(axis=1)
    boxes = table[["high_X1", "high_X2"]].to_numpy().argmax(axis=1)
    low, high = (table[[f"{name}_X1", f"{name}_X2"]].to_numpy()[range(len(table)), boxes] for name in ("low", "high"))
    largest = table[["largest_X1", "largest_X2"]].max(axis=1)
    return table.assign(
        ratio=largest / force, low=low / force, high=high / force, label=table[list(REGIMES)].idxmax(axis=1)
    )


def linear_systems(system, pair, band: dict) -> dict:
    """Return the linear systems for comparison, by name, at forces in this proportion, the larger of them 1."""
    f10, f20 = (float(value / max(pair)) for value in pair)
    return _compared(system.with_(f10_hat=f10, f20_hat=f20), frequencies(system, band))


_compared = lru_cache(compared)  # tuned once for all forces in a proportion


def frequencies(system, band: dict) -> tuple[float, float]:
    """The ends of a band of detunings, as frequencies."""
    values = axis(**band).values
    return tuple(1.0 + system.epsilon * float(np.ravel(end)[0]) for end in (values[0], values[-1]))


def ratios(system, linear, detunings):
    """The larger |X_i| / f of a linear system whose larger force is 1."""
    return linear.amplitudes(1.0 + system.epsilon * np.asarray(detunings)).max(axis=-1) / system.epsilon


def _one_to_one(system, panel, series, table):
    """All 1:1 responses where the sweep has been."""
    rows = []
    for place in table[PLACE].to_dict("records"):
        force = system.epsilon * max(place[name] for name in FORCES)
        for found in ONE_TO_ONE[series](system.with_(**place)):
            measures = {"ratio": found.largest.max() / force, "impact_share": found.impact_share}
            rows.append({**place, **measures, "stable": found.stable})
    numbers = dict.fromkeys([*PLACE, "ratio", "impact_share"], float)
    columns = pd.DataFrame(rows, columns=[*numbers, "stable"]).astype(numbers)  # numbers even where there is no row
    return curve(panel, series, **{name: columns[name] for name in columns})


def _shares(table):
    known = table[table["impact_share"].notna()]
    keys = ["panel", "series", *FORCES]
    frequency = known[known["panel"] == "frequency"].groupby(keys, sort=False)["impact_share"]
    found = frequency.agg(points="size", least="min", middle="median", greatest="max").reset_index()
    return found.drop(columns="panel").rename(columns={"series": "source"})


@styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`: a panel for each pair of forces over the frequency, and one over the force."""
    table = tables["csv"]
    panels = list(table[table["panel"] == "frequency"].groupby(FORCES, sort=False))
    columns, rows = side_by_side(len(panels) + 1, most=2)
    figure = new_figure(DOUBLE_COLUMN, 76.0 * rows + 16.0)
    places = [*figure.subplots(rows, columns, squeeze=False).flat]
    for (pair, mine), axes in zip(panels, places, strict=False):
        _draw_panel(axes, mine, "sigma_e_hat")
        f10, f20 = (f"{value:g}" for value in pair)
        axes.set_title(rf"$\hat f_{{10}} = {f10}$, $\hat f_{{20}} = {f20}$", loc="right", pad=3, fontsize=9.5)
        axes.set_xlabel(SYMBOLS["sigma_e_hat"])
    last = places[len(panels)]
    force = table[table["panel"] == "force"]
    _draw_panel(last, force, "f10_hat")
    logarithmic(last, "x")
    last.set_xlabel(r"$\hat f_{10} = \hat f_{20}$")
    last.set_title(rf"$\hat\sigma_e = {force['sigma_e_hat'].iloc[0]:g}$", loc="right", pad=3, fontsize=9.5)
    for axes in places[len(panels) + 1 :]:
        axes.set_axis_off()
    linear = table.loc[table["series"] == "without balls", "ratio"].max()
    for axes, letter in zip(places[: len(panels) + 1], "abcdefghijklmnop", strict=False):
        logarithmic(axes, "y", LEAST, MOST * linear)
        axes.set_ylabel("largest $|X_i|\\,/\\,f$")
        letter_panel(axes, letter)
    figure.legend(*places[0].get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=8.5)
    return figure


def _draw_panel(axes, rows, x):
    balls = rows[rows["series"] == BALLS]
    axes.fill_between(balls[x], balls["low"], balls["high"], color=LIGHT_GREY, linewidth=0, label=BAND)
    for name, look in DRAWN.items():
        line = rows[rows["series"] == name]
        axes.plot(line[x], line["ratio"], label=name, **look)
    repeating = balls["label"].isin([*PERIODIC, IDLE, NO_IMPACTS])
    for (name, look), shown in zip(LOOKS.items(), (repeating, ~repeating), strict=True):
        axes.plot(balls[x][shown], balls["ratio"][shown], label=name, **look)
