"""Sweep one or two parameters."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict

from vibroimpact.exact.engine.simulation import MOST_CYCLES
from vibroimpact.studies.public.continuation import check_parameters
from vibroimpact.studies.regimes.settling import Observation
from vibroimpact.studies.sweeps.grid import Axis, Grid
from vibroimpact.studies.sweeps.observations import OBSERVATIONS
from vibroimpact.studies.sweeps.rows import rows
from vibroimpact.studies.sweeps.spec import Spec
from vibroimpact.system import System
from vibroimpact.system.arguments import MOST_SEED, instance, reals, short_repr, whole
from vibroimpact.system.progress import track

_MOST_STARTS = 10_000


def sweep(
    system: System,
    axes: Mapping[str, Iterable[float]],
    observe: Sequence[str],
    *,
    starts: int = 5,
    seed: int = 0,
    cycles: int = 1000,
    settle: int = 800,
    band: Mapping[str, Iterable[float]] | None = None,
    observation: Observation | None = None,
    progress: bool = True,
) -> list[dict]:
    """Return observations at all points of a grid of one or two parameters.

    If an observation fails at a point, the row of this point has the reason under "failed". Other rows are not
    affected.

    Parameters
    ----------
    system : System
        System with the values of all other parameters.
    axes : mapping
        Values of one or two parameters, by name.
    observe : sequence of str
        Names of observations. All except "fixed_points" simulate the motions from all initial states.

        - "amplitudes": largest |X_i|, root mean square of X_i, and mean ball speeds.
        - "energy": energy that impacts dissipate, divided by the work of the forces.
        - "peaks": highest peak along `band`. A peak is the displacement that one cycle in a hundred exceeds.
        - "regimes": share of the initial states that end in each regime, and the regime of the run from rest.
        - "fixed_points": number of fixed points of the theory, and number of stable fixed points.
    starts : int, default 5
        Number of initial states. The first one is at rest. The others are evenly spread. In the run from rest, a ball
        may stay idle.
    seed : int, default 0
        Seed of the initial states.
    cycles : int, default 1000
        Number of forcing periods of each run. For "regimes", `observation` sets the lengths of the runs.
    settle : int, default 800
        Number of forcing periods of the transient, which is omitted. Transients may be long. In a test with equal
        forces on both boxes, 210 of 225 motions still changed by more than 1e-6 per period after 400 periods. After
        2000 periods, no motion did.
    band : mapping, optional
        For "peaks": name and values of the parameter along which the highest peak is sought.
    observation : Observation, optional
        For "regimes": lengths of the runs.
    progress : bool, default True
        Count the points on standard error, if it is a terminal.

    Returns
    -------
    list of dict
        One row per point, with the varied parameters and the observations; `to_frame` returns a table.

    Raises
    ------
    ValueError
        If an argument is malformed or missing, or if a point does not give a valid system.

    Examples
    --------
    >>> rows = sweep(system, {"f20_hat": [0.6, 1.0]}, ["fixed_points"])
    >>> [row["fixed_points"] for row in rows]
    [1, 3]
    """
    grid = Grid(system, _axes("axes", axes, system))
    if not 1 <= len(grid.axes) <= 2:
        raise ValueError(f"axes: got {len(grid.axes)} parameters, expected one or two")
    observe = tuple(observe) if not isinstance(observe, str) else (observe,)
    for name in observe:
        if name not in OBSERVATIONS:
            raise ValueError(f"observe: got {name!r}, expected one of {', '.join(OBSERVATIONS)}")
    if not observe:
        raise ValueError(f"observe: got no name, expected one or more of {', '.join(OBSERVATIONS)}")
    cycles = whole("cycles", cycles, 1, MOST_CYCLES)
    spec = Spec(
        observe=observe,
        starts=whole("starts", starts, 1, _MOST_STARTS),
        seed=whole("seed", seed, 0, MOST_SEED),
        cycles=cycles,
        settle=whole("settle", settle, 0, cycles - 1),
        band=_band(band, system, axes) if "peaks" in observe or band is not None else None,
        observation=asdict(instance("observation", observation or Observation(), Observation)),
    )
    for number in range(len(grid)):  # raise before any computation if a point has no valid system
        grid.system(number)
    return list(rows(grid, spec, track(range(len(grid)), "sweep: point", progress)))


def _axes(name, given, system) -> list[Axis]:
    """Return one Axis per parameter, from the values of each parameter by name."""
    if not isinstance(given, Mapping):
        raise ValueError(
            f"{name}: got {short_repr(given)}, expected values by parameter, such as {{'f20_hat': [0.8, 1.0]}}"
        )
    check_parameters(system, given)
    found = {key: reals(f"{name}[{key!r}]", list(values)).ravel().tolist() for key, values in given.items()}
    for key, values in found.items():
        if not values:
            raise ValueError(f"{name}[{key!r}]: got no value")
    return [Axis((key,), tuple(values)) for key, values in found.items()]


def _band(given, system, axes) -> dict:
    """Return the arguments of `grid.axis` for the band along which the highest peak is sought."""
    if given is None:
        raise ValueError("band: missing; 'peaks' requires a band, such as band={'sigma_e_hat': [-1.0, 0.0, 1.0]}")
    found = _axes("band", given, system)
    if len(found) != 1:
        raise ValueError(f"band: got {len(found)} parameters, expected one")
    if found[0].along[0] in axes:
        raise ValueError(f"band: {found[0].along[0]} is already one of the axes")
    return {"along": found[0].along, "listed": found[0].values}
