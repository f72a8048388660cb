"""Colours and marks of the regimes in all figures; neighbouring regimes in a map remain distinct in greyscale."""

import numpy as np
import pandas as pd
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from vibroimpact.figures.plotting.style import BLACK, hatch_gaps
from vibroimpact.studies.regimes.basins import MIRRORED
from vibroimpact.studies.regimes.classification import (
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

COLOURS = {
    SYMMETRIC: "#004488",
    ASYMMETRIC: "#2a9d8f",
    MIRRORED: "#0b5f54",
    OTHER: "#dcecf5",
    STRONGLY_MODULATED: "#e8b84a",
    CHAOTIC: "#701c34",
    HOPPING: "#cc7788",
    **dict.fromkeys((QUASI_PERIODIC, IDLE, NO_IMPACTS, UNSETTLED), "#848484"),
}
MARKS = {SYMMETRIC: "s", CHAOTIC: ".", HOPPING: "^"}
MARKS |= dict.fromkeys((QUASI_PERIODIC, IDLE, NO_IMPACTS, UNSETTLED), "o")
"""Mark in each cell of a regime with a colour that is similar to others in grey."""
_MARK = {"linestyle": "none", "color": "white", "markersize": 2.4, "markeredgewidth": 0.6}
_BOX = {"edgecolor": BLACK, "linewidth": 0.4}


def paint(axes, square: pd.DataFrame) -> list[str]:
    """Paint the cells of `square` in the colours of their regimes, and return the regimes that occur.

    square: table with the regime of each cell. The index contains the positions of the cells along y. The columns
        contain the positions of the cells along x.
    """
    occurring = [name for name in COLOURS if square.eq(name).to_numpy().any()]
    codes = np.select([square.eq(name).to_numpy() for name in occurring], range(len(occurring)), np.nan)
    norm = BoundaryNorm(np.arange(len(occurring) + 1) - 0.5, len(occurring)) if len(occurring) > 1 else None
    colours = ListedColormap([COLOURS[name] for name in occurring])
    axes.pcolormesh(square.columns, square.index, codes, cmap=colours, norm=norm, rasterized=True)
    if np.isnan(codes).any():
        hatch_gaps(axes)
    for name in (name for name in occurring if name in MARKS):
        rows, columns = np.nonzero(square.eq(name).to_numpy())
        axes.plot(square.columns[columns], square.index[rows], marker=MARKS[name], **_MARK)
    return occurring


def key(names) -> dict[str, tuple]:
    """Return legend handles by label; regimes with the same colour and mark share an entry."""
    alike = {}
    for name in names:
        alike.setdefault((COLOURS[name], MARKS.get(name, "")), []).append(name)
    return {
        ", ".join(shared): (Patch(facecolor=colour, **_BOX), Line2D([], [], marker=mark, **_MARK))
        for (colour, mark), shared in alike.items()
    }
