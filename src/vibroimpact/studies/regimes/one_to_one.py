"""Largest displacements and impact shares of the symmetric 1:1 responses: by the theory, and exact."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.exact.lanes.ensemble import ensemble
from vibroimpact.studies.regimes.families import FixedPoints, SymmetricOrbits
from vibroimpact.theory.fixed_points.symmetric_points import search
from vibroimpact.theory.response import leading_order, mean_power

SAMPLES = 512
"""Samples in half a period: a maximum between two of them is larger by 5e-6 of itself at most."""


@dataclass(frozen=True, eq=False)
class Amounts:
    """Summary of a response.

    largest: (2,), the largest |X_i|. impact_share: part of the work of the forces that impacts dissipate.
    stable: by slow flow and impact map, or by all multipliers.
    """

    largest: np.ndarray
    impact_share: float
    stable: bool


def by_theory(system) -> list[Amounts]:
    """Return the responses to leading order, (10.9), (10.10), at every fixed point of (10.23)."""
    tau = np.linspace(0.0, system.period / 2, SAMPLES)
    return [
        Amounts(
            np.abs(leading_order(system, point, tau).X).max(axis=0),
            mean_power(system, point).impact_share,
            FixedPoints.stable(system, point),
        )
        for point in search(system).points
    ]


def by_exact_orbits(system) -> list[Amounts]:
    """Return the on every symmetric orbit that is a motion of the system, from the closed form of one period.

    Raises
    ------
    ArithmeticError
        If an orbit cannot be found or followed.
    """
    found = [SymmetricOrbits.member(system, root) for root in SymmetricOrbits.roots(system)]
    orbits = [orbit for orbit in found if orbit.admissible]
    if not orbits:
        return []
    runs = ensemble(system, [orbit.state for orbit in orbits], 1, energy=True)
    shares = runs["energy"]["impacts"].sum(axis=1) / runs["energy"]["work"].sum(axis=1)
    stable = [SymmetricOrbits.stable(system, orbit) for orbit in orbits]
    return [Amounts(*one) for one in zip(runs["largest"], map(float, shares), stable, strict=True)]
