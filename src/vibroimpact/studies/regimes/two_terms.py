"""The theory with the second term of (10.7): amplitudes, stability and folds of the motions of fixed points.

The second terms are derivatives of exact conditions by epsilon at 0. An asymptotic series is unique: that is the series
which multiple scales give.
"""

import numpy as np
from scipy.optimize import bisect

from vibroimpact.exact.orbits.impulse_response import impulse_response
from vibroimpact.studies.regimes.epsilon_limit import at_zero, first_order
from vibroimpact.studies.regimes.families import FixedPoints, SymmetricOrbits
from vibroimpact.system.verdict import STABLE, UNSTABLE
from vibroimpact.theory import criteria
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C, SYMMETRY_BREAKING_SLOPE, lower_limit

STEP = 2e-4
"""Smallest epsilon of the derivatives: two terms are then known to 1e-8."""
_FOLD_STEP, _FOLD_ERROR = 2e-3, 1e-9


def amplitudes(system, point, response=impulse_response) -> np.ndarray:
    """C_1, C_2 to the next order, shape (2,), NaN of a module that takes no part; `response` as for `first_order`.

    Raises:
        NoOrbit: no orbit is reached from the fixed point at small epsilon.
    """
    C, part = point.C.copy(), np.isfinite(point.C)
    C[part] += system.epsilon * first_order(system, point, STEP, response)[: part.sum()]
    return C


def symmetry_breaking(epsilon: float) -> float:
    """C above which a symmetric motion has lost its stability, to the next order; of every module, for every kappa."""
    return SYMMETRY_BREAKING_C + epsilon * SYMMETRY_BREAKING_SLOPE


def verdict(system, point, C) -> str:
    """ "stable" or "unstable" on both time scales, with C (2,) and its upper limit to the next order.

    The slow flow's eigenvalues are those of leading order, and so is the lower limit: there the fast time scale meets
    the slow one, and has no second term of its own.
    """
    beyond = (lower_limit(system.kappa) >= C) | (symmetry_breaking(system.epsilon) <= C)
    slow = criteria.of_fixed_point(system, point)["slow"]
    return STABLE if not beyond.any() and slow == STABLE else UNSTABLE


def fold(system, name: str, interval) -> dict[str, float]:
    """The fold along one parameter: of the fixed points, its change per epsilon, to the next order, and exact.

    Args:
        name: of the parameter. interval: a range of it in which the number of responses changes once.

    Returns "leading order", "slope", "two terms", "exact", all in the parameter; nan where the number does not change.
    """

    def of(family, at):
        def responses(p):
            return len(family.roots(at.with_(**{name: p})))

        low, high = interval
        many = responses(high)
        if responses(low) == many:
            return np.nan
        return bisect(lambda p: 1 if responses(p) == many else -1, low, high, xtol=_FOLD_ERROR)

    leading = of(FixedPoints, system)
    slope = at_zero(lambda e: (of(SymmetricOrbits, system.with_(epsilon=e)) - leading) / e, _FOLD_STEP)
    exact = of(SymmetricOrbits, system)
    return {"leading order": leading, "slope": slope, "two terms": leading + system.epsilon * slope, "exact": exact}
