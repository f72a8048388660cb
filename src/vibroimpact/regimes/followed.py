"""Stable asymmetric orbits and what becomes of them as a parameter moves from value to value."""

from collections.abc import Iterator

import numpy as np

from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions
from vibroimpact.exact.orbits.newton import newton
from vibroimpact.regimes.families import AsymmetricOrbits

SEARCHED = (0.25, 0.5, 0.75)
"""Orbits are sought at the values these parts of the way along the list."""
NEAR = 0.1
"""Within this of the root at the last value is that at the next: the same branch, by steps as short as a slider's."""


def followed(systems: dict) -> Iterator[tuple[float, object]]:
    """Value and Orbit of every motion on the branches of the stable asymmetric orbits, one of two mirror images.

    What is sought at a few values is followed to both sides by Newton's method, to where a branch folds, the orbit
    leaves the walls or becomes symmetric. Branches without a stable orbit at one of those values are missed.

    Args:
        systems: value of the parameter (ascending) -> system.
    """
    values, seen = list(systems), {}
    for part in SEARCHED:
        middle = int(part * (len(values) - 1))
        for x in _stable(systems[values[middle]]):
            if not _known(x, seen.get(middle, ()), systems[values[middle]]):
                for way in (range(middle, len(values)), range(middle - 1, -1, -1)):
                    for k, root in _along([systems[values[j]] for j in way], way, x):
                        seen.setdefault(k, []).append(root)
    for k in sorted(seen):
        for root in seen[k]:
            yield values[k], AsymmetricOrbits.member(systems[values[k]], root)


def _stable(system):
    """Roots of motions that are stable, one of two mirror images."""
    kept = []
    for x in AsymmetricOrbits.roots(system):
        orbit = AsymmetricOrbits.member(system, x)
        if orbit.admissible and AsymmetricOrbits.stable(system, orbit) and not _known(x, kept, system):
            kept.append(x)
    return kept


def _known(x, roots, system):
    """Whether a root or its mirror image is among others."""
    for image in AsymmetricOrbits.images(system, x):
        for root in roots:
            gap = np.append((image - root)[:4] + system.period / 2, (image - root)[4:])
            gap[:4] = gap[:4] % system.period - system.period / 2
            if np.abs(gap).max() < NEAR:
                return True
    return False


def _along(systems, numbers, x):
    """The root at each system in turn, next to the one before, while it is a motion."""
    for number, system in zip(numbers, systems, strict=True):
        found = newton(AsymmetricConditions(system), x[None])
        if not len(found) or np.abs(found[0] - x).max() > NEAR:
            return
        x = found[0]
        if not AsymmetricOrbits.member(system, x).admissible:
            return
        yield number, x
