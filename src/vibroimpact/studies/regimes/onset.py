"""Find the forces along a path at which the response is modulated, by the slow flow and by simulation."""

import numpy as np

from vibroimpact.studies.regimes.classification import CHAOTIC, STRONGLY_MODULATED
from vibroimpact.studies.theory.relaxation import relax

FORCES = {"f10_hat", "f20_hat"}
COLUMNS = ["path", "source", "first", "last", "uncertainty", "agreement"]
SLOW_FLOW, SIMULATION = "slow flow", "simulation"
_WINDOW_AND_TRANSIENT = 300, 300
"""Forcing cycles of the window and of the transient before the window. During the transient, a ball may leave resonance
for good."""


def predicted(path, values) -> np.ndarray:
    """Return True for each value, shape (n,), at which the slow flow predicts relaxation oscillations.

    In a relaxation oscillation, a ball enters and leaves resonance again and again, see `theory.relaxation`.

    Parameters
    ----------
    path
        Function from a value to the system; only forces vary.
    values
        Values of the parameter of the path, shape (n,).
    """
    forces = [(system.f10_hat, system.f20_hat) for system in map(path, values)]
    share = relax(path.system, *_WINDOW_AND_TRANSIENT, forces=forces).share
    return ((share > 0) & (share < 1)).any(axis=1)


def observed(values, p, names) -> np.ndarray:
    """Return True for each of `values`, (n,), at which a run ends in a modulated or chaotic response.

    p: value of the parameter in each run. names: regime at the end of each run.
    """
    modulated = np.asarray(p)[np.isin(names, (STRONGLY_MODULATED, CHAOTIC))]
    return np.isin(values, modulated)


def longest_range(values, flags) -> tuple[float, float]:
    """Return the first and last value of the longest unbroken range of `values` with True in `flags`, or (nan, nan)."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
    if not len(edges):
        return np.nan, np.nan
    widest = np.argmax(edges[1::2] - edges[::2])
    return float(values[edges[2 * widest]]), float(values[edges[2 * widest + 1] - 1])


def onsets(path, values, p, names) -> list[tuple]:
    """Return the longest range of `values` with modulated responses, by the slow flow and by simulation.

    Parameters
    ----------
    path, values
        As for `predicted`; the values are evenly spaced.
    p, names
        As for `observed`.

    Returns one row for SLOW_FLOW and one for SIMULATION, with the columns COLUMNS: names of the parameters of the path;
    source; first and last value of the longest range with modulated responses; spacing of the values; share of the
    values at which slow flow and simulation agree. The list is empty if parameters other than forces vary along the
    path.
    """
    if not set(path.names) <= FORCES:
        return []
    flags = {SLOW_FLOW: predicted(path, values), SIMULATION: observed(values, p, names)}
    name, agreement = " ".join(path.names), float((flags[SLOW_FLOW] == flags[SIMULATION]).mean())
    spacing = float(values[1] - values[0])
    return [(name, source, *longest_range(values, flag), spacing, agreement) for source, flag in flags.items()]
