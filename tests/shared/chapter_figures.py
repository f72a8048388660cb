"""Fixtures: the chapter's figures at its parameters, as tables."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgb

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.figures import fig10_03, fig10_04, fig10_05, fig10_06, fig10_07, fig10_08, fig10_10
from vibroimpact.system.state import NAMES
from vibroimpact.theory.fixed_points.symmetric_points import labels


def system_of(case):
    f10_hat, f20_hat = FORCES[case]
    return vi.System(**PARAMETERS, f10_hat=f10_hat, f20_hat=f20_hat)


def table_of_points(system):
    """Fixed points in the form of the pipeline's table."""
    points = vi.fixed_points(system)
    table = pd.DataFrame(
        {
            "label": label,
            **{f"{name}{i}": getattr(point, name)[i - 1] for name in ("C", "B", "psi") for i in (1, 2)},
        }
        for label, point in zip(labels(system, points), points, strict=True)
    )
    return table.sort_values("label", ignore_index=True)


def tables_of_run(system, start, transient, window, per_cycle):
    """Samples and events of a simulation in the form of the pipeline's tables."""
    times = (transient + np.arange(window * per_cycle + 1) / per_cycle) * system.period
    run = vi.simulate(system, start, transient + window, sample_times=times)
    samples = pd.DataFrame({"tau": times, **dict(zip(NAMES, run.samples.T, strict=True))})
    events = pd.DataFrame({name: run.events[name] for name in ("tau", "module", "wall")})
    events[list(NAMES)] = run.events["state"]
    events["kind"] = np.array(["impact", "stick", "release"])[run.events["kind"]]
    return samples, events


@pytest.fixture
def system():
    """The chapter's parameters with equal forcing."""
    return system_of("equal")


@pytest.fixture(scope="session")
def points_of():
    return table_of_points


@pytest.fixture(scope="session")
def run_of():
    return tables_of_run


@pytest.fixture(scope="session")
def scenes():
    """The tables of the chapter's figures, as `table`."""
    equal, unequal, weak = (system_of(case) for case in FORCES)
    made = {
        "fig10_03": fig10_03.compute(amplitude=1.0, theta=0.8, tau0_max=12.0),
        "fig10_04": fig10_04.compute(kappa=0.65, C_max=2.0),
        "fig10_05": fig10_05.compute(C_range=(0.5, 1.1)),
        "fig10_06": fig10_06.compute(equal, table_of_points(equal), (2.0, 3.5)),
        "fig10_07": fig10_07.compute(equal, table_of_points(equal), "c", 2),
        "fig10_08": fig10_08.compute(equal, *tables_of_run(equal, np.zeros(8), 1000, 6, 200)),
        "fig10_09": fig10_06.compute(unequal, table_of_points(unequal), (2.0, 3.5)),
        "fig10_10": fig10_10.compute(weak, table_of_points(weak), "a", 2, (2.0, 2.0)),
        "fig10_11": fig10_08.compute(weak, *tables_of_run(weak, [0, 0, 0, 0, 0, 0.5, 0, 0.5], 1000, 120, 40)),
    }
    return {name: SimpleNamespace(table=table) for name, table in made.items()}


@pytest.fixture(scope="session")
def lightness():
    """CIE L* of a colour, 0 to 100: what is left of it in grey print."""

    def of(colour):
        channels = np.array(to_rgb(colour))
        linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
        return 116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16

    return of
