"""Stroboscopic sections of many runs at once."""

import numpy as np

from vibroimpact.exact.engine.ensemble import ensemble
from vibroimpact.exact.engine.simulation import MOST_CYCLES
from vibroimpact.system.arguments import whole
from vibroimpact.system.progress import track
from vibroimpact.system.state import takes_part

_STEP = 100  # cycles of the transient between two lines of progress


def sections(systems, states, cycles: int, settle: int = 0, progress: bool = True) -> np.ndarray:
    """Return the stroboscopic Poincare sections of many runs: their states at the end of every forcing cycle once
    settled.

    Over a list of systems in which one parameter moves this is a bifurcation diagram:

    >>> forces = np.linspace(0.90, 0.96, 4)
    >>> found = sections([system.with_(f20_hat=f) for f in forces], [0.0] * 8, cycles=320, settle=300)
    >>> X2 = found[:, :, 2]  # plot this over forces[:, None]
    >>> X2.shape
    (4, 20)

    Parameters
    ----------
    systems, states
        Combined as by `ensemble`: one System or an array of them, and starts (..., 8) at tau = 0. A module that takes
        no part (`PhysicalSystem.single`) is put at rest.
    cycles : int
        Forcing periods of each run.
    settle : int, default 0
        Those of them that are left out.
    progress : bool, default True
        Count the steps, of 100 cycles and then of 1, on standard error, if that is a terminal.

    Returns
    -------
    ndarray
        States (..., cycles - settle, 8), dimensionless, in the shape of the combination; nan once a run has failed
        (`ensemble` says why).

    Raises
    ------
    ValueError
        If an argument is malformed, or systems and states cannot be combined.
    """
    cycles = whole("cycles", cycles, 1, MOST_CYCLES)
    settle = whole("settle", settle, 0, cycles - 1)
    begin, systems = settle % _STEP, np.array(systems, dtype=object)
    states, found = ensemble(systems, states, begin, settle=begin)["final"], []
    moves = np.reshape([takes_part(system) for system in systems.flat], (*systems.shape, 8))
    states = np.where(moves, states, 0.0)
    steps = [_STEP] * (settle // _STEP) + [1] * (cycles - settle)
    for step in track(steps, "sections: step", progress):
        states = ensemble(systems, states, step, settle=step)["final"]
        found.append(states)
    return np.stack(found[settle - cycles :], axis=-2)
