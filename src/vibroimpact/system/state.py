"""The state [X1, Y1, X2, Y2, X1', Y1', X2', Y2'] of a motion and its events, as everyone writes them."""

import numpy as np

NAMES = ("X1", "Y1", "X2", "Y2", "dX1", "dY1", "dX2", "dY2")
"""Names of the components, of columns of tables say; d is d/dtau."""

BOXES = np.array([0, 2, 4, 6])
"""Places of X1, X2, X1', X2' in the state."""
BALLS = np.array([1, 3, 5, 7])
"""Places of Y1, Y2, Y1', Y2' in the state."""
MODULES = np.array([1, 1, 2, 2, 1, 1, 2, 2])
"""Modules to which the components of the state belong."""

IMPACT, STICK, RELEASE = 0, 1, 2
KINDS = {IMPACT: "impact", STICK: "stick", RELEASE: "release"}
"""Kinds of events: a ball meets a wall, comes to rest on it, leaves it."""

EVENT = np.dtype([("tau", "f8"), ("module", "i1"), ("wall", "i1"), ("kind", "i1"), ("state", "f8", (8,))])
"""One event: time, module 1 or 2, wall +1 or -1, kind, state just after it."""
