"""Linear systems to compare with the balls: boxes alone, and boxes with linear absorbers as heavy as the balls."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize

from vibroimpact.studies.absorbers.linear import POINTS, Linear
from vibroimpact.system.matrices import damping_matrix, masses, stiffness_matrix

STARTS = ((1.0, 1.0), (0.95, 1.05), (1.05, 0.95))
"""Starting points of the optimisation, as multiples of the textbook frequencies."""
BOUND_FACTOR = 100.0
"""Each optimised frequency and damping ratio lies between 1 / BOUND_FACTOR and BOUND_FACTOR times its textbook value.
In a band that is narrow or contains no resonance, the best damping ratio or frequency is the lowest one allowed."""


@dataclass(frozen=True)
class Tuning:
    """Linear absorbers, one on each box, each with the mass epsilon of a ball.

    frequency: natural frequency of each absorber on a box at rest, sqrt(stiffness / epsilon), dimensionless.
    damping: damping ratio of each absorber, c / (2 epsilon frequency), with the damper coefficient c.
    """

    frequency: tuple[float, float]
    damping: tuple[float, float]


def without_balls(system, scale=np.ones_like) -> Linear:
    """Return the linear system of the boxes without balls.

    Each box has the dimensionless mass 1. `scale` is passed to `Linear`.
    """
    return Linear(np.diag(masses(system)), damping_matrix(system), stiffness_matrix(system), system.forcing, scale)


def tuned(system, tuning: Tuning, scale=np.ones_like) -> Linear:
    """Return the linear system of the boxes with their absorbers.

    The coordinates are X1 and X2 of the boxes, then Y1 and Y2 of the absorbers. `scale` is passed to `Linear`.
    """
    frequency, damping = np.array(tuning.frequency), np.array(tuning.damping)
    spring, damper = system.epsilon * frequency**2, 2 * system.epsilon * frequency * damping
    return Linear(
        np.diag([1.0, 1.0, system.epsilon, system.epsilon]),
        _attached(damping_matrix(system), damper),
        _attached(stiffness_matrix(system), spring),
        np.concatenate([system.forcing, [0.0, 0.0]]),
        scale,
    )


def textbook_tuning(system) -> Tuning:
    """Return the tuning of the linear absorbers by Den Hartog's rule; each absorber has the mass of a ball.

    The response curve of a single undamped box passes through the same two points for every damping of its absorber.
    The rule makes both points equally high: sqrt(1 + 2 / epsilon) times the static deflection. The peaks of the curve
    are then only slightly higher than these points. For damped or coupled boxes, the rule is approximate.

    For an absorber of mass m with the damper coefficient c, the textbook prints c / (2 m Omega_n) =
    sqrt(3 epsilon / (8 (1 + epsilon)^3)). Here Omega_n is the natural frequency of the box. `Tuning.damping` is
    c / (2 m omega), where omega = Omega_n / (1 + epsilon) is the natural frequency of the absorber.

    References
    ----------
    Den Hartog, Mechanical Vibrations, 4th edition 1956, chapter 3; Brock 1946 (damping).
    """
    ratio = system.epsilon
    host = np.sqrt([1.0, system.stiffness2])
    damping = float(np.sqrt(3 * ratio / (8 * (1 + ratio))))
    return Tuning(tuple((host / (1 + ratio)).tolist()), (damping, damping))


def best_tuning(system, band: tuple[float, float], scale=np.ones_like) -> Tuning:
    """Return the tuning of the linear absorbers that gives the lowest peak in a band of frequencies.

    Each absorber has the mass of a ball. The peak is not a smooth function of the tuning. Therefore the optimisation
    minimises an upper bound on the response at all sampled frequencies of the band. If the optimisation converges from
    none of the starting values in STARTS, ArithmeticError is raised.
    """
    book, frequencies = textbook_tuning(system), np.linspace(*band, POINTS)
    textbook = np.log([*book.frequency, *book.damping])
    found = []
    for factors in STARTS:
        start = textbook + np.log([*factors, 1.0, 1.0])
        bound = _levels(start, system, frequencies, scale).max()
        result = minimize(
            lambda values: values[-1],
            [*start, bound],
            jac=lambda values: np.eye(5)[-1],
            constraints={
                "type": "ineq",
                "fun": lambda values: values[-1] - _levels(values[:4], system, frequencies, scale),
            },
            bounds=[(value - np.log(BOUND_FACTOR), value + np.log(BOUND_FACTOR)) for value in textbook]
            + [(None, None)],
            method="SLSQP",
            options={"maxiter": 200, "ftol": 1e-9},
        )
        if result.success:
            found.append(_tuning(result.x[:4]))
    if not found:
        raise ArithmeticError(f"the tuning of the absorbers for the band {band} did not converge")
    return min(found, key=lambda tuning: tuned(system, tuning, scale).peak(band))


def compared(system, band: tuple[float, float]) -> dict[str, Linear]:
    """Return three linear systems by name: without balls, with textbook absorbers and with the best absorbers.

    The best absorbers are tuned for `band` by `best_tuning`. If `best_tuning` fails, ArithmeticError is raised.
    """
    return {
        "without balls": without_balls(system),
        "absorbers of the textbook": tuned(system, textbook_tuning(system)),
        "best absorbers": tuned(system, best_tuning(system, band)),
    }


def _attached(matrix, links):
    """Return the stiffness or damping matrix of the boxes with their absorbers, shape (4, 4).

    matrix: stiffness or damping matrix of the boxes alone, shape (2, 2).
    links: stiffness of the spring, or coefficient of the damper, between each box and its absorber, shape (2,).
    """
    link = np.diag(links)
    return np.block([[matrix + link, -link], [-link, link]])


def _levels(logarithms, system, frequencies, scale):
    """Return the logarithms of the amplitudes of both boxes at all `frequencies`, as one flat array.

    logarithms: logarithms of `Tuning.frequency` and `Tuning.damping`, shape (4,).

    Each amplitude is raised to at least 1e-12 times the largest amplitude. Otherwise the logarithm would be infinite
    for a box at rest.
    """
    amplitudes = tuned(system, _tuning(logarithms), scale).amplitudes(frequencies)
    return np.log(np.maximum(amplitudes, 1e-12 * amplitudes.max())).ravel()


def _tuning(logarithms):
    return Tuning(*map(tuple, np.exp(logarithms).reshape(2, 2).tolist()))
