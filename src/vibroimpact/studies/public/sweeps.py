"""Sweeps over one or two parameters in one call."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict

from vibroimpact.exact.engine.simulation import MOST_CYCLES
from vibroimpact.studies.public.continuation import with_parameters
from vibroimpact.studies.regimes.settling import Observation
from vibroimpact.studies.sweeps.grid import Axis, Grid
from vibroimpact.studies.sweeps.observations import COLUMNS
from vibroimpact.studies.sweeps.rows import rows
from vibroimpact.studies.sweeps.spec import PEAKS, Spec
from vibroimpact.system import System
from vibroimpact.system.arguments import MOST_SEED, instance, reals, whole
from vibroimpact.system.progress import track

_MOST_STARTS = 10_000
_AXES = (1, 2)


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
    """Return a row per point of a grid: the parameters that move and the observations; `to_frame` makes a table of
    them.

    A point where something cannot be computed has the reason under "failed", and does not cost the others.

    >>> rows = sweep(system, {"f20_hat": [0.6, 1.0]}, ["fixed_points"])
    >>> [row["fixed_points"] for row in rows]
    [1, 3]

    Parameters
    ----------
    system : System
        Gives the other parameters.
    axes : mapping
        The values of one or two parameters, by name.
    observe : sequence of str
        Any of "amplitudes" (largest |X_i|, root mean square, mean ball speeds), "envelopes" (amplitude per cycle, 5 %
        and 95 %), "energy" (share of the work that impacts take), "peaks" (what one cycle in a hundred exceeds along a
        band), "regimes" (share of the starts that end in each; where rest ends), all of which simulate from every
        start; "fixed_points" (their number, and that of those called stable by the theory) and "orbits" (number of
        exact 1:1 orbits, and of stable ones).
    starts, seed
        Number of starts, spread evenly, the first at rest; what scrambles them. From rest a ball may stay idle that
        moves from any other start.
    cycles, settle
        Forcing periods of each run, and those of them that are left out; not of "regimes", which have those of
        `observation`. At equal forces 400 leave most starts changing, 2000 none (docs/howto.md).
    band : mapping, optional
        Of "peaks": the values of the parameter along which the highest peak is sought, by name.
    observation : Observation, optional
        Of "regimes": how long a start is looked at.
    progress : bool, default True
        Count the points on standard error, if that is a terminal.

    Raises
    ------
    ValueError
        If an argument is malformed or missing, or there is no system at a point.
    """
    known = asdict(instance("system", system, System))
    grid = Grid(system, _axes("axes", axes, known))
    if len(grid.axes) not in _AXES:
        raise ValueError(f"axes: {len(grid.axes)} parameters; needs one or two")
    observe = tuple(observe) if not isinstance(observe, str) else (observe,)
    for name in observe:
        if name not in COLUMNS:
            raise ValueError(f"observe: {name!r} is none of {', '.join(COLUMNS)}")
    if not observe:
        raise ValueError(f"observe: nothing; choose from {', '.join(COLUMNS)}")
    cycles = whole("cycles", cycles, 1, MOST_CYCLES)
    spec = Spec(
        observe=observe,
        starts=whole("starts", starts, 1, _MOST_STARTS),
        seed=whole("seed", seed, 0, MOST_SEED),
        cycles=cycles,
        settle=whole("settle", settle, 0, cycles - 1),
        band=_band(band, known, axes) if PEAKS in observe or band is not None else None,
        observation=asdict(instance("observation", observation or Observation(), Observation)),
    )
    for number in range(len(grid)):  # every point has a system, or none is computed
        grid.system(number)
    return list(rows(grid, spec, track(range(len(grid)), "sweep: point", progress)))


def _axes(name, given, known) -> list[Axis]:
    """Return the axes of single parameters from their values by name."""
    if not isinstance(given, Mapping):
        raise ValueError(f"{name}: needs values by parameter, such as {{'f20_hat': [0.8, 1.0]}}")
    with_parameters(known, given)
    found = {key: reals(f"{name}[{key!r}]", list(values)).ravel().tolist() for key, values in given.items()}
    for key, values in found.items():
        if not values:
            raise ValueError(f"{name}[{key!r}]: has no value")
    return [Axis((key,), tuple(values)) for key, values in found.items()]


def _band(given, known, axes) -> dict:
    """Return the arguments of `grid.axis` for the band of peaks."""
    if given is None:
        raise ValueError("band: missing; 'peaks' are sought along it, such as band={'sigma_e_hat': [-1.0, 0.0, 1.0]}")
    found = _axes("band", given, known)
    if len(found) != 1:
        raise ValueError(f"band: {len(found)} parameters; needs one")
    if found[0].along[0] in axes:
        raise ValueError(f"band: {found[0].along[0]} moves along the axes already")
    return {"along": found[0].along, "listed": found[0].values}
