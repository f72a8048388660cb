"""Compare fixed points of the slow flow with exact orbits as epsilon tends to 0: their distance and multipliers."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from vibroimpact.accuracy.second_term import NoOrbit, offsets
from vibroimpact.exact.orbits.search import symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.theory.masri import multipliers


@dataclass(frozen=True, eq=False)
class Comparison:
    """Differences between a fixed point of the slow flow and an exact orbit near this point, at one epsilon.

    offset: coordinates of the orbit minus coordinates of the fixed point. For a symmetric orbit, the coordinates are
    the amplitude C and the impact phase [rad] of each module, shape (4,).
    multipliers: multipliers of the orbit, shape (8,) complex. Entry k is paired with `predicted_multipliers[k]`.
    predicted_multipliers: predictions of the multipliers, shape (8,) complex. The slow flow predicts the first four,
    and the impact map predicts the last four.
    rates: log(mu) / (epsilon 2 pi / Omega) for the first four multipliers mu of the orbit, shape (4,).
    predicted: eigenvalues of the slow flow, which are predictions of `rates`, shape (4,).

    If only one module is active, all arrays have half as many entries.
    """

    epsilon: float
    offset: np.ndarray
    multipliers: np.ndarray
    predicted_multipliers: np.ndarray
    rates: np.ndarray
    predicted: np.ndarray

    @property
    def distance(self) -> float:
        """Euclidean distance between the fixed point and the orbit."""
        return float(np.linalg.norm(self.offset))

    @property
    def slow_error(self) -> float:
        """Largest difference between an entry of `rates` and the eigenvalue of the slow flow that predicts it."""
        return float(np.abs(self.rates - self.predicted).max())

    @property
    def fast_error(self) -> float:
        """Largest difference between a fast multiplier of the orbit and the prediction of the impact map."""
        return float(np.abs(self.multipliers - self.predicted_multipliers)[len(self.predicted) :].max())


def distance_to_orbit(system, point) -> Comparison:
    """Compare a fixed point with the nearest symmetric orbit.

    Raises
    ------
    NoOrbit
        If the system has no symmetric orbit.
    """
    roots, part = symmetric_solutions(system), np.isfinite(point.C)
    if not len(roots):
        raise NoOrbit("the system has no symmetric 1:1 orbit")
    apart = offsets(system, point, roots)[..., part].reshape(len(roots), -1)
    nearest = np.linalg.norm(apart, axis=1).argmin()
    exact = symmetric_orbit(system, roots[nearest]).multipliers
    fast = np.concatenate([multipliers(C, system.kappa) for C in point.C[part]])
    return paired(system, apart[nearest], exact, point.slow_eigenvalues, fast)


def paired(system, offset, exact, slow, fast) -> Comparison:
    """Pair each multiplier of an exact orbit with a predicted multiplier, and return the Comparison.

    offset: as in `Comparison`.
    exact: multipliers of the orbit.
    slow: eigenvalues of the slow flow.
    fast: multipliers of the impact map over a cycle.
    """
    slow_time = system.epsilon * system.period
    predicted = np.concatenate([np.exp(slow * slow_time), fast])
    # Errors of slow multipliers are of order epsilon^2, and errors of fast ones are of order epsilon. The weights make
    # both errors comparable.
    weights = np.repeat([1 / slow_time, 1.0], len(slow))
    pairs = linear_sum_assignment(weights[:, None] * np.abs(np.log(predicted[:, None] / exact)))[1]
    return Comparison(
        epsilon=system.epsilon,
        offset=offset,
        multipliers=exact[pairs],
        predicted_multipliers=predicted,
        rates=np.log(exact[pairs[: len(slow)]]) / slow_time,
        predicted=slow,
    )


def order(epsilon, errors) -> tuple[float, float]:
    """Fit errors ~ epsilon^p by least squares; return the exponent p and the standard error of p.

    With two points, the standard error is nan.
    """
    if len(epsilon) < 2:
        raise ValueError(f"epsilon: got {len(epsilon)} values, expected at least 2 to fit an order")
    if len(epsilon) == 2:
        return float(np.diff(np.log(errors))[0] / np.diff(np.log(epsilon))[0]), np.nan
    fit, covariance = np.polyfit(np.log(epsilon), np.log(errors), 1, cov="unscaled")
    residual = np.log(errors) - np.polyval(fit, np.log(epsilon))
    return float(fit[0]), float(np.sqrt(covariance[0, 0] * np.sum(residual**2) / (len(epsilon) - 2)))
