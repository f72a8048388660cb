"""Monodromy matrix and Floquet multipliers of a motion with known impacts."""

import math
from typing import NamedTuple

import numpy as np
from scipy.linalg import expm

from vibroimpact.exact.orbits.saltation import impact_matrix, impact_saltation
from vibroimpact.system.matrices import damping_matrix, rate_matrix
from vibroimpact.system.state import BALLS, BOXES

_MODULES = np.array([1, 1, 2, 2])
_WALLS = np.array([1, -1, 1, -1])


class Passage(NamedTuple):
    """A motion followed through its impacts.

    first (8,), final (8,): states at tau = 0 and at the end; times (n,): of the impacts; before (n, 8), after (n, 8):
    states around each; end: time of the end; jacobian (8, 8): derivative of the final state by the first one.
    """

    first: np.ndarray
    times: np.ndarray
    before: np.ndarray
    after: np.ndarray
    final: np.ndarray
    end: float
    jacobian: np.ndarray

    def flights(self):
        """Of all free flights: states at the start (n, 8), times of the start and durations, both (n,)."""
        edges = np.array([0.0, *self.times, self.end])
        return np.vstack([self.first, self.after]), edges[:-1], np.diff(edges)


def impact_sequence(times: np.ndarray, period: float):
    """Times, modules and walls, each (4,), of impacts at times (2, 2) [module, wall +1 / wall -1] in [0, T), in order.

    One at 0 comes last, at T: the state at tau = 0 is the one after it.
    """
    within = np.where(times == 0, period, times).ravel()
    order = np.argsort(within, kind="stable")
    return within[order], _MODULES[order], _WALLS[order]


def free_flights(system, begins: np.ndarray, durations: np.ndarray):
    """Of free flights from times (n,) of durations (n,): the maps x -> A x + b of states, (n, 8, 8) and (n, 8)."""
    flow = expm(rate_matrix(system) * durations[:, None, None])
    phases = system.Omega * begins
    maps, pushes = np.zeros((len(durations), 8, 8)), np.zeros((len(durations), 8))
    maps[:, BOXES[:, None], BOXES] = flow[:, :4, :4]
    maps[:, BALLS, BALLS] = 1.0
    maps[:, BALLS[:2], BALLS[2:]] = durations[:, None]
    pushes[:, BOXES] = (flow[:, :4, 4:] @ np.stack([np.sin(phases), np.cos(phases)], axis=1)[..., None])[..., 0]
    return maps, pushes


def follow(system, state: np.ndarray, times: np.ndarray, modules: np.ndarray, end: float) -> Passage:
    """Follow the motion from `state` (8,) at tau = 0 to tau = end, through impacts of `modules` (1, 2) at given times.

    times: ascending in [0, end], one for each entry of modules.

    The impacts are taken as given: that a ball is at its wall at that time is the caller's business.

    Raises:
        ValueError: an impact without relative velocity (see impact_saltation).
    """
    edges = np.array([0.0, *times, end])
    flights, pushes = free_flights(system, edges[:-1], np.diff(edges))
    before, after = np.empty((len(times), 8)), np.empty((len(times), 8))
    now = state
    for k, impact in enumerate(impact_matrix(system, modules)):
        before[k] = flights[k] @ now + pushes[k]
        after[k] = now = impact @ before[k]
    jacobian = flights[0]
    for saltation, flight in zip(impact_saltation(system, before, edges[1:-1], modules), flights[1:], strict=True):
        jacobian = flight @ saltation @ jacobian
    return Passage(state, edges[1:-1], before, after, flights[-1] @ now + pushes[-1], end, jacobian)


def multipliers(jacobian: np.ndarray) -> np.ndarray:
    """Eigenvalues of a monodromy matrix, shape (8,) complex, by descending modulus, then descending imaginary part."""
    values = np.linalg.eigvals(jacobian).astype(complex)
    return values[np.lexsort((-values.imag.round(12), -abs(values).round(12)))]


def contraction(system, impacts: int) -> float:
    """Product of all multipliers of a motion over one forcing period with so many impacts (Liouville).

    Free flight contracts phase space by exp(-T trace of the damping matrix); each saltation matrix has determinant
    kappa^2: one factor -kappa from the restitution of the relative velocity, the other from the rate n . f+ / n . f-
    = -kappa at which the flow leaves and meets the wall.
    """
    return math.exp(-system.period * np.trace(damping_matrix(system))) * system.kappa ** (2 * impacts)
