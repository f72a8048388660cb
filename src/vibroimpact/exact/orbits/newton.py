"""Apply Newton's method to many starting values at once, or follow one root as a parameter changes."""

from collections.abc import Callable, Iterable, Iterator

import numpy as np

_STEPS = 30
_CONVERGED, _CONVERGED_LATE = 1e-12, 1e-8
"""Relative size of a Newton step below which a start has converged: at any step, and at the last one (double roots)."""


def newton(equations, starts: np.ndarray, reach: float = 0.5) -> np.ndarray:
    """Return the roots that Newton's method reaches from `starts`, in no particular order and with repetitions.

    equations: function of k rows of values. It returns residuals, shape (k, d), and Jacobians, shape (k, d, d).
    starts: starting values of the d unknowns, one set per row, shape (n, d) or wider. Columns after the first d are
    passed to `equations` and returned unchanged.
    reach: largest modulus of a component of a step; a longer step is shortened.
    """
    x = np.array(starts, dtype=float)
    found = [np.empty((0, x.shape[1]))]
    for limit in [_CONVERGED] * (_STEPS - 1) + [_CONVERGED_LATE]:
        if not len(x):
            break
        residual, jacobian = equations(x)
        regular = np.isfinite(jacobian).all(axis=(1, 2)) & np.isfinite(residual).all(axis=1)
        regular[regular] &= np.abs(np.linalg.det(jacobian[regular])) > 0
        step = -np.linalg.solve(jacobian[regular], residual[regular, :, None])[..., 0]
        size = np.abs(step).max(axis=1, initial=0.0)
        x, unknowns = x[regular], slice(step.shape[1])
        x[:, unknowns] += step * np.minimum(1.0, reach / np.maximum(size, reach))[:, None]
        done = size < limit * (1.0 + np.abs(x[:, unknowns]).max(axis=1, initial=0.0))
        found.append(x[done])
        x = x[~done]
    return np.concatenate(found)


def follow(equations: Callable, x: np.ndarray, values: Iterable[float], near: float) -> Iterator[tuple]:
    """Yield (value, root) for each parameter value in `values`; `root` is a root of equations(value), shape (d,).

    Newton's method starts at the previous root. At the first value of the parameter, it starts at `x`. The iteration
    ends if equations(value) raises ValueError, if the method finds no root, or if a component of the root differs by
    `near` or more from the point where the method started.
    """
    for value in values:
        try:
            found = newton(equations(value), x[None])
        except ValueError:
            return
        if not len(found) or np.abs(found[0] - x).max() >= near:
            return
        x = found[0]
        yield value, x
