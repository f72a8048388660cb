"""Continue branches of motions in one parameter."""

from collections.abc import Sequence
from dataclasses import asdict

import numpy as np

from vibroimpact.studies.regimes import branches as one_parameter
from vibroimpact.studies.regimes.branches import Branch, Path
from vibroimpact.studies.regimes.families import FAMILIES
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, pair, whole
from vibroimpact.system.progress import track
from vibroimpact.system.representation import Found

_MOST_SEEDS = 1000
_STEPS = 10
"""Length of the range divided by the longest step along a branch."""


def branches(
    system: System,
    along: str | Sequence[str],
    between,
    of: str = "both",
    seeds: int = 5,
    progress: bool = True,
) -> list[Branch]:
    """Return the branches of 1:1 motions in a range of a parameter, with stability and special points.

    Pseudo-arclength continuation (Keller 1977) also follows branches that emanate from other branches. Special points
    are folds, branch points, symmetry breaking, period doubling, Neimark-Sacker, Hopf and grazing. If a branch ends
    inside `between`, its end is a special point whose kind gives the reason:

    - "speed zero": the speed of a ball vanishes;
    - "symmetry breaking": a branch of asymmetric orbits meets its mirror image;
    - "branch point": the continuation cannot pass a branch point;
    - "lost": no further point is found.

    Parameters
    ----------
    system : System
        System with the values of all other parameters.
    along : str or sequence of str
        A parameter of System, or several that all have the same value.
    between : tuple of float
        Least and greatest value of the parameter.
    of : str, default 'both'
        "theory" (fixed points of the slow flow), "exact" (1:1 orbits) or "both".
    seeds : int, default 5
        Number of values in `between` at which to search for motions. A branch that passes none of these values may be
        missed.
    progress : bool, default True
        Show the progress on standard error, if it is a terminal. The exact orbits take about ten seconds.

    Returns
    -------
    list of Branch
        A branch has .family, .nodes (in order), .special (nodes that are special points) and .closed (True if the last
        node is also the first). The end nodes may lie one step beyond `between`.

        A node has .p (the parameter), .amplitudes (C_1 and C_2), .kind, .stable and .admissible. At a special point,
        .kind is a name such as "fold", and .stable and .admissible are None. At all other nodes, .kind is "". For an
        orbit, .admissible is False if a ball passes a wall or a ball speed is not positive.

        `to_frame` divides branches into pieces at their special points, and returns one row per node of a piece. A
        special point has a row in both pieces that it joins.

    Raises
    ------
    ValueError
        If an argument is malformed, or if an end of the range does not give a valid system.

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
    low, high = pair("between", between)
    if not low < high:
        raise ValueError(f"between: got ({low}, {high}), expected (low, high) with low < high")
    if of not in tuple(FAMILIES):
        raise ValueError(f"of: got {of!r}, expected one of {', '.join(FAMILIES)}")
    values = np.linspace(low, high, whole("seeds", seeds, 1, _MOST_SEEDS))
    for end in (low, high):
        try:
            path(end)
        except ValueError as error:
            raise ValueError(f"between: at {end}, {error}") from None
    found = []
    for family in track(FAMILIES[of], "branches: family", progress):
        found += one_parameter.branches(family, path, (low, high), values, (high - low) / _STEPS, found)
    return Found(found, one_parameter.COLUMNS)


def check_parameters(system, names) -> None:
    """Raise ValueError unless `system` is a System and all `names` are parameters of System."""
    known = asdict(instance("system", system, System))
    for name in names:
        if name not in known:
            raise ValueError(f"{name}: not a parameter of System; expected one of {', '.join(known)}")
