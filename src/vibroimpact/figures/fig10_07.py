"""Figure 10.7: the theoretical steady-state response of a fixed point."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.accuracy.model_choice import motion
from vibroimpact.figures.plotting.names import name_curves, name_walls
from vibroimpact.figures.plotting.style import BLACK, GREY, SINGLE_COLUMN, heading, new_figure, styled, time_plot
from vibroimpact.tables import curve, join, select

SPEC = {
    "title": "Theoretical response of fixed point (c)",
    "notebook": "theoretical_response",
    "caption": r"Fig. 10.7. Theoretical steady-state response of fixed point (c) for :math:`\hat f_{10} = {f10_hat}`, "
        r":math:`\hat f_{20} = {f20_hat}`: boxes :math:`X_i` (dotted) and :math:`U_i = X_i + "
        r"\varepsilon Y_i` grey, balls :math:`Y_i` and :math:`W_i = X_i - Y_i` black. The walls limit :math:`W_i` "
        "only.",
    "alt": "Two panels over two forcing periods, one for each module, with a named line for each coordinate: the "
        "sine-like U and X in grey, the relative displacement W and the zigzag of the ball Y in black.",
    "own": {
        "title": "Theoretical response of fixed point ({fixed_point}) of case {case}",
        "caption": r"Theoretical steady-state response of fixed point ({fixed_point}) of case *{case}*, :math:`\hat "
            r"f_{10} = {f10_hat}`, :math:`\hat f_{20} = {f20_hat}`: :math:`U_i`, :math:`X_i` (dotted) grey, "
            ":math:`W_i`, :math:`Y_i` (dash-dotted) black.",
        "alt": "A panel for each module over {periods} forcing periods: the sine-like U and X in grey, the relative "
            "displacement W and the zigzag of the ball Y in black.",
    },
    "equations": [
        r"U_{i0} = B_i\sin(\tau_0 + \phi_i) \tag{10.9}",
        r"W_{i0} = B_i\sin(\tau_0 + \phi_i) + Z_i \tag{10.10}",
    ],
    "method": "leading order, (10.9) and (10.10), at a fixed point",
    "columns": {
        "panel": {"values": ["module 1", "module 2"]},
        "series": {"values": ["U_1", "X_1", "W_1", "Y_1", "U_2", "X_2", "W_2", "Y_2"]}, "tau": {"compared": "roots"},
        "value": {"meaning": "coordinate named in `series`: $U_i$, $X_i$, $W_i$ or $Y_i$ by (10.9), (10.10)",
            "unit": "dimensionless", "compared": "roots"},
    },
}  # fmt: skip

MODULES = (1, 2)
COORDINATES = {
    "U": {"color": GREY, "linestyle": "-", "linewidth": 1.6},
    "X": {"color": GREY, "linestyle": (0, (1, 1)), "linewidth": 1.4},
    "W": {"color": BLACK, "linestyle": "-", "linewidth": 1.2},
    "Y": {"color": BLACK, "linestyle": (0, (6, 1.5, 1.5, 1.5)), "linewidth": 1.0},
}
"""U_i and X_i grey, W_i and Y_i black, as in the chapter; the line style separates curves of one colour."""


def compute(system, points: pd.DataFrame, fixed_point: str, periods: float, model: str = "slow_flow") -> pd.DataFrame:
    """Return U_i, X_i, W_i and Y_i of both modules at a fixed point, for `periods` forcing periods from tau = 0.

    Parameters
    ----------
    points : DataFrame
        Fixed points of the case, columns label, C1, C2, B1, B2, psi1, psi2.
    fixed_point : str
        Label of the fixed point.
    model : str, default 'slow_flow'
        slow_flow (leading order, (10.9) and (10.10)), exact_orbit or second_term. `vibroimpact.accuracy.model_choice`
        describes the models.

    Returns columns panel ("module 1", "module 2"), series ("U_1", ...), tau, value. The times tau include the impacts.

    Raises
    ------
    ValueError
        If the label is unknown, if the model gives no motion, or if periods is not above 0.
    """
    if not periods > 0:
        raise ValueError(f"periods: {periods} is not above 0")
    shown = motion(system, points, fixed_point, model)
    period, end, curves = system.period, periods * system.period, []
    for module, first in zip(MODULES, shown.impacts, strict=True):
        # The ball hits a wall every half period. `first` is the time of one impact, or NaN if the module is inactive.
        impacts = np.arange(first - period, end, 0.5 * period) if np.isfinite(first) else np.empty(0)
        tau = np.union1d(np.linspace(0.0, end, 401), impacts[impacts >= 0])
        response = shown.response(tau)
        curves += [
            curve(f"module {module}", f"{name}_{module}", tau=tau, value=getattr(response, name)[:, module - 1])
            for name in COORDINATES
        ]
    return join(curves)


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`, with the first module above the second."""
    figure = new_figure(SINGLE_COLUMN, 86.0)
    grid = figure.subplots(len(MODULES), 1, sharex=True, sharey=True)
    names = {}
    for axes, module, letter in zip(grid, MODULES, "ab", strict=True):
        names |= draw_response(axes, table, module)
        heading(axes, letter, f"theoretical response, module {module}")
    grid[-1].set_xlabel(r"$\tau$")
    name_curves(figure, names, fontsize=10, color=BLACK)
    return figure


def draw_response(axes, table: pd.DataFrame, module: int) -> dict:
    """Draw the coordinates and walls of one module against tau, and return the names of the curves.

    The result is the dict {axes: pairs} for the argument `panels` of `name_curves`. A pair contains the name of a
    curve, and a list with the Line2D object of this curve.
    """
    lines = {name: select(table, f"module {module}", f"{name}_{module}") for name in COORDINATES}
    time_plot(axes, [(line["tau"], line["value"], COORDINATES[name]) for name, line in lines.items()])
    axes.set_ylabel(f"box $X_{module}$, ball $Y_{module}$")
    axes.margins(y=0.1)
    name_walls(axes, f"wall\nfor $W_{module}$")
    return {axes: [(f"${name}_{module}$", [line]) for name, line in zip(lines, axes.lines[-4:], strict=True)]}
