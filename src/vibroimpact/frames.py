"""Convert results to pandas data frames and xarray datasets, and plot a run.

pandas, xarray and Matplotlib are imported on first use.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from vibroimpact.system.extras import need
from vibroimpact.system.state import KINDS, NAMES

if TYPE_CHECKING:
    import pandas
    import xarray


def to_frame(result: Any) -> "pandas.DataFrame":
    """Return a result as a pandas DataFrame.

    Parameters
    ----------
    result : object
        A run, an ensemble, basins, or a list of fixed points, orbits, branches or dicts.

    Returns
    -------
    pandas.DataFrame
        A run gives one row per event, an ensemble one row per run, and basins one row per initial state. A list gives
        one row per fixed point, orbit or dict, or one row per computed point of each branch. If a function of
        this package returned an empty list, the data frame has the usual columns and no rows.

    Raises
    ------
    ValueError
        If the result has another type.
    ModuleNotFoundError
        If pandas is missing; the extra `figures` installs it.

    Examples
    --------
    >>> vi.to_frame(vi.fixed_points(system))[["label", "C1", "C2"]]  # doctest: +SKIP
    """
    if hasattr(result, "events"):
        return of_run(result)
    if hasattr(result, "rows"):
        return _pandas().DataFrame(result.rows())
    if isinstance(result, np.ndarray) and result.dtype.names:
        return _pandas().DataFrame(_columns(result.ravel()))
    if isinstance(result, list | tuple) and all(
        isinstance(one, dict) or hasattr(one, "rows") or hasattr(one, "row") for one in result
    ):
        rows = [row for number, one in enumerate(result) for row in _rows(one, number)]
        return _pandas().DataFrame(rows, columns=None if rows else getattr(result, "columns", None))
    kind = type(result).__name__
    raise ValueError(
        f"result: unsupported type {kind}; expected a run, an ensemble, basins, "
        "or a list of fixed points, orbits, branches or dicts"
    )


def to_dataset(rows: Any, along: Sequence[str | tuple[str, ...]]) -> "xarray.Dataset":
    """Return a sweep as an xarray Dataset.

    Parameters
    ----------
    rows : list of dict or pandas.DataFrame
        Rows of `vibroimpact.sweep`, or the table `results/sweeps/NAME.csv`.
    along : sequence of str or tuple of str
        Parameters that vary, in the order of the dimensions. Parameters that vary together form a tuple.

    Returns
    -------
    xarray.Dataset
        Each entry of `along` is a dimension. The dimension of a tuple has the name of the first parameter in the tuple.
        Each other column is a variable. All numbers are dimensionless; their attribute `units` is "1".
        `.to_netcdf(path, engine="scipy")` saves the dataset.

    Raises
    ------
    ValueError
        If a parameter is not a column, or if there is not exactly one row per point of the grid.
    ModuleNotFoundError
        If pandas or xarray is missing; the extra `figures` installs both.

    Examples
    --------
    >>> rows = [{"kappa": kappa, "points": len(vi.fixed_points(system.with_(kappa=kappa)))} for kappa in (0.4, 0.6)]
    >>> vi.to_dataset(rows, along=["kappa"]).sizes["kappa"]
    2
    """
    need("figures", "xarray")
    table = _pandas().DataFrame(rows)
    moved = [(one,) if isinstance(one, str) else tuple(one) for one in along]
    for name in (name for together in moved for name in together):
        if name not in table:
            raise ValueError(f"along: {name!r} is not one of the columns {', '.join(table)}")
    first = [together[0] for together in moved]
    if table.duplicated(first).any() or len(table) != table[first].nunique().prod():
        raise ValueError(f"rows: expected one row per point of the grid of {', '.join(first)}; got {len(table)} rows")
    data = table.drop(columns="point", errors="ignore").set_index(first).to_xarray()
    for name, *others in moved:
        at = dict.fromkeys(set(first) - {name}, 0)
        data = data.assign_coords({other: data[other].isel(at, drop=True) for other in others})
    for variable in data.variables.values():
        variable.attrs |= {"units": "1"} if variable.dtype.kind in "if" else {}
    return data


def of_run(run):
    """Return the events of a Run as a data frame: tau, module, wall, kind as text, and the state after each event."""
    table = _pandas().DataFrame({name: run.events[name] for name in ("tau", "module", "wall")})
    table["kind"] = [KINDS[kind] for kind in run.events["kind"].tolist()]
    table[list(NAMES)] = run.events["state"]
    return table


def plot(system, times, samples):
    """Return a Matplotlib Figure of X_i and W_i = X_i - Y_i against time in forcing periods.

    times: times tau, shape (n,). samples: states at these times, shape (n, 8).
    """
    need("figures", "matplotlib")
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.0, 4.0), layout="constrained")
    for i, axes in enumerate(figure.subplots(2, 1, sharex=True)):
        X, Y = samples[:, 2 * i], samples[:, 2 * i + 1]
        axes.plot(times / system.period, X - Y, color="0.6", label=f"$W_{i + 1}$")
        axes.plot(times / system.period, X, color="black", label=f"$X_{i + 1}$")
        axes.legend(loc="upper right", ncols=2)
    axes.set_xlabel("forcing periods")
    return figure


def _rows(one, number):
    """Return the table rows of the result `one`, whose index in the list of results is `number`."""
    if isinstance(one, dict):
        return [one]
    return one.rows(number) if hasattr(one, "rows") else [one.row()]


def _columns(table):
    """Return the columns of a structured array of shape (n,), keyed by name.

    A field of 8 numbers is a state and gives one column per component. Any other field of several numbers gives columns
    that are numbered from 1.
    """
    columns = {}
    for name in table.dtype.names:
        field = table[name]
        if field.dtype.names:
            columns |= {f"{name}_{part}": values for part, values in _columns(field).items()}
        elif field.ndim == 1:
            columns[name] = field
        else:
            width = field.shape[1]
            parts = NAMES if width == len(NAMES) else [f"{name}{k}" for k in range(1, width + 1)]
            columns |= dict(zip(parts, field.T, strict=True))
    return columns


def _pandas():
    need("figures", "pandas")
    import pandas

    return pandas
