"""Follow exact asymmetric orbits to small epsilon, and find the fixed points of the slow flow that they approach.

Orbits and fixed points are compared in three coordinates of each module: the amplitude C, v^2, and the phase [rad]
half-way from the impact at wall +1 to the impact at wall -1. Here v is the difference of the two flight times, divided
by the period. Asymmetric orbits emanate from a symmetric orbit, which has v = 0. At this symmetric orbit, the three
coordinates are smooth functions of epsilon, but v and the impact phases are not.
"""

from dataclasses import dataclass

import numpy as np

from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions
from vibroimpact.exact.orbits.newton import follow as from_root
from vibroimpact.exact.orbits.symmetric import wrapped
from vibroimpact.studies.regimes.families import AsymmetricOrbits, flight_fractions

_SYMMETRIC = 1e-6  # an orbit with a smaller v^2 is symmetric within the accuracy of Newton's method
_LIMIT_DISTANCE = 0.01
_MOST_NODES = 6


@dataclass(frozen=True, eq=False)
class Station:
    """An exact asymmetric orbit at one value of epsilon.

    system: system with this value of epsilon.
    root: solution of `AsymmetricConditions` for the orbit, shape (6,).
    """

    system: object
    root: np.ndarray

    @property
    def place(self) -> np.ndarray:
        """Coordinates of the orbit, shape (6,): C_1, C_2, v_1^2, v_2^2, and two phases [rad].

        Phase i is half-way from the impact of ball i at wall +1 to its impact at wall -1.
        """
        u = flight_fractions(self.system, self.root)
        middle = self.system.Omega * (self.root[:4:2] + u * self.system.period / 2)
        return np.concatenate([AsymmetricOrbits.amplitudes(self.system, self.root), (1 - 2 * u) ** 2, middle])


def follow(system, root, values) -> list[Station]:
    """Follow an asymmetric orbit to smaller epsilon; return its Station at the start and at each epsilon in `values`.

    The returned list ends early if the orbit becomes symmetric or if Newton's method fails.

    root: solution of `AsymmetricConditions` for the orbit at the start, shape (6,).
    values: decreasing values of epsilon.
    """
    root = np.asarray(root, dtype=float)
    stations = [Station(system, root)]
    for epsilon, x in from_root(lambda epsilon: AsymmetricConditions(system.with_(epsilon=epsilon)), root, values, 1.0):
        slower = system.with_(epsilon=epsilon)
        stations.append(Station(slower, np.concatenate([wrapped(x[:4], slower.period), x[4:]])))
        if max(stations[-1].place[2:4]) < _SYMMETRIC:
            return stations[:-1]
    return stations


def offset(station, point) -> np.ndarray:
    """Return the coordinates of an orbit minus the coordinates of a fixed point.

    The coordinates of the orbit are `station.place`. The result has the shape (6,), or (3,) if only one module is
    active.
    """
    difference = station.place - np.concatenate([point.C, point.squared, point.middle + point.psi])
    difference[4:] = np.angle(np.exp(1j * difference[4:]))
    return difference[np.isfinite(difference)]


def leads_to(stations, points):
    """Return the fixed point in `points` that the orbits in `stations` approach at epsilon = 0.

    The last two orbits are extrapolated linearly to epsilon = 0. The result is None if there are fewer than two orbits,
    or if no fixed point is near the extrapolated orbit.
    """
    if len(stations) < 2:
        return None
    last, before = stations[-1], stations[-2]
    reach = last.system.epsilon / (before.system.epsilon - last.system.epsilon)
    errors = [np.linalg.norm((1 + reach) * offset(last, p) - reach * offset(before, p)) for p in points]
    return points[int(np.argmin(errors))] if errors and min(errors) < _LIMIT_DISTANCE else None


def onset(stations) -> float:
    """Return the epsilon at which the asymmetric orbit emanates from a symmetric orbit.

    The value is extrapolated from the last orbits in `stations`. If the extrapolated value is negative, return 0.
    """
    last = stations[-_MOST_NODES:]
    epsilon = np.array([station.system.epsilon for station in last])
    skew = np.array([station.place[2:4].max() for station in last])
    # The result is the value at v^2 = 0 of the polynomial epsilon(v^2) through all of these orbits. A straight line
    # through two orbits whose values of epsilon differ by 20 % would give only three digits.
    weights = [np.prod(np.delete(skew, k) / (np.delete(skew, k) - skew[k])) for k in range(len(last))]
    return max(0.0, float(epsilon @ weights))
