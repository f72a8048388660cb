"""Looks of balls and of the systems compared with them."""

from matplotlib.ticker import LogLocator, NullFormatter

from vibroimpact.figures.kit.style import BLACK, GREY

LINES = {
    "without balls": {"color": GREY, "linestyle": "-", "linewidth": 1.6},
    "balls fixed": {"color": GREY, "linestyle": (0, (1, 1.2)), "linewidth": 1.6},
    "absorbers of the textbook": {"color": BLACK, "linestyle": (0, (4.5, 2.5)), "linewidth": 0.9},
    "best absorbers": {"color": BLACK, "linestyle": "-", "linewidth": 0.9},
}
DOTS = {"linestyle": "none", "marker": "o", "color": BLACK, "markersize": 2.8, "markeredgewidth": 0.7}
BEST = {"linestyle": "none", "marker": "*", "markersize": 9, "markeredgewidth": 0.8, "color": "white"}
BEST |= {"markeredgecolor": BLACK, "zorder": 4}
LEAST, MOST = 0.8, 1.3
"""Lower end of axes of displacement per force, and margin above the highest line."""


def draw_lines(axes, rows, x: str, y: str) -> None:
    """The linear systems among the rows of a panel."""
    for name, look in LINES.items():
        line = rows[rows["series"] == name]
        axes.plot(line[x], line[y], label=name, **look)


def logarithmic(axes, side: str, *ends: float) -> None:
    """A logarithmic axis whose ends, if given, do not depend on what was simulated."""
    axes.set(**{f"{side}scale": "log"})
    axis = getattr(axes, f"{side}axis")
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())
    if ends:
        axes.set(**{f"{side}lim": ends})
