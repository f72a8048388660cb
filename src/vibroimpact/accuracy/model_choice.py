"""List the models that can compute a figure, and compute the motion of a fixed point with each model."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from vibroimpact.accuracy import second_term
from vibroimpact.accuracy.verdict_table import partners
from vibroimpact.accuracy.window import ARITHMETICS
from vibroimpact.exact.measures.slow_variables import amplitude_and_lag
from vibroimpact.exact.orbits.search import symmetric_boxes
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.system.extras import need
from vibroimpact.theory.fixed_points.table import LabelledPoint, labelled_point, labelled_points
from vibroimpact.theory.manifold import sawtooth
from vibroimpact.theory.response import Response, impact_times, leading_order

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the dependency check)

MODELS = {
    "slow_flow": "the slow flow: leading order, (10.9) and (10.10), at a fixed point",
    "exact_orbit": "the exact symmetric orbit next to the fixed point",
    "second_term": "the slow flow with the second term of (10.7), taken from exact orbits of small epsilon",
    "float64": "simulation in double precision",
    "reference": "simulation in the reference arithmetic, confirmed with twice the digits",
}
"""Description of each model, keyed by its name in the config, in order of ascending cost.

The model slow_flow needs the solutions of (10.23); exact_orbit also needs those of the conditions of a symmetric orbit,
and second_term those of the same conditions at three values of epsilon. The model reference integrates the motion at
least twice, with more digits than float64.
"""
CHOICES = {
    "fixed_points": ("slow_flow", "exact_orbit"),
    "theoretical_response": ("slow_flow", "exact_orbit", "second_term"),
    "simulation": ARITHMETICS,
}
"""Models for a figure, keyed by the name of its notebook, in order of ascending cost."""
SAMPLES = 400
"""Samples per period from which the first harmonic of U = X + epsilon Y is computed. The n-th harmonic of U falls like
1/n^3, so that aliasing is negligible."""


@dataclass(frozen=True, eq=False)
class Motion:
    """Symmetric motion that a model gives for a fixed point.

    - impacts: one impact time tau >= 0 of each ball on the wall W = +1, shape (2,). The entry of an inactive module (a
      module that no force drives) is NaN.
    - response: function that returns U, X, W and Y at times tau of shape (n,).
    """

    point: LabelledPoint
    impacts: np.ndarray
    response: Callable[[np.ndarray], Response]


def motions(system, points: list[LabelledPoint], model: str) -> list[Motion]:
    """Return the motion that a model gives for each fixed point of a system.

    points: all fixed points of the system. All are needed, because each exact orbit is assigned to the nearest point.
    With the model exact_orbit, points without an orbit are left out.

    Raises
    ------
    ValueError
        If the model is not slow_flow, exact_orbit or second_term, or if second_term finds no orbit.
    """
    if model == "slow_flow":
        return [
            Motion(point, impact_times(system, point), lambda tau, point=point: leading_order(system, point, tau))
            for point in points
        ]
    if model == "second_term":
        return [_second_term(system, point) for point in points]
    if model == "exact_orbit":
        roots = symmetric_solutions(system)
        found = zip(points, partners([point.C for point in points], roots[:, 2:]), strict=True)
        return [_exact(system, point, roots[k]) for point, k in found if k is not None]
    raise ValueError(f"model: {model!r} should be slow_flow, exact_orbit or second_term")


def motion(system, points: pd.DataFrame, label: str, model: str) -> Motion:
    """Return the motion of the fixed point with the given label; `points` contains all fixed points.

    Raises
    ------
    ValueError
        As for `motions`, or if no motion with this label is found.
    """
    labelled_point(points, label)
    found = {one.point.label: one for one in motions(system, labelled_points(points), model)}
    if label not in found:
        raise ValueError(f"model: exact_orbit has no orbit next to fixed point {label!r}; use slow_flow")
    return found[label]


def _exact(system, point, root) -> Motion:
    """Return the motion of an exact symmetric orbit.

    root: two impact times and two amplitudes C of the orbit, shape (4,).
    """
    impacts, C = np.where(np.isfinite(point.C), root.reshape(2, 2), np.nan)
    return _motion(system, point, C, impacts, lambda tau: _exact_U(system, root, tau))


def _second_term(system, point) -> Motion:
    """Return the leading-order motion, corrected by the second term of (10.7)."""
    C, shift = second_term.first_order(system, point)
    impacts = np.remainder(impact_times(system, point) + system.epsilon * shift / system.Omega, system.period)
    near = cache(lambda epsilon: second_term.near(system, point, epsilon))

    def U(tau):
        def slope(epsilon):
            here, root = near(epsilon)
            at = tau * (system.Omega / here.Omega)
            return (_exact_U(here, root, at) - leading_order(here, point, at).U) / epsilon

        return leading_order(system, point, tau).U + system.epsilon * second_term.at_zero(slope)

    return _motion(system, point, point.C + system.epsilon * C, impacts, U)


def _motion(system, point, C, impacts, U) -> Motion:
    """Return the motion with the given U(tau), saw-tooth amplitudes C and impact times."""

    def response(tau):
        boxes, Z = U(tau), _sawtooth(system, C, impacts, tau)
        X = boxes + Z * system.epsilon / (1 + system.epsilon)
        return Response(U=boxes, X=X, W=boxes + Z, Y=-Z / (1 + system.epsilon))

    tau = np.arange(SAMPLES) * (system.period / SAMPLES)
    B, psi = np.where(np.isfinite(C), amplitude_and_lag(tau, U(tau), system.Omega), np.nan)
    return Motion(LabelledPoint(point.label, C, B, psi, point.multiple), impacts, response)


def _exact_U(system, root, tau):
    Z = _sawtooth(system, root[2:], root[:2], tau)
    return symmetric_boxes(system, root, tau) - Z * system.epsilon / (1 + system.epsilon)


def _sawtooth(system, C, impacts, tau):
    """Return the saw-tooth Z = W - U of both modules, shape (n, 2). In an inactive module, Z is 0.

    tau: times, shape (n,).
    """
    return np.nan_to_num(sawtooth(system.Omega * (tau[:, None] - impacts), C, 0.0))
