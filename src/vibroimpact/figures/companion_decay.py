"""Companion: how long an impulse is felt with balls, and with what they are held against."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.absorbers.decay import decay_time, quickest_decay
from vibroimpact.figures.companion_response import linear_systems
from vibroimpact.figures.kit.absorber_looks import BEST, DOTS, draw_lines, logarithmic
from vibroimpact.figures.kit.style import DOUBLE_COLUMN, letter_panel, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join, select

SPEC = {
    "title": "How long an impulse is felt",
    "caption": r"Cycles of the forcing, :math:`2\pi/\Omega` each, until a tenth of the energy of an impulse on a box "
        "is left, over the impulse; no force acts. Lines: linear systems in closed form, which do not ask how large "
        "the impulse is; those of the two absorbers nearly coincide. Star: where balls are quickest, "
        "looked for between the dots.",
    "alt": "Two panels, for an impulse on box 1 and on box 2. Dots of the balls lie on the line without balls up to an "
        "impulse of about 1, drop to less than half of it, and rise slowly from there; the tuned absorbers stay below "
        "them throughout.",
    "method": "free flights in closed form between impacts; linear systems in closed form",
    "columns": {
        "panel": {"values": ["module 1", "module 2"]},
        "series": {"meaning": "balls, where balls are quickest, or the linear system", "values": ["balls", "shortest",
            "without balls", "balls fixed", "absorbers of the textbook", "best absorbers"]},
        "impulse": {"meaning": r"velocity given to the box at rest, $X_i'(0)$, in units of $L\omega_{10}$",
            "unit": "dimensionless", "compared": "algebra"},
        "cycles": {"meaning": "time until a tenth of the energy of the impulse is left", "unit": "forcing periods",
            "compared": {"best absorbers": "trajectory", "balls": "trajectory", "shortest": "trajectory",
            "others": "algebra"}},
        "fraction": {"meaning": "the part of the energy that is left then", "unit": "share", "compared": "algebra"},
    },
}  # fmt: skip

SHORTEST = "shortest"
MODULES = (1, 2)


def compute(system, impulses: list[float], values: int, fraction: float, band: dict) -> pd.DataFrame:
    """Cycles of the forcing, 2 pi / Omega each, until a fraction of the energy of an impulse is left; no force acts.

    Args:
        impulses, values: first and last velocity given to a box, in units of L omega_10, and how many there are,
            evenly on a logarithmic scale.
        band: arguments of `sweeps.grid.axis` along sigma_e_hat, over which the best absorbers are tuned.

    Returns columns panel ("module 1" or 2, which is hit), series (balls, a linear system, or where balls are quickest,
    which may lie between the impulses of the others),
    impulse, cycles (inf: never), fraction (as given).
    """
    velocities = np.geomspace(*impulses, values)
    linear = linear_systems(system, (1.0, 1.0), band)
    curves = []
    for module in MODULES:
        panel = f"module {module}"
        for name, one in linear.items():
            curves.append(curve(panel, name, impulse=impulses, cycles=one.decay_time(module, fraction) / system.period))
        times = np.array([decay_time(system, velocity, module, fraction) for velocity in velocities])
        best, shortest = quickest_decay(system, velocities, times, module, fraction)
        curves.append(curve(panel, "balls", impulse=velocities, cycles=times / system.period))
        curves.append(curve(panel, SHORTEST, impulse=best, cycles=shortest / system.period))
    return join(curves).assign(fraction=fraction)


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`, a panel for each module that is hit."""
    figure = new_figure(DOUBLE_COLUMN, 80.0)
    figure.get_layout_engine().set(wspace=0.07)
    places = figure.subplots(1, len(MODULES), sharey=True)
    for axes, letter, module in zip(places, "ab", MODULES, strict=True):
        rows = table[table["panel"] == f"module {module}"]
        balls, best = (select(rows, f"module {module}", series) for series in ("balls", SHORTEST))
        draw_lines(axes, rows, "impulse", "cycles")
        axes.plot(balls["impulse"], balls["cycles"], label="balls", **DOTS | {"linestyle": "-", "linewidth": 0.6})
        axes.plot(best["impulse"], best["cycles"], label=SHORTEST, **BEST)
        logarithmic(axes, "x", *balls["impulse"].iloc[[0, -1]])
        axes.set(xlabel=f"impulse on box {module}, $X_{module}'(0)$")
        axes.set_title(f"box {module} is hit", loc="right", pad=3)
        letter_panel(axes, letter)
    places[0].set_ylim(bottom=0.0)
    places[0].set_ylabel(f"cycles until {100 * table['fraction'].iloc[0]:g} % of the energy is left")
    figure.legend(*places[0].get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=8)
    return figure
