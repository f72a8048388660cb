"""Results as pandas data frames, sweeps as xarray datasets; a run as a picture.

None of pandas, xarray and Matplotlib is imported before it is needed.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from vibroimpact.system.extras import need
from vibroimpact.system.state import KINDS, NAMES

if TYPE_CHECKING:
    import pandas
    import xarray

_PER_CYCLE, _MOST = 64, 20_000  # points of a picture


def to_frame(result: Any) -> "pandas.DataFrame":
    """Return a pandas DataFrame of a run (its events), an ensemble, basins, or a list of fixed points, orbits,
    branches, bifurcation curves or rows. A list in which a function found nothing has the columns of its results.

    Raises
    ------
    ValueError
        If the result is none of these.
    ModuleNotFoundError
        If pandas is missing; the extra `figures` brings it.
    """
    if hasattr(result, "events"):
        return of_run(result)
    if hasattr(result, "rows"):
        return _pandas().DataFrame(result.rows())
    if isinstance(result, np.ndarray) and result.dtype.names:
        return _pandas().DataFrame(_columns(result.ravel()))
    if isinstance(result, list | tuple) and all(map(_has_rows, result)):
        rows = [row for number, one in enumerate(result) for row in _rows(one, number)]
        return _pandas().DataFrame(rows, columns=None if rows else getattr(result, "columns", None))
    kind = type(result).__name__
    raise ValueError(
        f"result: a {kind} is no run, no ensemble, no basins and no list of fixed points, orbits, branches or rows"
    )


def with_former_names(table: "pandas.DataFrame", former: Mapping[str, str]) -> "pandas.DataFrame":
    """Return the table with some columns under their former names as well, last: they stay for one release.

    Parameters
    ----------
    former : mapping
        Name of a column by its former name.
    """
    return table.assign(**{old: table[name] for old, name in former.items()})


def to_dataset(rows: Any, along: Sequence[str | tuple[str, ...]]) -> "xarray.Dataset":
    """Return an xarray Dataset of a sweep: the parameters that move are its dimensions, each other column a variable.

    `.to_netcdf(path, engine="scipy")` saves it. All numbers are dimensionless, which their attribute `units` says.

    Parameters
    ----------
    rows : object
        Of `vibroimpact.sweep`, a list of dictionaries, or a data frame of them (`results/sweeps/NAME.csv`).
    along : Sequence[str | tuple[str, ...]]
        The parameters that move, in their order; those that move together as a tuple, a dimension named after the first
        of them.

    Raises
    ------
    ValueError
        If a parameter is no column, or the rows are not one for each point of the grid.
    ModuleNotFoundError
        If pandas or xarray is missing; the extra `figures` brings both.
    """
    need("figures", "xarray")
    table = _pandas().DataFrame(rows)
    moved = [(one,) if isinstance(one, str) else tuple(one) for one in along]
    for name in (name for together in moved for name in together):
        if name not in table:
            raise ValueError(f"along: {name!r} is none of the columns {', '.join(table)}")
    first = [together[0] for together in moved]
    if table.duplicated(first).any() or len(table) != table[first].nunique().prod():
        raise ValueError(f"rows: {len(table)} rows are not one for each point of a grid over {', '.join(first)}")
    data = table.drop(columns="point", errors="ignore").set_index(first).to_xarray()
    for name, *others in moved:
        at = dict.fromkeys(set(first) - {name}, 0)
        data = data.assign_coords({other: data[other].isel(at, drop=True) for other in others})
    for variable in data.variables.values():
        variable.attrs |= {"units": "1"} if variable.dtype.kind in "if" else {}
    return data


def of_run(run):
    """Return the events of a Run, a row each: tau, module, wall, kind in words, and the state just after it."""
    table = _pandas().DataFrame({name: run.events[name] for name in ("tau", "module", "wall")})
    table["kind"] = [KINDS[kind] for kind in run.events["kind"].tolist()]
    table[list(NAMES)] = run.events["state"]
    return table


def plot_times(run) -> np.ndarray:
    """Return the times since the start for a picture of a Run: 64 in a cycle, or fewer in a long run."""
    count = min(_PER_CYCLE * run.cycles, _MOST)
    return np.linspace(0.0, run.cycles * run.system.period, count + 1)


def plot(system, times, samples):
    """Return a Matplotlib Figure of states (n, 8) at times tau.

    It shows X_i of both boxes, and W_i = X_i - Y_i between the walls.
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


def _has_rows(one):
    return isinstance(one, dict) or hasattr(one, "rows") or hasattr(one, "row")


def _rows(one, number):
    """Return the rows of one member of a list."""
    if isinstance(one, dict):
        return [one]
    return one.rows(number) if hasattr(one, "rows") else [one.row()]


def _columns(table):
    """Return the columns of a structured array (n,) by name.

    A field with several numbers gives columns numbered from 1, or named as the components of a state.
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
