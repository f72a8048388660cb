"""Krawczyk's interval form of Newton's method: exactly one root in a box (Krawczyk 1969; Neumaier 1990)."""

import numpy as np
from flint import arb, arb_mat

_WIDEST, _NARROWEST = -4, -60  # binary exponents of the half-widths that are tried
_TIGHT = 2.0**-90
_STEPS = 20  # at most, to narrow a box: quadratic, but for the first ones


def krawczyk(equations, approximate: np.ndarray):
    """Enclosure of the only root near a float64 one, and a half-width within which there is no other; or None, 0.0.

    equations(x) returns residual (n, 1) and Jacobian (n, n) over intervals x, a list of n numbers, or None where it is
    not defined on all of them. The widest box that the test accepts is kept, its image narrowed to working precision.
    """
    centre = [arb(value) for value in approximate.tolist()]
    for exponent in range(_WIDEST, _NARROWEST, -1):
        radius = 2.0**exponent
        box = [arb(value.mid(), radius) for value in centre]
        image = _image(equations, box)
        if image is not None and all(wide.contains_interior(narrow) for wide, narrow in zip(box, image, strict=True)):
            return _narrowed(equations, image), radius
    return None, 0.0


def _image(equations, box):
    """Krawczyk's operator: every root in the box is in its image."""
    found, at = equations(box), equations([value.mid() for value in box])
    if found is None or at is None:
        return None
    try:
        inverse = at[1].mid().inv().mid()
    except ZeroDivisionError:
        return None
    size = len(box)
    contraction = arb_mat(np.eye(size).tolist()) - inverse * found[1]
    offsets = arb_mat([[value - value.mid()] for value in box])
    moved = contraction * offsets - inverse * at[0]
    return [value.mid() + moved[k, 0] for k, value in enumerate(box)]


def _narrowed(equations, box):
    for _ in range(_STEPS):
        if all(value.rad() < _TIGHT for value in box):
            break
        box = [old.intersection(new) for old, new in zip(box, _image(equations, box), strict=True)]
    return box
