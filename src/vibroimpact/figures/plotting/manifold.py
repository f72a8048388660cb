"""Compute and draw the slow invariant manifold B(C) of figures 10.4, 10.6, 10.9 and 10.10, with its two branches."""

import numpy as np
import pandas as pd

from vibroimpact.figures.plotting.style import STABLE, UNSTABLE
from vibroimpact.tables import curve, select
from vibroimpact.theory.manifold import B_of_C, C_min, rho
from vibroimpact.theory.masri import printed_limit

BRANCHES = {"SIM unstable": UNSTABLE, "SIM stable": STABLE}


def branches(panel: str, kappa: float, C_max: float) -> list[pd.DataFrame]:
    """Return the unstable and the stable branch of the manifold B(C), (10.16), for 0 <= C <= C_max.

    The branches meet at the limit of (10.26). Both branches contain this point. The stable branch also contains the
    fold, which is at C = C_min of (10.25). Raise ValueError if C_max is not above C_min.
    """
    r = rho(kappa)
    limit, fold = printed_limit(r), C_min(r)
    if not C_max > fold:
        raise ValueError(f"C_max: {C_max} is not above C_min = {fold}, where the right arm of the manifold begins")
    C = np.union1d(np.linspace(0.0, C_max, 401), [limit, fold])
    border = np.searchsorted(C, limit)
    return [
        curve(panel, series, C=part, B=B_of_C(part, r))
        for series, part in (("SIM unstable", C[: border + 1]), ("SIM stable", C[border:]))
    ]


def draw_branches(axes, table: pd.DataFrame, panel: str) -> None:
    """Draw both branches of one panel: a bold solid line for the stable branch, a dashed line for the unstable one."""
    for series, style in BRANCHES.items():
        branch = select(table, panel, series)
        axes.plot(branch["C"], branch["B"], **style, label=series.removeprefix("SIM "))
