"""Continue branches of motions in one parameter, and their special points in two."""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import asdict

import numpy as np

from vibroimpact.exact.periodic import PeriodicOrbit
from vibroimpact.studies.regimes import bifurcation_curves as curves
from vibroimpact.studies.regimes import branches as one_parameter
from vibroimpact.studies.regimes.bifurcation_curves import BifurcationCurve, Plane
from vibroimpact.studies.regimes.branches import Branch, Path
from vibroimpact.studies.regimes.continuation import Lost
from vibroimpact.studies.regimes.families import AsymmetricOrbits, FixedPoints, PeriodicOrbits, SymmetricOrbits
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, pair, whole
from vibroimpact.system.progress import wants_progress, write_line
from vibroimpact.system.representation import Found

FAMILIES = {
    "theory": (FixedPoints,),
    "exact": (SymmetricOrbits, AsymmetricOrbits),
    "both": (SymmetricOrbits, AsymmetricOrbits, FixedPoints),
}
_MOST_SEEDS = 1000
_STEPS, _CURVE_STEPS = 10, 20
"""Length of the range divided by the longest step, for branches and for curves of special points."""


def branches(
    system: System,
    along: str | Sequence[str],
    between,
    of: str | PeriodicOrbit = "both",
    seeds: int = 5,
    progress: bool = True,
) -> list[Branch]:
    """Return the branches of 1:1 motions, or of a given motion, over a parameter, with stability and special points.

    Pseudo-arclength continuation (Keller 1977) passes folds and branch points. It also follows the branches that
    emanate from branch points, and asymmetric orbits that emanate from symmetric ones. Each branch is divided at its
    special points: folds, branch points, symmetry breaking, period doubling, Neimark-Sacker, Hopf, grazing. If a branch
    ends inside `between`, the special point at its end gives the reason: speed zero, lost, symmetry breaking (the
    branch meets its mirror image) or period doubling (the branch meets a motion with a shorter period).

    Parameters
    ----------
    system : System
        System with the values of all other parameters.
    along : str or sequence of str
        A parameter of System, or several that vary together.
    between : tuple of float
        Least and greatest value of the parameter.
    of : str or PeriodicOrbit, default 'both'
        "theory" (fixed points of the slow flow), "exact" (1:1 orbits), "both", or one given motion of any period, from
        `periodic_orbit`. The branch of a given motion ends as "lost" where a ball grazes or an event falls on the
        stroboscopic instant.
    seeds : int, default 5
        Number of values in `between` at which to search for motions. Branches that pass none of these values and
        emanate from no other branch are missed. For one given motion there is no search.
    progress : bool, default True
        Report family and parameter on standard error, if it is a terminal; "exact" takes about ten seconds.

    Returns
    -------
    list of Branch
        Each branch has .family; .nodes in order, of which the first and last may lie one step beyond `between`;
        .special, the special nodes; and .closed, True if its last node is also its first. A node has .p, the parameter,
        .amplitudes C_1, C_2, .kind (the type of special point, or ""), .stable and .admissible. `to_frame` returns one
        row per node of each piece between special points; a special point has a row in both pieces.

    Raises
    ------
    ValueError
        If an argument is malformed, if an end of the range does not give a valid system, or if the given motion is
        outside the range.

    Warns
    -----
    UserWarning
        If motions cannot be computed at a seed, for example because undamped boxes are in resonance.

    Examples
    --------
    >>> found = branches(system, "f20_hat", between=(0.9, 1.1), of="theory")
    >>> len(found), found[0].family.name
    (3, 'fixed point')
    """
    names = (along,) if isinstance(along, str) else tuple(along)
    check_parameters(system, names)
    path = Path(system, names)
    low, high = _range("between", between)
    values = np.linspace(low, high, whole("seeds", seeds, 1, _MOST_SEEDS))
    for end in (low, high):
        try:
            path(end)
        except ValueError as error:
            raise ValueError(f"between: at {end}, {error}") from None
    found = []
    if isinstance(of, PeriodicOrbit):
        families, values = (PeriodicOrbits(of),), [getattr(of.system, names[0])]
        if path(values[0]) != of.system:
            raise ValueError(f"of: the system of the motion and `system` differ in more than {' = '.join(names)}")
        if not low <= values[0] <= high:
            raise ValueError(
                f"of: the motion is at {' = '.join(names)} = {values[0]}, which is outside the range ({low}, {high}) "
                "of 'between'"
            )
    else:
        families = _families(of)
    for family in families:
        report = _report(f"{family.name}: {' = '.join(names)} =", progress)
        found += one_parameter.branches(family, path, (low, high), values, (high - low) / _STEPS, report, found)
    _end(progress)
    if isinstance(of, PeriodicOrbit) and not found:
        raise ValueError(f"of: the motion cannot be followed from {' = '.join(names)} = {values[0]}")
    return Found(found, one_parameter.COLUMNS)


