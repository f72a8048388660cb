"""Companion: basins of the coexisting regimes on a plane of starts, the balls anywhere in their cavities."""

import numpy as np
import pandas as pd
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.figures.kit.style import BLACK, SINGLE_COLUMN, letter_panel, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join
from vibroimpact.regimes.basins import MIRRORED, ends, plane, stable_response
from vibroimpact.regimes.classification import (
    ASYMMETRIC,
    CHAOTIC,
    HOPPING,
    IDLE,
    NO_IMPACTS,
    OTHER,
    QUASI_PERIODIC,
    STRONGLY_MODULATED,
    SYMMETRIC,
    UNSETTLED,
)
from vibroimpact.regimes.settling import Observation
from vibroimpact.system.state import NAMES

SPEC = {
    "title": "Basins of coexisting responses",
    "caption": "Basins: in which response a start ends, on the plane of starts whose boxes and velocities are those of "
        r"the stable asymmetric orbit (circle) at :math:`\tau = 0`; the CSV has them in its row `shared`. Diamond: its "
        "mirror image, whose boxes are elsewhere at that time.",
    "alt": "Map of a plane of starts, each cell in the shade of the response in which the start ends, with the case as "
        "heading. A circle marks the stable orbit in its own shade, a diamond its mirror image. Below, a key.",
    "method": "direct integration of (10.1) from many starts, until it repeats",
    "columns": {
        "panel": {"meaning": "the case"},
        "series": {"meaning": r"a start, the stable asymmetric orbit at $\tau = 0$, its mirror image there, or what "
            "all starts share", "values": ["start", "orbit", "mirror image", "shared"]},
        "label": {"meaning": "regime that the start ends in; of two mirrored asymmetric responses one is called "
            "mirrored", "unit": "text", "compared": {"start": "cells of a basin"}},
        "W1, W2": {"meaning": r"$W_i = X_i - Y_i$ at $\tau = 0$", "unit": "dimensionless", "compared": {
            "start": "algebra", "others": "roots"}},
        "X1, X2, dX1, dY1, dX2, dY2": {"meaning": r"place or velocity (d is d/dtau) that all starts share, at $\tau = "
            "0$", "unit": "dimensionless", "compared": "roots"},
    },
    "tables": {
        "shares": {
            "file": "results/regimes/basin_shares.csv",
            "about": "Share of the plane of `companion_basins` that leads to each regime.",
            "columns": {
                "regime": {"meaning": "the `label` of `companion_basins`", "unit": "text", "values": []},
                "share": {"meaning": "share of the starts", "unit": "share"},
                "uncertainty": {"meaning": "its binomial standard error", "unit": "share"},
            },
        },
    },
}  # fmt: skip

SHADES = {
    STRONGLY_MODULATED: "white",
    ASYMMETRIC: "0.25",
    MIRRORED: "0.65",
    CHAOTIC: "0.95",
    OTHER: "0.82",
    SYMMETRIC: "0.45",
    QUASI_PERIODIC: "0.55",
    HOPPING: "0.9",
    IDLE: "0.75",
    NO_IMPACTS: "0.35",
    UNSETTLED: "0.1",
}
_MARK = {"linestyle": "none", "color": "white", "markeredgecolor": BLACK, "markeredgewidth": 0.8, "markersize": 5}
MARKS = {
    "orbit": {"marker": "o", "label": "the orbit itself"},
    "mirror image": {"marker": "D", "label": "its mirror image"},
}
SHARED = [name for name in NAMES if name not in ("Y1", "Y2")]
"""Coordinates that all starts have in common."""


def compute(system, case: str, points: int, observation: dict) -> dict:
    """Return the regimes of starts with boxes and velocities of the stable asymmetric orbit at tau = 0.

    Where there is no such orbit, the boxes start from rest.

    Args:
        case: what the system is called.
        points: starts along each axis, in the middles of equal parts of -1 < W_i < 1.
        observation: arguments of `regimes.settling.Observation`.

    Returns "csv": columns panel (the case), series ("start", "orbit", "mirror image": of the orbit, whose boxes are
    elsewhere; "shared": what all starts have in common), label (regime), W1, W2, SHARED; and "shares": columns
    regime, share, uncertainty (of a share of so many independent starts, binomial).
    """
    orbit = stable_response(system)
    states = plane(np.zeros(8) if orbit is None else orbit.state, points)
    shared = dict(zip(NAMES, states[0], strict=True))
    names = ends(system, states, Observation(**observation))
    W1, W2 = states[:, 0] - states[:, 1], states[:, 2] - states[:, 3]
    table = [curve(case, "start", label=names, W1=W1, W2=W2)]
    if orbit is not None:
        half = simulate(system, orbit.state, 1, sample_times=[0.5 * system.period]).samples[0]
        for series, label, own in (("orbit", ASYMMETRIC, orbit.state), ("mirror image", MIRRORED, -half)):
            table.append(curve(case, series, label=label, W1=own[0] - own[1], W2=own[2] - own[3]))
    table = join([*table, curve(case, "shared", **{name: shared[name] for name in SHARED})])
    share = pd.Series(names).value_counts(normalize=True)
    shares = pd.DataFrame({"regime": share.index, "share": share.to_numpy()})
    return {"csv": table, "shares": shares.assign(uncertainty=np.sqrt(share * (1 - share) / len(names)).to_numpy())}


@styled
def draw(tables: dict) -> Figure:
    """Draw the table of `compute`: a shade per regime, the orbit itself as a circle, its mirror image as a diamond."""
    table = tables["csv"]
    starts = table[table["series"] == "start"]
    order = [name for name in SHADES if (starts["label"] == name).any()]
    codes = starts.assign(code=starts["label"].map(order.index)).pivot(index="W2", columns="W1", values="code")
    figure = new_figure(SINGLE_COLUMN, 98.0)
    axes = figure.add_subplot()
    axes.pcolormesh(
        codes.columns,
        codes.index,
        codes.to_numpy(),
        cmap=ListedColormap([SHADES[name] for name in order]),
        norm=BoundaryNorm(np.arange(len(order) + 1) - 0.5, len(order)),
        rasterized=True,
    )
    marks = []
    for series, style in MARKS.items():
        own = table[table["series"] == series]
        marks += axes.plot(own["W1"], own["W2"], **_MARK, **style) if len(own) else []
    letter_panel(axes, table["panel"].iloc[0])
    axes.set(xlabel="$W_1(0)$", ylabel="$W_2(0)$", aspect="equal", xlim=(-1, 1), ylim=(-1, 1))
    patches = [Patch(facecolor=SHADES[name], edgecolor=BLACK, linewidth=0.6, label=name) for name in order]
    figure.legend(handles=patches + marks, loc="outside lower center", ncols=2, fontsize=8.5)
    return figure
