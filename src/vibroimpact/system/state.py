"""Define the order of states [X1, Y1, X2, Y2, X1', Y1', X2', Y2'] and the data type of events."""

import numpy as np

from vibroimpact.system.arguments import reals

NAMES = ("X1", "Y1", "X2", "Y2", "dX1", "dY1", "dX2", "dY2")
"""Names of the components of a state, used as columns of tables; dX1 is d X1 / dtau."""

BOXES = np.array([0, 2, 4, 6])
"""Indices of X1, X2, X1', X2' in the state."""
BALLS = np.array([1, 3, 5, 7])
"""Indices of Y1, Y2, Y1', Y2' in the state."""
MODULES = np.array([1, 1, 2, 2, 1, 1, 2, 2])
"""Module of each component of the state."""

IMPACT, STICK, RELEASE = 0, 1, 2
KINDS = {IMPACT: "impact", STICK: "stick", RELEASE: "release"}
"""Kinds of events: a ball hits a wall, comes to rest on a wall (stick), or leaves it (release)."""

EVENT = np.dtype([("tau", "f8"), ("module", "i1"), ("wall", "i1"), ("kind", "i1"), ("state", "f8", (8,))])
"""Data type of an event: time, module (1 or 2), wall (+1 or -1), kind (a key of KINDS), state just after the event."""

_LABELS = "keys", "columns", "coords", "_fields"
"""Attributes of labelled values (mappings, tables, labelled arrays, named tuples), which may have another order."""


def states_array(name: str, values) -> np.ndarray:
    """Return a new float array of states, with components in the order of NAMES.

    Raises
    ------
    ValueError
        If `values` is not an array of real numbers, or if it has labels, such as the columns of a table. Labelled
        components may be in another order.
    """
    _refuse_labels(name, values)
    return reals(name, values)


def _refuse_labels(name, values):
    if any(hasattr(values, attribute) for attribute in _LABELS):
        raise ValueError(
            f"{name}: got a {type(values).__name__}, expected plain numbers in the order {', '.join(NAMES)}"
        )
    if isinstance(values, list | tuple) and len(values) and not isinstance(values[0], int | float):
        for one in values:
            _refuse_labels(name, one)


def active_mask(system) -> np.ndarray:
    """Return a mask of the state components that belong to active modules, shape (8,).

    If no module is active, all entries are True.
    """
    return np.isin(MODULES, system.modules or (1, 2))


def inactive_at_rest(system, states) -> np.ndarray:
    """Return a copy of states, shape (..., 8), in which all components of an inactive module are 0."""
    return np.where(active_mask(system), states, 0.0)
