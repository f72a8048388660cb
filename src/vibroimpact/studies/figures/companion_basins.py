"""Companion: basins of coexisting regimes in the plane of the initial positions of both balls."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.figures.plotting.style import BLACK, SINGLE_COLUMN, heading, new_figure, styled
from vibroimpact.studies.figures.plotting.regime_colours import key, paint
from vibroimpact.studies.regimes.basins import ends, plane, stable_response
from vibroimpact.studies.regimes.settling import Observation
from vibroimpact.system.chapter import CASES
from vibroimpact.system.state import NAMES

SPEC = {
    "title": "Basins of coexisting responses",
    "caption": "Basins of attraction: the response that each start reaches, against the initial positions of both "
        r"balls. Boxes and velocities start as on the stable asymmetric orbit (circle) at :math:`\tau = 0`. Diamond: "
        "mirror image of this orbit, whose boxes have other positions at that time.",
    "alt": "Map of a plane of starts. Each cell has the colour of the response that the start reaches; the heading "
        "names the case. A circle marks the stable orbit in its own colour, a diamond its mirror image. Below, a key.",
    "method": "direct integration of (10.1) from many starts, until the motion repeats",
    "columns": {
        "panel": {"meaning": "the case"},
        "label": {"meaning": "regime that the start reaches; of two mirrored asymmetric responses, one is called "
            "mirrored", "unit": "text", "compared": "cells of a basin"},
        "W1, W2": {"meaning": r"$W_i = X_i - Y_i$ at $\tau = 0$", "unit": "dimensionless", "compared": "algebra"},
    },
    "tables": {
        "orbits": {
            "file": "results/figures/companion_basins.orbits.csv",
            "about": "The stable asymmetric orbit of `companion_basins` and its mirror image, or boxes at rest.",
            "columns": {
                "series": {"meaning": "shared: the state whose box positions and velocities all starts have, the orbit "
                    "if there is one; its mirror image", "values": ["shared", "mirror image"]},
                "X1, Y1, X2, Y2, dX1, dY1, dX2, dY2": {"meaning": r"displacement or velocity (d is d/dtau) at $\tau = "
                    "0$",
                    "unit": "dimensionless", "compared": "roots"},
            },
        },
        "shares": {
            "file": "results/regimes/basin_shares.csv",
            "about": "Share of the plane of `companion_basins` that leads to each regime.",
            "columns": {
                "regime": {"meaning": "`label` in `companion_basins`", "unit": "text", "values": []},
                "share": {"meaning": "share of the starts", "unit": "share"},
                "uncertainty": {"meaning": "binomial standard error of the share", "unit": "share"},
            },
        },
    },
}  # fmt: skip

MARKS = {"shared": ("o", "asymmetric orbit"), "mirror image": ("D", "its mirror image")}
_MARK = {"linestyle": "none", "color": "white", "markeredgecolor": BLACK, "markeredgewidth": 0.8, "markersize": 5}


def compute(system, case: str, points: int, observation: dict) -> dict:
    """Return the regimes that are reached from initial states with different positions of the balls.

    All initial states have the same positions of the boxes and the same velocities, namely those of the stable
    asymmetric orbit at tau = 0. If there is no such orbit, these positions and velocities are 0.

    points: number of initial states along each axis W_i = X_i - Y_i.
    observation: arguments of `Observation`.
    """
    orbit = stable_response(system)
    states = plane(np.zeros(8) if orbit is None else orbit.state, points)
    names = ends(system, states, Observation(**observation))
    starts = pd.DataFrame({"panel": case, "label": names})
    starts = starts.assign(W1=states[:, 0] - states[:, 1], W2=states[:, 2] - states[:, 3])
    own = {"shared": np.zeros(8)}
    if orbit is not None:
        half = simulate(system, orbit.state, 1, sample_times=[0.5 * system.period]).samples[0]
        own = {"shared": orbit.state, "mirror image": -half}
    orbits = pd.DataFrame(own, index=NAMES).T.rename_axis("series").reset_index()
    share = pd.Series(names).value_counts(normalize=True)
    shares = pd.DataFrame({"regime": share.index, "share": share.to_numpy()})
    shares = shares.assign(uncertainty=np.sqrt(share * (1 - share) / len(names)).to_numpy())
    return {"csv": starts, "orbits": orbits, "shares": shares}


@styled
def draw(tables: dict) -> Figure:
    """Draw the regime that is reached from each initial state.

    A circle marks the asymmetric orbit. A diamond marks its mirror image.
    """
    starts, orbits = tables["csv"], tables["orbits"].set_index("series")
    figure = new_figure(SINGLE_COLUMN, 100.0)
    axes = figure.add_subplot()
    handles = key(paint(axes, starts.pivot(index="W2", columns="W1", values="label")))
    for series, own in orbits.iterrows() if len(orbits) > 1 else ():
        marker, name = MARKS[series]
        place = own["X1"] - own["Y1"], own["X2"] - own["Y2"]
        (handles[name],) = axes.plot(*place, marker=marker, **_MARK)
    responses = starts["label"].nunique()
    case = starts["panel"].iloc[0]
    forces = f"{case} forces" if case in CASES else f"case {case}"
    seen = f"{responses} responses share the starts" if responses > 1 else "all starts end alike"
    heading(axes, words=f"{forces}: {seen}")
    axes.set(xlabel="start of ball 1, $W_1(0)$", ylabel="start of ball 2, $W_2(0)$")
    axes.set(aspect="equal", xlim=(-1, 1), ylim=(-1, 1))
    figure.legend(handles.values(), handles, loc="outside lower center", ncols=2, fontsize=9)
    return figure
