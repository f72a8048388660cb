"""Find the forces along a path at which the response is modulated, by the slow flow and by simulation."""

import numpy as np

from vibroimpact.studies.regimes.classification import CHAOTIC, STRONGLY_MODULATED
from vibroimpact.studies.theory.relaxation import relax

FORCES = {"f10_hat", "f20_hat"}
COLUMNS = ["path", "source", "first", "last", "uncertainty", "agreement"]
"""Column uncertainty is the spacing of the values, and agreement is the share of values at which both sources agree."""
SLOW_FLOW, SIMULATION = "slow flow", "simulation"
_WINDOW_AND_TRANSIENT = 300, 300
"""Forcing cycles of the window and of the transient before the window. During the transient, a ball may leave resonance
for good."""


def predicted(path, values) -> np.ndarray:
    """Return a mask (n,) of the values at which the slow flow predicts a modulated response.

    Only forces vary along `path`.
    """
    forces = [(system.f10_hat, system.f20_hat) for system in map(path, values)]
    share = relax(path.system, *_WINDOW_AND_TRANSIENT, forces=forces).share
    return ((share > 0) & (share < 1)).any(axis=1)


def observed(values, p, names) -> np.ndarray:
    """Return a mask (n,) of the values at which a run ends modulated or chaotic.

    The regime of the run at p[k] is names[k].
    """
    modulated = np.asarray(p)[np.isin(names, (STRONGLY_MODULATED, CHAOTIC))]
    return np.isin(values, modulated)


def longest_range(values, flags) -> tuple[float, float]:
    """Return the ends of the longest range of `values` in which all `flags` are True, or (nan, nan)."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
    if not len(edges):
        return np.nan, np.nan
    widest = np.argmax(edges[1::2] - edges[::2])
    return float(values[edges[2 * widest]]), float(values[edges[2 * widest + 1] - 1])


def onsets(path, values, p, names) -> list[tuple]:
    """Return two rows with the modulated range of `values`, one by the slow flow and one by simulation.

    The list is empty if any parameter other than the forces varies.
    """
    if not set(path.names) <= FORCES:
        return []
    flags = {SLOW_FLOW: predicted(path, values), SIMULATION: observed(values, p, names)}
    name, agreement = " ".join(path.names), float((flags[SLOW_FLOW] == flags[SIMULATION]).mean())
    spacing = float(values[1] - values[0])
    return [(name, source, *longest_range(values, flag), spacing, agreement) for source, flag in flags.items()]
