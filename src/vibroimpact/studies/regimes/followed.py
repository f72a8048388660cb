"""Follow stable asymmetric orbits as a parameter moves from value to value."""

import warnings
from collections.abc import Iterator

import numpy as np

from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions
from vibroimpact.exact.orbits.newton import follow
from vibroimpact.studies.regimes.branches import images
from vibroimpact.studies.regimes.families import AsymmetricOrbits

SEARCHED = (0.25, 0.5, 0.75)
"""Orbits are sought at the values these parts of the way along the list."""
NEAR = 0.1
"""Within this of the root at the last value is that at the next: the same branch, by steps as short as a slider's."""
SAME = 1e-6


def followed(systems: dict) -> Iterator[tuple[float, object]]:
    """Yield the value and Orbit of each motion on the branches of the stable asymmetric orbits.

    Only one of two mirror images is followed.

    What is sought at a few values is followed to both sides by Newton's method, to where a branch folds, the orbit
    leaves the walls or becomes symmetric. Branches without a stable orbit at one of those values are missed; a value at
    a resonance of undamped boxes is skipped, with a warning if it is one of those.

    Parameters
    ----------
    systems : dict
        Value of the parameter (ascending) -> system.
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
    """Return the roots of motions that are stable, one of two mirror images."""
    stable = []
    try:
        roots = AsymmetricOrbits.roots(system)
    except ValueError as error:
        warnings.warn(f"no asymmetric orbit sought: {error}", stacklevel=3)
        return []
    for x in roots:
        orbit = AsymmetricOrbits.member(system, x)
        if orbit.admissible and AsymmetricOrbits.stable(system, orbit) and not _known(x, stable, system):
            stable.append(x)
    return stable


def _known(x, roots, system):
    """Return True if a root or its mirror image is among others."""
    near = (image - root for root in roots for image in images(AsymmetricOrbits, system, x, root))
    return any(np.abs(gap).max() < SAME for gap in near)


def _along(values, systems, x):
    """Yield the value, root and Orbit at each of some values in turn, next to the one before, while it is a motion."""
    for value, root in follow(lambda value: AsymmetricConditions(systems[value]), x, values, NEAR):
        orbit = AsymmetricOrbits.member(systems[value], root)
        if not orbit.admissible:
            return
        yield value, root, orbit
