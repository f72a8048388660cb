"""Small sweeps with balls, in the form that companion_response and companion_absorber need."""

import pandas as pd

from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.studies.sweeps.rows import rows
from vibroimpact.studies.sweeps.spec import Spec

BAND = {"along": ["sigma_e_hat"], "range": [-1.0, 1.0], "values": 5}
FORCES = ["f10_hat", "f20_hat"]


def tables_of(system, observation):
    """Return the sweeps frequency_response (as "response"), clearance and design, each with two starts."""
    runs = {"starts": 2, "seed": 1, "cycles": 60, "settle": 40, "observation": observation}
    detunings, peaks = axis(["sigma_e_hat"], (-1.0, 1.0), 5), Spec(("peaks",), band=BAND, **runs)
    clearances = axis(FORCES, (0.2, 5.0), 4, "logarithmic")
    forces = axis(FORCES, tuples=[[0.4, 0.4], [0.0, 1.0]])
    spec = {
        "response": ([detunings, forces], Spec(("amplitudes", "energy", "regimes"), **runs)),
        "clearance": ([clearances], peaks),
        "design": ([axis(["kappa"], listed=[0.2, 0.4, 0.65]), axis(FORCES, (0.2, 3.0), 4, "logarithmic")], peaks),
    }
    grids = {name: (Grid(system, axes), what) for name, (axes, what) in spec.items()}
    return {name: pd.DataFrame(rows(grid, what, range(len(grid)))) for name, (grid, what) in grids.items()}
