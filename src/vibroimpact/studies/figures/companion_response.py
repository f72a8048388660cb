"""Companion: response of the boxes with balls against the frequency and against the amplitude of the forcing.

A response is the largest |X_i| of both boxes, divided by f. Here f is the larger of the two forces epsilon f10_hat and
epsilon f20_hat.
"""

from functools import lru_cache
from string import ascii_lowercase

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.figures.plotting.style import (
    BLACK,
    DOUBLE_COLUMN,
    GREY,
    heading,
    new_figure,
    side_by_side,
    styled,
)
from vibroimpact.studies.absorbers.references import compared
from vibroimpact.studies.figures.sweep import SYMBOLS
from vibroimpact.studies.regimes.classification import IDLE, NO_IMPACTS, PERIODIC, REGIMES
from vibroimpact.studies.sweeps.grid import axis
from vibroimpact.tables import curve

SPEC = {
    "title": "Displacement of the boxes with balls",
    "caption": "Displacement over static deflection, :math:`|X_i|/f`, of the box that moves more, where :math:`f` is "
        r"the larger of the forces :math:`\varepsilon\hat f_{i0}`. a to c: against the detuning, with forces on both "
        "boxes and on one; d: against the force. Circles: largest value with balls from three starts, which may "
        "reach different motions, filled if most of these are periodic. Other lines: linear systems in closed form.",
    "alt": "Four panels. a to c: response against the detuning, with a high resonance peak without balls. With balls, "
        "circles lie below it near resonance and above it elsewhere. A flat line of the best absorbers lies below "
        "nearly all circles. d: with increasing force, the circles fall from the line without balls to a minimum "
        "near force 1 and rise slowly.",
    "method": "points of two sweeps; linear systems in closed form",
    "sweeps": {
        "frequency_response": {"along": [["sigma_e_hat"], ["f10_hat", "f20_hat"]],
            "observe": ["amplitudes", "regimes"]},
        "clearance": {"along": [["f10_hat", "f20_hat"]], "observe": ["amplitudes", "regimes"]}},
    "columns": {
        "panel": {"meaning": "sweep over the frequency, or over the force", "values": ["frequency", "force"]},
        "label": {"meaning": "`regime` that most starts reach", "unit": "text", "compared": "few outcomes"},
        "f10_hat, f20_hat": {"compared": "algebra"},
        "sigma_e_hat": {"meaning": "detuning of the forcing, (10.6)", "unit": "dimensionless", "compared": "algebra"},
        "ratio": {"meaning": r"largest $\lvert X_i\rvert/f$ over all starts, for the box that moves more",
            "unit": "dimensionless", "compared": "extremes"},
    },
    "tables": {
        "linear": {
            "file": "results/figures/companion_response.linear.csv",
            "about": "Linear systems to which `companion_response` compares the balls.",
            "columns": {
                "panel": {"meaning": "against the frequency, or against the force", "values": ["frequency", "force"]},
                "series": {"meaning": "linear system", "values": ["without balls", "best absorbers"]},
                "f10_hat, f20_hat": {"compared": "algebra"},
                "sigma_e_hat": {"meaning": "detuning of the forcing, (10.6)", "unit": "dimensionless",
                    "compared": "algebra"},
                "ratio": {"meaning": r"$\lvert X_i\rvert/f$ of the box that moves more", "unit": "dimensionless",
                    "compared": {"best absorbers": "trajectory", "others": "algebra"}},
            },
        },
    },
}  # fmt: skip

FORCES = ["f10_hat", "f20_hat"]
PLACE = [*FORCES, "sigma_e_hat"]
OF_BALLS = ["panel", "label", *PLACE, "ratio"]
LINES = {
    "without balls": {"color": GREY, "linestyle": "-", "linewidth": 1.6},
    "best absorbers": {"color": BLACK, "linestyle": (0, (4.5, 2.5)), "linewidth": 0.9},
}
"""Line styles of the linear systems, also in `machines` and `companion_absorber`."""
CIRCLES = {"color": BLACK, "marker": "o", "markersize": 3.2, "markeredgewidth": 0.7, "linewidth": 0.7}
LEAST, MOST = 1.8, 1.3
"""Lower end of the vertical axis, and ratio of its upper end to the highest response without balls."""
LINE_POINTS = 451


def compute(system, frequency: pd.DataFrame, force: pd.DataFrame, band: dict) -> dict:
    """Return the responses with balls in two sweeps, and the responses of linear systems.

    Parameters
    ----------
    frequency : DataFrame
        Table of a sweep over sigma_e_hat and over pairs of forces, with regimes and amplitudes.
    force : DataFrame
        Table of a sweep over the amplitude of two equal forces, with regimes and amplitudes.
    band : dict
        Arguments of `sweeps.grid.axis`: the values of sigma_e_hat for which the best absorbers are tuned.

    Returns
    -------
    dict
        The tables in SPEC.
    """
    sweeps = {"frequency": frequency, "force": force.assign(sigma_e_hat=system.sigma_e_hat)}
    balls = pd.concat([per_force(system, table).assign(panel=name)[OF_BALLS] for name, table in sweeps.items()])
    lines = [
        ("frequency", pair, np.linspace(detunings.min(), detunings.max(), LINE_POINTS))
        for pair, detunings in frequency.groupby(FORCES, sort=False)["sigma_e_hat"]
    ]
    pairs = force[FORCES].iloc[[0, -1]].itertuples(index=False, name=None)
    lines += [("force", pair, np.array([system.sigma_e_hat])) for pair in pairs]
    linear = [
        curve(panel, name, **dict(zip(PLACE, (*pair, detunings), strict=True)), ratio=ratios(system, one, detunings))
        for panel, pair, detunings in lines
        for name, one in linear_systems(system, pair, band).items()
        if name in LINES
    ]
    return {"csv": balls, "linear": pd.concat(linear).sort_values(["panel", "series"], kind="stable")}


