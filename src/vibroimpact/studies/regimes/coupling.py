"""Patterns of asymmetric flights of both balls, from weak to strong coupling.

The flight asymmetry v of a ball is the difference of its two flight times, divided by the period. The longer flights of
both balls end at the same wall (IN_PHASE) or at opposite walls (ANTIPHASE). Each pattern has a mirror image
(docs/derivation.md, section 14).
"""

from collections.abc import Iterator

import numpy as np

from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions
from vibroimpact.exact.orbits.newton import newton
from vibroimpact.studies.regimes.families import (
    FOLD,
    GRAZING,
    NEIMARK_SACKER,
    PERIOD_DOUBLING,
    AsymmetricOrbits,
    flight_fractions,
)

IN_PHASE, ANTIPHASE = "in phase", "antiphase"
VANISHES = "asymmetry vanishes"
SOUGHT = (1.0, 14.0, 30.0)
"""Values of alpha12_hat at which stable orbits of each pattern are searched."""
LEAST_ASYMMETRY = 0.05
"""Smallest |v| at which the flights of a ball count as asymmetric."""
STEP, SHARP = 0.1, 3e-5
"""Longest and shortest step in the logarithm of alpha12_hat."""
_SAME_BRANCH, _AT_THE_END = 0.1, 5e-3


def coupled(system, alpha12_hat: float):
    """Return `system` with another coupling spring; the coupling damper changes in proportion to the spring."""
    scale = alpha12_hat / system.alpha12_hat if system.alpha12_hat else 1.0
    return system.with_(alpha12_hat=alpha12_hat, gamma12_hat=system.gamma12_hat * scale)


def flight_asymmetry(orbit) -> np.ndarray:
    """Return the flight asymmetries (v_1, v_2) of both balls, shape (2,).

    v is the flight time from wall -1 to wall +1, minus the flight time from wall +1 to wall -1, divided by the period.
    """
    plus, minus = orbit.ball_speeds.T
    return (plus - minus) / (plus + minus)


def pattern(orbit) -> str | None:
    """Return the pattern of an orbit, IN_PHASE or ANTIPHASE.

    If |v_i| of a ball is below LEAST_ASYMMETRY, return None.
    """
    v = flight_asymmetry(orbit)
    return None if not _both_asymmetric(v) else IN_PHASE if v.prod() > 0 else ANTIPHASE


def _both_asymmetric(v):
    return np.abs(v).min() >= LEAST_ASYMMETRY


def patterns(system) -> dict[str, np.ndarray]:
    """Return one stable orbit of each pattern, as a dict from the name of the pattern to the orbit.

    Each orbit is a root of `AsymmetricConditions`, shape (6,). A pattern without a stable orbit is missing in the dict.
    Of two mirror images, the one with the flight asymmetry v_1 > 0 is returned.
    """
    roots = [
        root for root in AsymmetricOrbits.roots(system) if _both_asymmetric(1 - 2 * flight_fractions(system, root))
    ]
    roots = [(root, AsymmetricOrbits.member(system, root)) for root in roots]
    stable = [(root, one) for root, one in roots if one.admissible and AsymmetricOrbits.stable(system, one)]
    return {name: root for root, one in stable if (name := pattern(one)) and flight_asymmetry(one)[0] > 0}


def stable_ranges(system, limits) -> Iterator[tuple[str, float, list, tuple[str, str]]]:
    """Yield the ranges of the coupling in which a pattern has a stable orbit.

    limits: smallest and largest coupling alpha12_hat.

    At each coupling in SOUGHT, stable orbits of all patterns are searched for. Each orbit is then followed to smaller
    and to larger couplings.

    Each yielded tuple has four entries:

    - the name of the pattern;
    - the coupling in SOUGHT at which the orbit was found;
    - a list of (alpha12_hat, Orbit) in ascending order of alpha12_hat;
    - the reasons why the range ends, (at the lower end, at the upper end). If an end is a limit, its reason is "".
    """
    seen = []
    for start in SOUGHT:
        here = coupled(system, start)
        for name, root in patterns(here).items():
            if any(name == other and low <= start <= high for other, low, high in seen):
                continue
            below, above = (list(_followed(system, root, start, name, limit)) for limit in limits)
            found = [*below[::-1], (start, AsymmetricOrbits.member(here, root)), *above]
            low, high = found[0], found[-1]
            seen.append((name, low[0], high[0]))
            yield name, start, found, tuple("" if at in limits else _end(orbit) for at, orbit in (low, high))


def _followed(system, root, value, name, limit):
    """Follow an orbit from the coupling `value` to `limit`; yield (coupling, Orbit) after each step.

    The iteration ends early if the orbit is no longer stable or no longer has the pattern `name`.

    root: root of the orbit at the coupling `value`.
    """
    way, step = np.sign(limit - value), STEP
    while step > SHARP and value != limit:
        reached = value * np.exp(way * step)
        reached = limit if way * (reached - limit) >= 0 else float(reached)
        found = newton(AsymmetricConditions(coupled(system, reached)), root[None])
        if len(found) and np.abs(found[0] - root).max() < _SAME_BRANCH:
            orbit = AsymmetricOrbits.member(coupled(system, reached), found[0])
            if orbit.admissible and AsymmetricOrbits.stable(system, orbit) and pattern(orbit) == name:
                root, value, step = found[0], reached, min(STEP, 2 * step)
                yield value, orbit
                continue
        step /= 2


def _end(orbit):
    """Return the reason why the range of a pattern ends, given the last stable orbit of the range."""
    mu = orbit.multipliers[0]
    if np.abs(flight_asymmetry(orbit)).min() < LEAST_ASYMMETRY + _AT_THE_END:
        return VANISHES
    if orbit.excursion > 1 - _AT_THE_END:
        return GRAZING
    if abs(mu.imag) > _AT_THE_END:
        return NEIMARK_SACKER
    return FOLD if mu.real > 0 else PERIOD_DOUBLING
