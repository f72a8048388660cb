"""The state [X1, Y1, X2, Y2, X1', Y1', X2', Y2'] of a motion and its events, as everyone writes them."""

import numpy as np

NAMES = ("X1", "Y1", "X2", "Y2", "dX1", "dY1", "dX2", "dY2")
"""Names of the components, of columns of tables say; d is d/dtau."""

BOXES = np.array([0, 2, 4, 6])
"""Places of X1, X2, X1', X2' in the state."""
BALLS = np.array([1, 3, 5, 7])
"""Places of Y1, Y2, Y1', Y2' in the state."""
_MODULES = np.array([1, 1, 2, 2] * 2)

IMPACT, STICK, RELEASE = 0, 1, 2
KINDS = {IMPACT: "impact", STICK: "stick", RELEASE: "release"}
"""Kinds of events: a ball meets a wall, comes to rest on it, leaves it."""

EVENT = np.dtype([("tau", "f8"), ("module", "i1"), ("wall", "i1"), ("kind", "i1"), ("state", "f8", (8,))])
"""One event: time, module 1 or 2, wall +1 or -1, kind, state just after it."""


def takes_part(system) -> np.ndarray:
    """Return True for each component of the state of a module that takes part (`System.modules`), shape (8,).

    Where no module does, both decay freely: True for all.
    """
    return np.isin(_MODULES, system.modules or (1, 2))


def idle_at_rest(system, states) -> np.ndarray:
    """Return states (..., 8) with a module that takes no part at rest, whatever is given for it."""
    return np.where(takes_part(system), states, 0.0)
