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
        """State at the start, time of the start and time of the end of every free flight."""
        return zip([self.first, *self.after], [0.0, *self.times], [*self.times, self.end], strict=True)


def impact_sequence(times: np.ndarray, period: float):
    """Times, modules and walls, each (4,), of impacts at times (2, 2) [module, wall +1 / wall -1] in [0, T), in order.

    One at 0 comes last, at T: the state at tau = 0 is the one after it.
    """
    within = np.where(times == 0, period, times).ravel()
    order = np.argsort(within, kind="stable")
    return within[order], _MODULES[order], _WALLS[order]


def free_flight(system, state: np.ndarray, tau: float, duration: float):
    """State (8,) after a free flight from time tau of this duration, and its derivative (8, 8) by the state before."""
    flow = expm(rate_matrix(system) * duration)
    phase = system.Omega * tau
    final, jacobian = np.empty(8), np.zeros((8, 8))
    final[BOXES] = flow[:4] @ [*state[BOXES], math.sin(phase), math.cos(phase)]
    final[BALLS[:2]] = state[BALLS[:2]] + duration * state[BALLS[2:]]
    final[BALLS[2:]] = state[BALLS[2:]]
    jacobian[np.ix_(BOXES, BOXES)] = flow[:4, :4]
    jacobian[BALLS, BALLS] = 1.0
    jacobian[BALLS[:2], BALLS[2:]] = duration
    return final, jacobian


def follow(system, state: np.ndarray, times: np.ndarray, modules: np.ndarray, end: float) -> Passage:
    """Follow the motion from `state` (8,) at tau = 0 to tau = end, through impacts of `modules` (1, 2) at given times.

    times: ascending in [0, end], one for each entry of modules.

    The impacts are taken as given: that a ball is at its wall at that time is the caller's business.

    Raises:
        ValueError: an impact without relative velocity (see impact_saltation).
    """
    first, tau, jacobian = state, 0.0, np.eye(8)
    before, after = np.empty((len(times), 8)), np.empty((len(times), 8))
    for k, (time, module) in enumerate(zip(times, modules, strict=True)):
        before[k], flight = free_flight(system, state, tau, time - tau)
        after[k] = impact_matrix(system, module) @ before[k]
        jacobian = impact_saltation(system, before[k], time, module) @ flight @ jacobian
        state, tau = after[k], time
    final, flight = free_flight(system, state, tau, end - tau)
    return Passage(first, times, before, after, final, end, flight @ jacobian)


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
