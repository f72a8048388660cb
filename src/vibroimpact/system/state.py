"""Define the order of states [X1, Y1, X2, Y2, X1', Y1', X2', Y2'] and the data type of events."""

from collections.abc import Mapping

import numpy as np

from vibroimpact.system.arguments import reals, short_repr

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

_COMPONENTS = {name: k for k, name in enumerate(NAMES)} | {f"{name[1:]}'": k for k, name in enumerate(NAMES) if k > 3}
"""Index of each component by its label: one of NAMES, or for velocities also X1', Y1', X2', Y2'."""


def states_array(name: str, values) -> np.ndarray:
    """Return a new float array of states, with labelled components sorted into the order of NAMES.

    Mappings, named tuples, structured arrays, and rows and tables of pandas and similar libraries have labels. They
    may have further entries, as in the tables of `to_frame`. Values without labels must have the order of NAMES.

    Raises
    ------
    ValueError
        If the values are not an array of real numbers, or if a label of a state is missing or occurs twice.
    """
    return reals(name, _ordered(name, values))


def _ordered(name, values):
    if isinstance(values, list | tuple) and not hasattr(values, "_asdict"):
        states = len(values) > 0 and not isinstance(values[0], int | float)
        return [_ordered(f"{name}[{row}]", one) for row, one in enumerate(values)] if states else values
    dimensions = getattr(values, "dims", ())  # names of the dimensions of an xarray object
    if dimensions and dimensions[-1] in getattr(values, "coords", ()):
        raise ValueError(
            f"{name}: arrays labelled by {dimensions[-1]!r} are not supported; pass a table, a mapping or plain numbers"
        )
    labels = _labels(values)
    if labels is None:
        return values
    named = [(_COMPONENTS[str(label)], label) for label in labels if str(label) in _COMPONENTS]
    if sorted(k for k, _ in named) != [*range(len(NAMES))]:
        given = ", ".join(map(str, labels))
        raise ValueError(f"{name}: the columns {short_repr(given)} are not those of a state, {', '.join(NAMES)}")
    parts = values._asdict() if hasattr(values, "_asdict") else values
    components = [reals(f"{name}[{label!r}]", parts[label]) for _, label in sorted(named)]
    if len({component.shape for component in components}) > 1:
        raise ValueError(f"{name}: its components have different shapes")
    return np.stack(components, axis=-1)


def _labels(values):
    """Return the labels of the components of `values`, or None if `values` has no labels."""
    if isinstance(values, Mapping):
        return [*values]
    if names := getattr(values, "_fields", None) or getattr(getattr(values, "dtype", None), "names", None):
        return [*names]
    index = getattr(values, "index", None)
    labels = getattr(values, "columns", index)
    if labels is None or callable(labels):  # `index` can be a method, such as list.index
        return None
    numbered = [*labels] == [*range(len(labels))]
    of_rows = numbered and labels is not index and not _COMPONENTS.keys().isdisjoint(map(str, index))
    return None if numbered and not of_rows else [*labels]  # a table with states in columns is rejected too


def active_mask(system) -> np.ndarray:
    """Return a mask (8,) of the components of the state that belong to an active module (see `System.modules`).

    If no module is active, the motions of both modules decay freely, and all entries are True.
    """
    return np.isin(MODULES, system.modules or (1, 2))


def inactive_at_rest(system, states) -> np.ndarray:
    """Return states (..., 8) with the components of an inactive module set to 0."""
    return np.where(active_mask(system), states, 0.0)