def bifurcation_curves(
    system: System, along: tuple[str, str], between, of: str = "theory", seeds: int = 3, progress: bool = True
) -> list[BifurcationCurve]:
    """Return the curves of folds and of symmetry breaking in the plane of two parameters.

    The curves bound the regions in which a motion exists and in which it is symmetric. Special points are found on
    branches along the first parameter at several values of the second, then followed through the plane.

    Parameters
    ----------
    system : System
        System with the values of all other parameters.
    along : tuple of str
        Two parameters of System.
    between : tuple of tuple of float
        First and last value of each parameter, ((low, high), (low, high)).
    of : str, default 'theory'
        "theory" (fixed points of the slow flow), "exact" (orbits) or "both".
    seeds : int, default 3
        Number of values of the second parameter at which to search, evenly spaced inside its range. A curve that passes
        none of these values is missed.
    progress : bool, default True
        Report the current family and parameters on standard error, if it is a terminal; "exact" takes minutes.

    Returns
    -------
    list of BifurcationCurve
        Each curve has .family, .kind, .points (n, 2), the values of both parameters, and .amplitudes (n, 2), C_1, C_2.
        `to_frame` returns a table.

    Raises
    ------
    ValueError
        If an argument is malformed, or if a corner does not give a valid system.

    Examples
    --------
    >>> found = bifurcation_curves(system, ("f10_hat", "f20_hat"), between=[(0.8, 1.2), (0.6, 1.1)])
    >>> sorted({curve.kind for curve in found})[0]
    'fold'
    """
    names = (along,) if isinstance(along, str) else tuple(along)
    if len(names) != 2 or len(set(names)) != 2:
        raise ValueError(f"along: got {along!r}, expected the names of two parameters")
    check_parameters(system, names)
    try:
        first, second = between
    except (TypeError, ValueError):
        raise ValueError(f"between: got {between!r}, expected ((low, high), (low, high))") from None
    limits = np.array([_range(f"between, {name}", one) for name, one in zip(names, (first, second), strict=True)])
    plane = Plane(system, names, limits)
    for corner in ((p, q) for p in limits[0] for q in limits[1]):
        try:
            plane(*corner)
        except Lost as error:
            raise ValueError(f"between: at {corner}, {error}") from None
    count = whole("seeds", seeds, 1, _MOST_SEEDS)
    (low, high), widths = limits[0], np.diff(limits)[:, 0]
    found = []
    for family in _families(of):
        started = []
        for q in np.linspace(*limits[1], count + 2)[1:-1].tolist():
            report = _report(f"{family.name}: {names[1]} = {q:.4g}, {names[0]} =", progress)
            try:
                path = Path(system.with_(**{names[1]: q}), names[:1])
            except ValueError as error:
                warnings.warn(f"{family.name}: skipped the search at {names[1]} = {q:.6g}: {error}", stacklevel=2)
                continue
            values = np.linspace(low, high, count + 2)
            started += [
                (q, branch)
                for branch in one_parameter.branches(family, path, (low, high), values, widths[0] / _STEPS, report)
            ]
        report = _report(f"{family.name}, special points: {', '.join(names)} =", progress)
        found += curves.bifurcation_curves(plane, started, widths.max() / _CURVE_STEPS, report)
    _end(progress)
    return Found(found, ("family", "curve", "special", *names, "C1", "C2"))


def check_parameters(system, names) -> None:
    """Raise ValueError unless `system` is a System and all `names` are parameters of System."""
    known = asdict(instance("system", system, System))
    for name in names:
        if name not in known:
            raise ValueError(f"{name}: not a parameter of System; expected one of {', '.join(known)}")


def _range(name, values):
    low, high = pair(name, values)
    if not low < high:
        raise ValueError(f"{name}: got ({low}, {high}), expected (low, high) with low < high")
    return low, high


def _families(of):
    if of not in tuple(FAMILIES):
        raise ValueError(f"of: got {of!r}, expected one of {', '.join(FAMILIES)}")
    return FAMILIES[of]


def _report(words, progress) -> Callable:
    """Return a function of parameter values that, if `progress`, writes a progress line: `words`, then the values."""
    return lambda *values: (
        wants_progress(progress) and write_line(f"{words} {', '.join(f'{value:.4g}' for value in values)}")
    )


def _end(progress):
    if wants_progress(progress):
        write_line("", last=False)
