"""Companion: basins of the coexisting regimes on a plane of starts, the balls anywhere in their cavities."""

import numpy as np
import pandas as pd
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from vibroimpact.figures.kit.style import BLACK, SINGLE_COLUMN, new_figure, styled
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


def compute(system, points: int, observation: dict) -> dict:
    """Where starts end whose boxes and velocities are those of the stable asymmetric orbit at tau = 0.

    Where there is no such orbit, the boxes start from rest.

    Args:
        points: starts along each axis, in the middles of equal parts of -1 < W_i < 1.
        observation: arguments of `regimes.settling.Observation`.

    Returns "csv": columns panel, series ("start", "orbit"), label (regime), W1, W2; and "shares": columns regime,
    share, uncertainty (of a share of so many independent starts, binomial).
    """
    orbit = stable_response(system)
    states = plane(np.zeros(8) if orbit is None else orbit.state, points)
    names = ends(system, states, Observation(**observation))
    W1, W2 = states[:, 0] - states[:, 1], states[:, 2] - states[:, 3]
    table = curve("basins", "start", label=names, W1=W1, W2=W2)
    if orbit is not None:
        own = orbit.state[0::2][:2] - orbit.state[1::2][:2]
        table = join([table, curve("basins", "orbit", label=ASYMMETRIC, W1=own[0], W2=own[1])])
    share = pd.Series(names).value_counts(normalize=True)
    shares = pd.DataFrame({"regime": share.index, "share": share.to_numpy()})
    return {"csv": table, "shares": shares.assign(uncertainty=np.sqrt(share * (1 - share) / len(names)).to_numpy())}


@styled
def draw(tables: dict) -> Figure:
    """Draw the table of `compute`: a shade per regime, the orbit itself as a circle."""
    table = tables["csv"]
    starts, orbit = (table[table["series"] == name] for name in ("start", "orbit"))
    order = [name for name in SHADES if (starts["label"] == name).any()]
    codes = starts.assign(code=starts["label"].map(order.index)).pivot(index="W2", columns="W1", values="code")
    figure = new_figure(SINGLE_COLUMN, 90.0)
    axes = figure.add_subplot()
    axes.pcolormesh(
        codes.columns,
        codes.index,
        codes.to_numpy(),
        cmap=ListedColormap([SHADES[name] for name in order]),
        norm=BoundaryNorm(np.arange(len(order) + 1) - 0.5, len(order)),
        rasterized=True,
    )
    axes.plot(orbit["W1"], orbit["W2"], "o", color="white", markeredgecolor=BLACK, markeredgewidth=0.8, markersize=5)
    axes.set(xlabel="$W_1(0)$", ylabel="$W_2(0)$", aspect="equal", xlim=(-1, 1), ylim=(-1, 1))
    patches = [Patch(facecolor=SHADES[name], edgecolor=BLACK, linewidth=0.6, label=name) for name in order]
    figure.legend(handles=patches, loc="outside lower center", ncols=2, fontsize=8.5)
    return figure
