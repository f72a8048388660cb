"""The chapter's figures at its parameters, as tables."""

from types import SimpleNamespace

import numpy as np
import pytest

from chapter import FORCES
from figure_tables import system_of, table_of_points, tables_of_run
from vibroimpact.figures import fig10_03, fig10_04, fig10_05, fig10_06, fig10_07, fig10_08, fig10_10


@pytest.fixture
def system():
    """The chapter's parameters with equal forcing."""
    return system_of("equal")


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
