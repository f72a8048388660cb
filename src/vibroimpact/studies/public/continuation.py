"""Branches of motions over a parameter, and curves of their special points in a plane of two, in one call."""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import asdict

import numpy as np

from vibroimpact.studies.regimes import bifurcation_curves as curves
from vibroimpact.studies.regimes import branches as one_parameter
from vibroimpact.studies.regimes.bifurcation_curves import BifurcationCurve, Plane
from vibroimpact.studies.regimes.branches import Branch, Path
from vibroimpact.studies.regimes.continuation import Lost
from vibroimpact.studies.regimes.families import AsymmetricOrbits, FixedPoints, SymmetricOrbits
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
"""Longest steps over a range, of a branch and of a curve of special points."""


def branches(
    system: System, along: str | Sequence[str], between, of: str = "both", seeds: int = 5, progress: bool = True
) -> list[Branch]:
    """Return all branches of 1:1 motions over a parameter, with stability and special points; `to_frame` makes them a
    table.

    Pseudo-arclength continuation (Keller 1977), through folds and branch points; the branches that leave these, and the
    asymmetric orbits that leave symmetric ones, are followed too. Each branch is cut at its special points: folds,
    branch points, symmetry breaking, period doubling, Neimark-Sacker, Hopf, grazing. Where it ends inside `between`,
    the last one says why: speed zero, symmetry breaking, or lost.

    >>> found = branches(system, "f20_hat", between=(0.9, 1.1), of="theory")
    >>> len(found), found[0].family.name
    (3, 'fixed point')

    Parameters
    ----------
    system : System
        Gives the other parameters.
    along : str or sequence of str
        The parameter of System, or several that move together.
    between
        First and last value. A branch that passes none of the `seeds` values there and leaves no other one is missed.
    of : str, default 'both'
        "theory" (fixed points of the slow flow), "exact" (orbits) or "both".
    progress : bool, default True
        Tell family and parameter on standard error, if that is a terminal; "exact" takes some ten seconds.

    Returns
    -------
    list of Branch
        Each branch has .family, .nodes in their order, of which the first and last may lie one step beyond `between`,
        .special, the special ones, and .closed, True if it returns to its first node, which is then its last one too. A
        node has .p, the parameter, .amplitudes C_1, C_2, .kind (what is special, or ""), .stable and .admissible. The
        table has a row per node of each piece between special points; these belong to both pieces.

    Raises
    ------
    ValueError
        If an argument is malformed, or there is no system at an end.

    Warns:
        UserWarning: motions cannot be sought at a seed, where undamped boxes are in resonance, say.
    """
    names = (along,) if isinstance(along, str) else tuple(along)
    path = Path(_with(system, names), names)
    low, high = _range("between", between)
    values = np.linspace(low, high, whole("seeds", seeds, 1, _MOST_SEEDS))
    for end in (low, high):
        try:
            path(end)
        except ValueError as error:
            raise ValueError(f"between: at {end}, {error}") from None
    found = []
    for family in _families(of):
        report = _report(f"{family.name}: {' = '.join(names)} =", progress)
        found += one_parameter.branches(family, path, (low, high), values, (high - low) / _STEPS, report, found)
    _end(progress)
    return Found(found, one_parameter.COLUMNS)


def bifurcation_curves(
    system: System, along: tuple[str, str], between, of: str = "theory", seeds: int = 3, progress: bool = True
) -> list[BifurcationCurve]:
    """Return the curves of folds and of symmetry breaking in the plane of two parameters; `to_frame` makes them a
    table.

    They bound where a motion exists and where it is symmetric. Special points are found on branches along the first
    parameter at some values of the second, then followed through the plane.

    >>> found = bifurcation_curves(system, ("f10_hat", "f20_hat"), between=[(0.8, 1.2), (0.6, 1.1)])
    >>> sorted({curve.kind for curve in found})[0]
    'fold'

    Parameters
    ----------
    system : System
        Gives the other parameters.
    along : tuple[str, str]
        Two parameters of System.
    between
        First and last value of each, ((low, high), (low, high)).
    of : str, default 'theory'
        "theory" (fixed points of the slow flow), "exact" (orbits) or "both".
    seeds : int, default 3
        Values of the second parameter, evenly spaced inside its range; a curve that passes none is missed.
    progress : bool, default True
        Tell what is followed on standard error, if that is a terminal; "exact" takes minutes.

    Returns
    -------
    list of BifurcationCurve
        Each curve has .family, .kind, .points (n, 2), the values of both parameters, and .amplitudes (n, 2), C_1, C_2.

    Raises
    ------
    ValueError
        If an argument is malformed, or there is no system at a corner.
    """
    names = (along,) if isinstance(along, str) else tuple(along)
    if len(names) != 2 or len(set(names)) != 2:
        raise ValueError(f"along: {along!r}; needs two parameters")
    _with(system, names)
    try:
        first, second = between
    except (TypeError, ValueError):
        raise ValueError(f"between: {between!r}; needs a range of each parameter, ((low, high), (low, high))") from None
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
                warnings.warn(f"no {family.name} sought at {names[1]} = {q:.6g}: {error}", stacklevel=2)
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


def with_parameters(known, names) -> tuple[str, ...]:
    """Return the names, if these are among the known parameters of System.

    Raises
    ------
    ValueError
        If one of them is not.
    """
    for name in names:
        if name not in known:
            raise ValueError(f"{name}: a System has no such parameter; it has {', '.join(known)}")
    return tuple(names)


def _with(system, names) -> System:
    """Return the system, if it has parameters of these names."""
    with_parameters(asdict(instance("system", system, System)), names)
    return system


def _range(name, values):
    low, high = pair(name, values)
    if not low < high:
        raise ValueError(f"{name}: {high} is not above {low}, where the path begins")
    return low, high


def _families(of):
    if of not in FAMILIES:
        raise ValueError(f"of: {of!r} is none of {', '.join(FAMILIES)}")
    return FAMILIES[of]


def _report(words, progress) -> Callable:
    """Return a function that reports parameters after some words."""
    return lambda *values: (
        wants_progress(progress) and write_line(f"{words} {', '.join(f'{value:.4g}' for value in values)}")
    )


def _end(progress):
    if wants_progress(progress):
        write_line("", last=False)
