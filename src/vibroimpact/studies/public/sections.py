"""Compute stroboscopic sections of many runs."""

import numpy as np

from vibroimpact.exact.engine.simulation import MOST_CYCLES
from vibroimpact.exact.lanes.ensemble import ensemble
from vibroimpact.system.arguments import whole
from vibroimpact.system.progress import track
from vibroimpact.system.state import active_mask

_STEP = 100  # number of transient cycles in a step of the progress display


def sections(systems, states, cycles: int, settle: int = 0, progress: bool = True) -> np.ndarray:
    """Return stroboscopic Poincare sections of many runs: the state at the end of every cycle after the transient.

    For a list of systems with one varied parameter, the sections form a bifurcation diagram.

    Parameters
    ----------
    systems : System or array_like
        One System or an array of Systems. Systems and states are combined as in `ensemble`.
    states : array_like
        Initial states at tau = 0, shape (..., 8). A module that is inactive (not in `System.modules`) is put at rest.
    cycles : int
        Number of forcing periods of each run, including the transient.
    settle : int, default 0
        Number of forcing periods of the transient, which is omitted.
    progress : bool, default True
        Count the steps on standard error, if it is a terminal.

    Returns
    -------
    ndarray
        Dimensionless states of shape (..., cycles - settle, 8). The dots stand for the shape to which `systems` and
        `states` broadcast. After a run has failed, its states are nan; `ensemble` gives the reason.

    Raises
    ------
    ValueError
        If an argument is malformed, or if systems and states do not broadcast.

    Examples
    --------
    >>> forces = np.linspace(0.90, 0.96, 4)
    >>> found = sections([system.with_(f20_hat=f) for f in forces], [0.0] * 8, cycles=320, settle=300)
    >>> X2 = found[:, :, 2]  # plot this over forces[:, None]
    >>> X2.shape
    (4, 20)
    """
    cycles = whole("cycles", cycles, 1, MOST_CYCLES)
    settle = whole("settle", settle, 0, cycles - 1)
    begin, systems = settle % _STEP, np.array(systems, dtype=object)
    states, found = ensemble(systems, states, begin, settle=begin)["final"], []
    moves = np.reshape([active_mask(system) for system in systems.flat], (*systems.shape, 8))
    states = np.where(moves, states, 0.0)
    steps = [_STEP] * (settle // _STEP) + [1] * (cycles - settle)
    for step in track(steps, "sections: step", progress):
        states = ensemble(systems, states, step, settle=step)["final"]
        found.append(states)
    return np.stack(found[settle - cycles :], axis=-2)
