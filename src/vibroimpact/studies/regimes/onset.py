"""Find the forces that give a modulated response, first from the slow flow and then from simulations."""

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
    """Return a mask of the entries of `values` at which the slow flow predicts a modulated response, shape (n,).

    path: `branches.Path` that gives the system for each entry of `values`. Only the forces may vary along the path.
    """
    forces = [(system.f10_hat, system.f20_hat) for system in map(path, values)]
    share = relax(path.system, *_WINDOW_AND_TRANSIENT, forces=forces).share
    return ((share > 0) & (share < 1)).any(axis=1)


def observed(values, p, names) -> np.ndarray:
    """Return a mask of the entries of `values` at which a run ends in a modulated or chaotic response, shape (n,).

    values: values of a parameter of the system, shape (n,).
    p: value of the same parameter in each run.
    names: name of the regime at the end of each run.
    """
    modulated = np.asarray(p)[np.isin(names, (STRONGLY_MODULATED, CHAOTIC))]
    return np.isin(values, modulated)


def longest_range(values, flags) -> tuple[float, float]:
    """Return the first and the last entry of the longest unbroken part of `values` in which all `flags` are True.

    If no flag is True, return (nan, nan).
    """
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
    if not len(edges):
        return np.nan, np.nan
    widest = np.argmax(edges[1::2] - edges[::2])
    return float(values[edges[2 * widest]]), float(values[edges[2 * widest + 1] - 1])


def onsets(path, values, p, names) -> list[tuple]:
    """Return a row for the slow flow and a row for the simulations; both rows have the columns COLUMNS.

    Each row contains the first and the last entry of the longest unbroken part of `values` with modulated responses. If
    a parameter other than the forces varies along the path, the list is empty.

    path: `branches.Path` that gives the system for each entry of `values`.
    values: values of the parameter that varies along the path, shape (n,).
    p: value of the same parameter in each simulated run.
    names: name of the regime at the end of each run.
    """
    if not set(path.names) <= FORCES:
        return []
    flags = {SLOW_FLOW: predicted(path, values), SIMULATION: observed(values, p, names)}
    name, agreement = " ".join(path.names), float((flags[SLOW_FLOW] == flags[SIMULATION]).mean())
    spacing = float(values[1] - values[0])
    return [(name, source, *longest_range(values, flag), spacing, agreement) for source, flag in flags.items()]
