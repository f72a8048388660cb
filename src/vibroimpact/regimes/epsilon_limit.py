"""Theory against the exact orbit as epsilon tends to 0: distance, slow and fast multipliers."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from vibroimpact.exact.orbits import symmetric_orbit
from vibroimpact.exact.symmetric import symmetric_solutions
from vibroimpact.theory.masri import impact_multipliers
from vibroimpact.theory.response import impact_times


@dataclass(frozen=True, eq=False)
class Comparison:
    """A fixed point and the symmetric orbit next to it, at one epsilon.

    distance: of C and impact phases [rad] of both modules, Euclidean. rates: log(mu) / (epsilon 2 pi / Omega) of the
    exact multipliers, predicted: what slow flow (first four) and impact map (last four) give for the same, paired so
    that the multipliers are nearest together; both (8,) complex. multipliers, predicted_multipliers likewise.
    """

    epsilon: float
    distance: float
    multipliers: np.ndarray
    predicted_multipliers: np.ndarray
    rates: np.ndarray
    predicted: np.ndarray


def compare(system, point) -> Comparison:
    """Compare a fixed point with the nearest symmetric orbit.

    Raises:
        ValueError: the system has no symmetric orbit.
    """
    roots = symmetric_solutions(system)
    if not len(roots):
        raise ValueError("system: it has no symmetric 1:1 orbit")
    distances = [_distance(system, point, root) for root in roots]
    nearest = int(np.argmin(distances))
    exact = symmetric_orbit(system, roots[nearest]).multipliers
    slow_time = system.epsilon * system.period
    fast = np.concatenate([impact_multipliers(C, system.kappa) ** 2 for C in point.C])
    predicted = np.concatenate([np.exp(point.slow_eigenvalues * slow_time), fast])
    # Slow multipliers are predicted to second order in epsilon, fast ones to first: weighed so that both count alike.
    weights = np.repeat([1 / slow_time, 1.0], 4)
    pairs = linear_sum_assignment(weights[:, None] * np.abs(np.log(predicted[:, None] / exact)))[1]
    rates = np.concatenate([point.slow_eigenvalues, np.log(fast.astype(complex)) / slow_time])
    return Comparison(
        epsilon=system.epsilon,
        distance=distances[nearest],
        multipliers=exact[pairs],
        predicted_multipliers=predicted,
        rates=np.log(exact[pairs]) / slow_time,
        predicted=rates,
    )


def order(epsilon, errors) -> tuple[float, float]:
    """Exponent p of errors ~ epsilon^p by least squares on the logarithms, and its standard error (nan for 2 points).

    Raises:
        ValueError: fewer than 2 points.
    """
    if len(epsilon) < 2:
        raise ValueError(f"epsilon: an order needs at least 2 points, got {len(epsilon)}")
    if len(epsilon) == 2:
        return float(np.diff(np.log(errors))[0] / np.diff(np.log(epsilon))[0]), np.nan
    (slope, _), covariance = np.polyfit(np.log(epsilon), np.log(errors), 1, cov="unscaled")
    residual = np.log(errors) - np.polyval(np.polyfit(np.log(epsilon), np.log(errors), 1), np.log(epsilon))
    return float(slope), float(np.sqrt(covariance[0, 0] * np.sum(residual**2) / (len(epsilon) - 2)))


def _distance(system, point, root):
    """Euclidean distance of (C_i, impact phase at wall +1 [rad]) of a root and a fixed point."""
    phase = system.Omega * (root[:2] - impact_times(system, point))
    phase = np.angle(np.exp(1j * phase))
    return float(np.linalg.norm(np.concatenate([root[2:] - point.C, phase])))
