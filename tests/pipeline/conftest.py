"""Figures of every kind at the chapter's parameters, computed from scratch in the form of the pipeline's tables."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.figures import fig10_01, fig10_03, fig10_04, fig10_05, fig10_06, fig10_07, fig10_08, fig10_10
from vibroimpact.theory.fixed_points.labels import labels

CHAPTER = {
    **PARAMETERS,
    "f10_hat": 1.0,
    "f20_hat": 1.0,
}
WEAK = {"f10_hat": 0.5, "f20_hat": 0.5}
TRANSIENT, WINDOW, PER_CYCLE = 200, 4, 100
"""Cycles left out, cycles kept and samples per cycle of the simulation."""


def fixed_points(**changes):
    """The system and its table of fixed points."""
    system = vi.System(**CHAPTER | changes)
    points = vi.fixed_points(system)
    rows = [
        [label, *point.C, *point.B, *point.psi] for label, point in zip(labels(system, points), points, strict=True)
    ]
    table = pd.DataFrame(rows, columns=["label", "C1", "C2", "B1", "B2", "psi1", "psi2"])
    return system, table.sort_values("label", ignore_index=True)


def motion(**changes):
    """Samples and events of a run from rest."""
    system = vi.System(**CHAPTER | changes)
    tau = (TRANSIENT + np.arange(WINDOW * PER_CYCLE + 1) / PER_CYCLE) * system.period
    run = vi.simulate(system, np.zeros(8), TRANSIENT + WINDOW, sample_times=tau)
    samples = pd.DataFrame({"tau": tau, "X2": run.samples[:, 2], "Y2": run.samples[:, 3]})
    events = pd.DataFrame({name: run.events[name] for name in ("tau", "module", "wall")})
    return samples, events.assign(X2=run.events["state"][:, 2])


def of_points(compute, *scene, **base):
    """A figure computed from a table of fixed points; `rounding` spoils that table as another machine would."""

    def computed(rounding=lambda table: table, edit=lambda table: table, **changes):
        system, table = fixed_points(**base | changes)
        return compute(system, edit(rounding(table)), *scene)

    return computed


def of_motion(rounding=lambda table: table, **changes):
    return fig10_08.compute(*(rounding(table) for table in motion(**changes)))


FIGURES = {
    "fig10_01": SimpleNamespace(compute=None, draw=lambda table: fig10_01.draw()),
    "fig10_03": SimpleNamespace(
        compute=lambda rounding=None: fig10_03.compute(amplitude=1.0, theta=0.8, tau0_max=12.0), draw=fig10_03.draw
    ),
    "fig10_04": SimpleNamespace(
        compute=lambda rounding=None, kappa=0.65: fig10_04.compute(kappa=kappa, C_max=2.0), draw=fig10_04.draw
    ),
    "fig10_05": SimpleNamespace(compute=lambda rounding=None: fig10_05.compute((0.5, 1.1)), draw=fig10_05.draw),
    "fig10_06": SimpleNamespace(compute=of_points(fig10_06.compute, (2.0, 3.5)), draw=fig10_06.draw),
    "fig10_07": SimpleNamespace(compute=of_points(fig10_07.compute, "c", 2), draw=fig10_07.draw),
    "fig10_08": SimpleNamespace(compute=of_motion, draw=fig10_08.draw),
    "fig10_10": SimpleNamespace(compute=of_points(fig10_10.compute, "a", 2, (2.0, 2.0), **WEAK), draw=fig10_10.draw),
}


@pytest.fixture(scope="session")
def figures():
    """Per figure: compute(rounding, and changed parameters where it has any) -> table, and draw(table) -> Figure."""
    return FIGURES
