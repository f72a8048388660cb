"""Checks of arguments: real numbers, whole numbers and arrays of numbers, with the argument's name in the error."""

import math
import numbers

import numpy as np

MOST_SEED = 2**32 - 1
"""Largest seed of random numbers that is taken."""
_SHOWN = 60


def instance(name: str, value, kind: type):
    """Return the value, if it is of a kind.

    Raises
    ------
    ValueError
        If it is not; where it would be after `dimensionless()`, the message says so.
    """
    if not isinstance(value, kind):
        if kind.__name__ == "System" and hasattr(value, "dimensionless"):
            raise ValueError(f"{name}: a {type(value).__name__} is not a System; call .dimensionless()")
        article = "an" if kind.__name__[0] in "AEIOU" else "a"
        raise ValueError(f"{name}: {shown(value)} is not {article} {kind.__name__}")
    return value


def real(name: str, value) -> float:
    """Return a finite real number as a float; rejects str and bool.

    Raises
    ------
    ValueError
        If it is none, not finite, or beyond the range of floats.
    """
    if not isinstance(value, float) and not _is_real(value):
        raise ValueError(f"{name}: {shown(value)} is not a number")
    try:
        number = float(value)
    except OverflowError:
        raise ValueError(f"{name}: {shown(value)} is beyond the range of floats") from None
    if not math.isfinite(number):
        raise ValueError(f"{name}: {shown(value)} is not finite")
    return number


def pair(name: str, values) -> tuple[float, float]:
    """Return two finite real numbers, of a list, a tuple or an array.

    Raises
    ------
    ValueError
        If they are not.
    """
    try:
        one, two = values
    except (TypeError, ValueError):
        raise ValueError(f"{name}: {shown(values)} is not a pair of numbers") from None
    return real(name, one), real(name, two)


def whole(name: str, value, least: int, most: int) -> int:
    """Return a whole number from least to most, as an int; takes a float of such a value.

    Raises
    ------
    ValueError
        If it is none.
    """
    if not (_is_real(value) and least <= value <= most and int(value) == value):
        raise ValueError(f"{name}: {shown(value)} is not a whole number from {least} to {most}")
    return int(value)


def reals(name: str, values) -> np.ndarray:
    """Return a new float array of any shape, maybe not finite.

    Raises
    ------
    ValueError
        If it is no array of real numbers, or some of them are masked.
    """
    try:
        array = np.array(values)
    except (TypeError, ValueError):  # rows of different lengths
        array = None
    if array is not None and array.dtype == object and all(map(_is_real, array.flat)):
        array = np.array(array.tolist())  # a row of a table with columns of several types
    if array is None or array.dtype.kind not in "iuf":
        raise ValueError(f"{name}: {shown(values)} is not an array of real numbers")
    if np.ma.isMaskedArray(values) or (array.ndim > 1 and any(map(np.ma.isMaskedArray, values))):
        raise ValueError(f"{name}: a masked array; numbers that are missing cannot be used")
    return array.astype(float, copy=False)


def _is_real(value):
    return type(value) in (int, float) or (isinstance(value, numbers.Real) and not isinstance(value, bool))


def shown(value) -> str:
    """Return a value on one short line."""
    try:
        text = " ".join(repr(value).split())
    except ValueError:  # an integer with more digits than Python prints
        text = f"{type(value).__name__} of very many digits"
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 4]} ..."
