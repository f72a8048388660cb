"""Studies of a system in one call: branches of motions over a parameter, sweeps, linear absorbers to compare with."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict

import numpy as np

from vibroimpact.absorbers.references import Tuning
from vibroimpact.absorbers.tuning import best, den_hartog
from vibroimpact.regimes import branches as continuation
from vibroimpact.regimes.families import AsymmetricOrbits, FixedPoints, SymmetricOrbits
from vibroimpact.sweeps.observations import COLUMNS
from vibroimpact.sweeps.request import parsed
from vibroimpact.sweeps.rows import rows
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, pair, whole

FAMILIES = {
    "theory": (FixedPoints,),
    "exact": (SymmetricOrbits, AsymmetricOrbits),
    "both": (SymmetricOrbits, AsymmetricOrbits, FixedPoints),
}
_MOST_SEEDS = 1000


def branches(
    system: System, along: str | Sequence[str], between, of: str = "both", seeds: int = 5, notice=lambda family: None
) -> list[continuation.Branch]:
    """All branches of 1:1 motions over a parameter, with stability and special points; `to_frame` makes them a table.

    Args:
        system: gives the other parameters.
        along: the parameter of System, or several that move together.
        between: first and last value. A branch that passes none of the `seeds` values there is missed.
        of: "theory" (fixed points of the slow flow), "exact" (orbits) or "both".
        notice: called with the name of each family before it is looked for.

    Raises:
        ValueError: an argument is malformed, or there is no system at an end.
    """
    low, high = pair("between", between)
    if not low < high:
        raise ValueError(f"between: {high} is not above {low}, where the path begins")
    if of not in FAMILIES:
        raise ValueError(f"of: {of!r} is none of {', '.join(FAMILIES)}")
    names = (along,) if isinstance(along, str) else tuple(along)
    path = continuation.Path(_with_parameters(system, names), names)
    seeds = np.linspace(low, high, whole("seeds", seeds, 1, _MOST_SEEDS))
    for end in (low, high):
        try:
            path(end)
        except ValueError as error:
            raise ValueError(f"between: at {end}, {error}") from None
    found = []
    for family in FAMILIES[of]:
        notice(family.name)
        found += continuation.branches(family, path, (low, high), seeds, (high - low) / 10)
    return found


def sweep(system: System, axes: Mapping[str, Iterable[float]], observe: Sequence[str], **spec) -> list[dict]:
    """A row per point of a grid: the parameters that move and what is observed there; `to_frame` makes a table of them.

    Args:
        system: gives the other parameters.
        axes: the values of one or two parameters, by name.
        observe: names from `sweeps.observations.COLUMNS`, "fixed_points" or "regimes" say; `spec` has what these need
            (see `sweeps.spec.Spec`), cycles say.

    Raises:
        ValueError: an argument is malformed, or there is no system at a point.
    """
    system = _with_parameters(system, axes)
    for name in observe:
        if name not in COLUMNS:
            raise ValueError(f"observe: {name!r} is none of {', '.join(COLUMNS)}")
    listed = [{"along": [name], "listed": list(values)} for name, values in axes.items()]
    grid, wanted = parsed({"system": asdict(system), "axes": listed, "spec": {"observe": observe, **spec}})
    return list(rows(grid, wanted, range(len(grid))))


def best_tuning(system: System, band) -> Tuning:
    """The linear absorbers of the masses of the balls with the lowest peak over a band of frequencies Omega.

    Raises:
        ValueError: an argument is malformed, or no force acts.
        ArithmeticError: no best tuning was found.
    """
    return best(instance("system", system, System), band)


def textbook_tuning(system: System) -> Tuning:
    """The linear absorbers of the masses of the balls as Den Hartog's rule tunes them.

    Raises:
        ValueError: system is not a System.
    """
    return den_hartog(instance("system", system, System))


def _with_parameters(system, names):
    """The system, if it has parameters of these names."""
    known = asdict(instance("system", system, System))
    for name in names:
        if name not in known:
            raise ValueError(f"{name}: a System has no such parameter; it has {', '.join(known)}")
    return system