def per_force(system, table: pd.DataFrame) -> pd.DataFrame:
    """Return the table of a sweep with two more columns.

    ratio: the response.
    label: the regime that most initial states reach.
    """
    force = system.epsilon * table[FORCES].max(axis=1)
    largest = table[["largest_X1", "largest_X2"]].max(axis=1)
    return table.assign(ratio=largest / force, label=table[list(REGIMES)].idxmax(axis=1))


def linear_systems(system, pair, band: dict) -> dict:
    """Return the linear systems for comparison, by name.

    Their forces f10_hat and f20_hat are those of `pair`, divided by the larger one.
    """
    f10, f20 = (float(value / max(pair)) for value in pair)
    return _compared(system.with_(f10_hat=f10, f20_hat=f20), frequencies(system, band))


_compared = lru_cache(compared)  # cached, since pairs of forces with the same ratio share one tuning


def frequencies(system, band: dict) -> tuple[float, float]:
    """Return the ends of a band of detunings as forcing frequencies Omega."""
    values = axis(**band).values
    return tuple(1.0 + system.epsilon * float(np.ravel(end)[0]) for end in (values[0], values[-1]))


def ratios(system, linear, detunings):
    """Return the response of a linear system at each detuning.

    The larger of f10_hat and f20_hat of the linear system must be 1.
    """
    return linear.amplitudes(1.0 + system.epsilon * np.asarray(detunings)).max(axis=-1) / system.epsilon


@styled
def draw(tables: dict) -> Figure:
    """Draw the responses: one panel against the detuning for each pair of forces, and one panel against the force."""
    balls, linear = (dict(iter(tables[key].groupby("panel"))) for key in ("csv", "linear"))
    pairs = list(balls["frequency"].groupby(FORCES, sort=False))
    columns, rows = side_by_side(len(pairs) + 1, most=2)
    figure = new_figure(DOUBLE_COLUMN, 62.0 * rows + 10.0)
    panels = [*figure.subplots(rows, columns, squeeze=False, sharey=True).flat]
    for axes, letter, (pair, mine) in zip(panels, ascii_lowercase, pairs, strict=False):
        lines = linear["frequency"]
        _draw_panel(axes, mine, lines[(lines[FORCES].to_numpy() == pair).all(axis=1)], "sigma_e_hat")
        heading(axes, letter, _forced(pair))
        axes.set_xlabel(f"detuning {SYMBOLS['sigma_e_hat']}")
    last, detuning = panels[len(pairs)], balls["force"]["sigma_e_hat"].iloc[0]
    _draw_panel(last, balls["force"], linear["force"], "f10_hat")
    heading(last, ascii_lowercase[len(pairs)], f"both boxes forced, detuning {detuning:g}")
    logarithmic(last, "x")
    last.set_xlabel(r"force $\hat f_{10} = \hat f_{20}$")
    for axes in panels[len(pairs) + 1 :]:
        axes.set_axis_off()
    without = tables["linear"].query("series == 'without balls'")["ratio"].max()
    logarithmic(last, "y", LEAST, MOST * without)
    for axes in panels[: len(pairs) + 1 : columns]:
        axes.set_ylabel("displacement, $|X_i|\\,/\\,f$")
    handles = last.get_legend_handles_labels()[0][len(LINES) :]
    figure.legend(handles=handles, loc="outside lower center", ncols=2, fontsize=9)
    name_curves(figure, {panels[0]: [(line.get_label(), [line]) for line in panels[0].lines[: len(LINES)]]})
    return figure


def _forced(pair):
    """Return a heading such as "box 1 forced, amplitude 2"."""
    forces = {f"box {box}": f"{force:g}" for box, force in enumerate(pair, 1) if force}
    who = "both boxes" if len(forces) == len(pair) else " ".join(forces)
    return f"{who} forced, amplitude {' and '.join(dict.fromkeys(forces.values()))}"


def _draw_panel(axes, balls, linear, x):
    for name, look in LINES.items():
        line = linear[linear["series"] == name]
        axes.plot(line[x], line["ratio"], label=name, **look)
    axes.plot(balls[x], balls["ratio"], label="balls, periodic", **CIRCLES)
    modulated = balls[~balls["label"].isin([*PERIODIC, IDLE, NO_IMPACTS])]
    hollow = CIRCLES | {"linestyle": "none", "markerfacecolor": "white"}
    axes.plot(modulated[x], modulated["ratio"], label="balls, not periodic", **hollow)


def logarithmic(axes, side: str, *ends: float) -> None:
    """Make an axis logarithmic, with labels at 1, 2 and 5 times powers of ten.

    side: "x" or "y".
    ends: lower and upper limit of the axis, optional.
    """
    axes.set(**{f"{side}scale": "log"})
    axis = getattr(axes, f"{side}axis")
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())
    if ends:
        axes.set(**{f"{side}lim": ends})
