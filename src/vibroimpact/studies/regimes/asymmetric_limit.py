"""Follow exact asymmetric orbits to small epsilon, and find the fixed points of the slow flow that they approach.

Orbits and fixed points are compared in three coordinates of each module: the amplitude C, v^2, and the phase [rad]
half-way between the impacts at wall +1 and at wall -1. Here v is the difference of the two flight times, divided by the
period. Asymmetric orbits emanate from a symmetric orbit at v = 0. The three coordinates are smooth in epsilon there,
but v and the impact phases are not.
"""

from dataclasses import dataclass

import numpy as np

from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions
from vibroimpact.exact.orbits.newton import follow as from_root
from vibroimpact.exact.orbits.symmetric import wrapped
from vibroimpact.studies.regimes.families import AsymmetricOrbits, flight_fractions

_SYMMETRIC = 1e-6  # v^2 below which an orbit is symmetric within the accuracy of Newton's method
_LIMIT_DISTANCE = 0.01
_MOST_NODES = 6


@dataclass(frozen=True, eq=False)
class Station:
    """An exact asymmetric orbit at one value of epsilon: its system, and its root (6,) of `AsymmetricConditions`."""

    system: object
    root: np.ndarray

    @property
    def place(self) -> np.ndarray:
        """C_1, C_2, v_1^2, v_2^2 and, for both modules, the phase half-way between the impacts [rad], shape (6,)."""
        u = flight_fractions(self.system, self.root)
        middle = self.system.Omega * (self.root[:4:2] + u * self.system.period / 2)
        return np.concatenate([AsymmetricOrbits.amplitudes(self.system, self.root), (1 - 2 * u) ** 2, middle])


def follow(system, root, values) -> list[Station]:
    """Return the orbit of `root`, (6,), and its continuations to the decreasing `values` of epsilon.

    The list ends early at a symmetric orbit, or where Newton's method fails.
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
    """Return `station.place` minus the values of a fixed point, shape (6,), or (3,) for a single machine."""
    difference = station.place - np.concatenate([point.C, point.squared, point.middle + point.psi])
    difference[4:] = np.angle(np.exp(1j * difference[4:]))
    return difference[np.isfinite(difference)]


def leads_to(stations, points):
    """Return the fixed point that an orbit approaches at epsilon = 0, or None.

    The last two orbits are extrapolated linearly.
    """
    if len(stations) < 2:
        return None
    last, before = stations[-1], stations[-2]
    reach = last.system.epsilon / (before.system.epsilon - last.system.epsilon)
    errors = [np.linalg.norm((1 + reach) * offset(last, p) - reach * offset(before, p)) for p in points]
    return points[int(np.argmin(errors))] if errors and min(errors) < _LIMIT_DISTANCE else None


def onset(stations) -> float:
    """Return the epsilon at which the asymmetric orbit emanates from a symmetric one, at least 0."""
    last = stations[-_MOST_NODES:]
    epsilon = np.array([station.system.epsilon for station in last])
    skew = np.array([station.place[2:4].max() for station in last])
    # The polynomial epsilon(v^2) at v^2 = 0. If epsilon differs by 20 %, a straight line would give only three digits.
    weights = [np.prod(np.delete(skew, k) / (np.delete(skew, k) - skew[k])) for k in range(len(last))]
    return max(0.0, float(epsilon @ weights))
