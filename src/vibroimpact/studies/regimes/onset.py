"""Find forces along a path at which the response is modulated: predicted by the slow flow, and simulated."""

import numpy as np

from vibroimpact.studies.regimes.classification import CHAOTIC, STRONGLY_MODULATED
from vibroimpact.studies.theory.relaxation import relax

FORCES = {"f10_hat", "f20_hat"}
COLUMNS = ["path", "source", "first", "last", "uncertainty", "agreement"]
SLOW_FLOW, SIMULATION = "slow flow", "simulation"
_FOLLOWED = 300, 300
"""Cycles of the window and of the transient, in which a ball may leave resonance forever."""


def predicted(path, values) -> np.ndarray:
    """Return True, shape (n,), where the slow flow predicts relaxation oscillations.

    There a ball enters and leaves resonance forever, see `theory.relaxation`.

    Parameters
    ----------
    path
        Value -> system, along forces alone.
    values
        (n,).
    """
    forces = [(system.f10_hat, system.f20_hat) for system in map(path, values)]
    share = relax(path.system, *_FOLLOWED, forces=forces).share
    return ((share > 0) & (share < 1)).any(axis=1)


def observed(values, p, names) -> np.ndarray:
    """Return True, shape (n,), where an initial state ends in a modulated or chaotic response."""
    modulated = np.asarray(p)[np.isin(names, (STRONGLY_MODULATED, CHAOTIC))]
    return np.isin(values, modulated)


def longest_range(values, flags) -> tuple[float, float]:
    """Return the first and last of the longest unbroken sequence of values (n,) with a flag; nan if none has one."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
    if not len(edges):
        return np.nan, np.nan
    widest = np.argmax(edges[1::2] - edges[::2])
    return float(values[edges[2 * widest]]), float(values[edges[2 * widest + 1] - 1])


def onsets(path, values, p, names) -> list[tuple]:
    """Return the range of modulated responses along a path, by slow flow and simulation, and the share of agreement.

    Parameters
    ----------
    path, values
        As for `predicted`, values evenly spaced.
    p, names
        Where starts are, and what they end in.

    Returns two rows of COLUMNS: names of the path, source, ends of the longest range, spacing, agreement; none if
    something else than forces changes along the path.
    """
    if not set(path.names) <= FORCES:
        return []
    flags = {SLOW_FLOW: predicted(path, values), SIMULATION: observed(values, p, names)}
    common = " ".join(path.names), float(values[1] - values[0]), float((flags[SLOW_FLOW] == flags[SIMULATION]).mean())
    return [(common[0], source, *longest_range(values, flag), *common[1:]) for source, flag in flags.items()]
