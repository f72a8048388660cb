"""Follow stable asymmetric orbits through a list of values of a parameter."""

import warnings
from collections.abc import Iterator

import numpy as np

from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions
from vibroimpact.exact.orbits.newton import follow
from vibroimpact.studies.regimes.branches import images
from vibroimpact.studies.regimes.families import AsymmetricOrbits

SEARCHED = (0.25, 0.5, 0.75)
"""Orbits are searched at the values with these positions in the list of values, as fractions of its length."""
LARGEST_CHANGE = 0.1
"""Largest change of a root between neighbouring values on a branch; the values of a slider are close together."""
SAME = 1e-6


def followed(systems: dict) -> Iterator[tuple[float, object]]:
    """Yield (value, Orbit) for each orbit on the branches of stable asymmetric orbits.

    Stable orbits are searched at a few of the values, see SEARCHED, and followed to both sides by Newton's method until
    the branch folds, or the orbit is inadmissible or symmetric. Of two mirror images one is followed. Branches without
    a stable orbit at a value in SEARCHED are missed. A branch also ends where undamped boxes resonate. If they resonate
    at a value in SEARCHED, there is a warning, and no orbit is searched there.

    Parameters
    ----------
    systems : dict
        System by value of the parameter, in ascending order.
    """
    values, found = list(systems), {value: [] for value in systems}
    for part in SEARCHED:
        middle = int(part * (len(values) - 1))
        system = systems[values[middle]]
        for x in _stable(system):
            if not _known(x, [root for root, _ in found[values[middle]]], system):
                for direction in (values[middle:], values[:middle][::-1]):
                    for value, root, orbit in _along(direction, systems, x):
                        found[value].append((root, orbit))
    for value, there in found.items():
        yield from ((value, orbit) for _, orbit in there)


def _stable(system):
    """Return the roots of the stable admissible asymmetric orbits, one for each pair of mirror images."""
    stable = []
    try:
        roots = AsymmetricOrbits.roots(system)
    except ValueError as error:
        warnings.warn(f"asymmetric orbit: skipped a search: {error}", stacklevel=3)
        return []
    for x in roots:
        orbit = AsymmetricOrbits.member(system, x)
        if orbit.admissible and AsymmetricOrbits.stable(system, orbit) and not _known(x, stable, system):
            stable.append(x)
    return stable


def _known(x, roots, system):
    """Return True if the root `x` or the root of its mirror image is in the list `roots`."""
    near = (image - root for root in roots for image in images(AsymmetricOrbits, system, x, root))
    return any(np.abs(gap).max() < SAME for gap in near)


def _along(values, systems, x):
    """Follow the root `x` through `values`; yield (value, root, Orbit) as long as the orbit is admissible."""
    for value, root in follow(lambda value: AsymmetricConditions(systems[value]), x, values, LARGEST_CHANGE):
        orbit = AsymmetricOrbits.member(systems[value], root)
        if not orbit.admissible:
            return
        yield value, root, orbit
