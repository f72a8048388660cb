"""The picture of each command's table, in the look of the figures."""

from itertools import groupby

from vibroimpact.figures.kit.style import (
    BLACK,
    DOUBLE_COLUMN,
    GREY,
    SINGLE_COLUMN,
    STABLE,
    UNSTABLE,
    new_figure,
    styled,
)
from vibroimpact.regimes.families import FixedPoints
from vibroimpact.system.verdict import STABLE as IS_STABLE

CURVES = {
    "without_m": ("without ball", {"color": GREY, "linewidth": 1.6}),
    "with_m": ("with the ball, settled", {"color": BLACK, "linewidth": 1.2}),
    "settling_m": ("while it settles from rest", {"color": BLACK, "linestyle": (0, (1, 1.5)), "linewidth": 0.9}),
    "absorber_m": ("best linear absorber", {"color": BLACK, "linestyle": (0, (4.5, 2.5)), "linewidth": 0.9}),
}


@styled
def points(table):
    """C_2 over C_1 of fixed points or orbits, filled where stable; the last column is the verdict."""
    figure = new_figure(SINGLE_COLUMN, SINGLE_COLUMN)
    axes = figure.add_subplot()
    first = table.columns.index("C1")
    for row in table.rows:
        fill = BLACK if row[-1] == IS_STABLE else "white"
        axes.plot(row[first], row[first + 1], "o", color=BLACK, markerfacecolor=fill, clip_on=False)
    axes.margins(0.1)
    axes.set(xlim=(0, None), ylim=(0, None), xlabel="$C_1$", ylabel="$C_2$", title="filled: stable")
    return figure


@styled
def motion(table):
    """Samples of a run: W_i between its walls, and X_i; of events, their W_i."""
    figure = new_figure(DOUBLE_COLUMN, 100.0)
    columns = dict(zip(table.columns, zip(*table.rows, strict=True), strict=True))
    for i, axes in enumerate(figure.subplots(2, 1, sharex=True), start=1):
        X, Y = columns[f"X{i}"], columns[f"Y{i}"]
        axes.plot(columns["tau"], [x - y for x, y in zip(X, Y, strict=True)], color="0.6", label=f"$W_{i}$")
        axes.plot(columns["tau"], X, color=BLACK, label=f"$X_{i}$")
        axes.legend(loc="upper right", ncols=2)
    axes.set(xlabel=r"$\tau$")
    return figure


@styled
def curves(table):
    """C_1 and C_2 over the parameter, theory beside exact where both are there; stable bold solid, unstable dashed."""
    sides = sorted({_side(row[0]) for row in table.rows}, reverse=True) or ["theory"]
    figure = new_figure(DOUBLE_COLUMN if len(sides) > 1 else SINGLE_COLUMN, 110.0)
    grid = figure.subplots(2, len(sides), sharex=True, sharey="row", squeeze=False)
    for (family, _, _), rows in groupby(table.rows, key=lambda row: row[:3]):
        piece = list(rows)
        p, C1, C2, stable, admissible = zip(*(row[3:8] for row in piece), strict=True)
        for axes, C in zip(grid[:, sides.index(_side(family))], (C1, C2), strict=True):
            if admissible[0]:
                axes.plot(p, C, **(STABLE if stable[0] else UNSTABLE))
    for column, side in enumerate(sides):
        grid[0, column].set_title(side)
        grid[1, column].set_xlabel(table.columns[3])
    for i, axes in enumerate(grid[:, 0], start=1):
        axes.set_ylabel(f"$C_{i}$")
    key = [
        grid[0, 0].plot([], [], **look, label=name)[0] for name, look in (("stable", STABLE), ("unstable", UNSTABLE))
    ]
    figure.legend(handles=key, loc="outside upper center", ncols=len(key))
    return figure


@styled
def resonance(table):
    """Largest displacement over the frequency, without ball, with it, and with the best linear absorber; and while the
    motion with the ball settles."""
    figure = new_figure(SINGLE_COLUMN * 1.35, 80.0)
    axes = figure.add_subplot()
    columns = dict(zip(table.columns, zip(*table.rows, strict=True), strict=True))
    for name, (label, look) in CURVES.items():
        height = [1000 * value for value in columns[name]]
        axes.plot(columns["frequency_Hz"], height, label=label, **look)
    axes.set(xlabel="frequency of the force, Hz", ylabel="largest displacement, mm", ylim=(0, None))
    axes.margins(x=0)
    axes.legend(frameon=False)
    return figure


def _side(family):
    return "theory" if family == FixedPoints.name else "exact"


DRAW = {"fixed-points": points, "orbits": points, "simulate": motion, "response": curves, "design": resonance}
