"""Config of the studies, and edited copies of both config files."""

from pathlib import Path

import configs
from configs import UNDAMPED, malformed

MINE = (
    "sweeps.mine = {case: equal, axes: [{along: [epsilon], range: [0.05, 0.1], values: 3}, {along: [f10_hat, f20_hat], "
    "listed: [0.5, 0.8]}], observe: [amplitudes, regimes], starts: 5, seed: 1, cycles: 40, settle: 30}"
)
TABLE = malformed(Path(__file__).with_name("malformed_configs.txt"))
UNUSUAL = [
    "system.epsilon = 3 & sweeps.frequency_response = ... & sweeps.clearance = ... & sweeps.design = ...",
    "regimes.basins.points = '61'",
    "system.sigma20_hat = -9.9 & stability.verdict_grid.epsilon = [0.1] & regimes.epsilon.fit_below = 0.05",
    "regimes.epsilon.mixed = ... & sweeps.design = ...",
    "sweeps.design.case = ... & regimes.basins.case = ...",
    "stability.verdict_grid.epsilon = [0.1]",
    "regimes.branches.paths = [{along: [kappa, epsilon], range: [0.1, 0.5]}]",
    "sweeps = ...",
    "sweeps.design = ... & sweeps.frequency_response.axes[1].tuples = [[0.5, 0.5], [1.0, -1.0], [2.0, 0.1]]",
    "sweeps.regime_map.axes = [{along: [f10_hat], range: [0, 1], values: 3}, "
    "{along: [f20_hat], range: [0, 1], cells: 2}]",
    "MINE & sweeps.mine.axes[0] = {along: [sigma20_hat, sigma_e_hat], tuples: [[-20, 0], [1, -20]]} "
    "& sweeps.mine.axes[1] = {along: [epsilon], listed: [0.01, 0.02]}",
    "regimes.epsilon.epsilon = [0.0001, 0.1]",
    f"{UNDAMPED} & machines = ...",
]


def edited(edits: str) -> dict:
    """Return the valid config after edits; MINE stands for a valid sweep of this name."""
    return configs.edited(edits.replace("MINE", MINE))
