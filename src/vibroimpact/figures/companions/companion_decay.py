"""Companion: how long an impulse is felt with balls, and with what they are held against."""

import numpy as np
from matplotlib.figure import Figure

from vibroimpact.absorbers.decay import decay_time, quickest_decay
from vibroimpact.figures.companions.companion_response import linear_systems
from vibroimpact.figures.kit.absorber_looks import BEST, DOTS, draw_lines, logarithmic
from vibroimpact.figures.kit.style import DOUBLE_COLUMN, letter_panel, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join, select

SHORTEST = "shortest"
MODULES = (1, 2)


def compute(system, impulses: list[float], values: int, fraction: float, band: dict) -> dict:
    """Cycles of the forcing, 2 pi / Omega each, until a fraction of the energy of an impulse is left; no force acts.

    Args:
        impulses, values: first and last velocity given to a box, in units of L omega_10, and how many there are,
            evenly on a logarithmic scale.
        band: arguments of `sweeps.grid.axis` along sigma_e_hat, over which the best absorbers are tuned.

    Returns "csv": columns panel ("module 1" or 2, which is hit), series (balls, a linear system, or where balls are
    quickest, which may lie between the impulses of the others), impulse, cycles (inf: never).
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
    return {"csv": join(curves), "fraction": fraction}


@styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`, a panel for each module that is hit."""
    figure = new_figure(DOUBLE_COLUMN, 80.0)
    figure.get_layout_engine().set(wspace=0.07)
    places = figure.subplots(1, len(MODULES), sharey=True)
    for axes, letter, module in zip(places, "ab", MODULES, strict=True):
        rows = tables["csv"][tables["csv"]["panel"] == f"module {module}"]
        balls, best = (select(rows, f"module {module}", series) for series in ("balls", SHORTEST))
        draw_lines(axes, rows, "impulse", "cycles")
        axes.plot(balls["impulse"], balls["cycles"], label="balls", **DOTS | {"linestyle": "-", "linewidth": 0.6})
        axes.plot(best["impulse"], best["cycles"], label=SHORTEST, **BEST)
        logarithmic(axes, "x", *balls["impulse"].iloc[[0, -1]])
        axes.set(xlabel=f"impulse on box {module}, $X_{module}'(0)$")
        axes.set_title(f"box {module} is hit", loc="right", pad=3)
        letter_panel(axes, letter)
    places[0].set_ylim(bottom=0.0)
    places[0].set_ylabel(f"cycles until {100 * tables['fraction']:g} % of the energy is left")
    figure.legend(*places[0].get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=8)
    return figure
