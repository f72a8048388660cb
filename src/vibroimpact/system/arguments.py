"""Validate arguments (real numbers, integers, arrays, instances), with error messages that name the argument."""

import math
import numbers

import numpy as np

MOST_SEED = 2**32 - 1
"""Largest seed accepted for random numbers."""
_LONGEST = 60  # Error messages shorten values that have more characters.


def instance(name: str, value, kind: type):
    """Return the value if it is an instance of the class `kind`.

    Raises
    ------
    ValueError
        If `value` has another type.
    """
    if not isinstance(value, kind):
        if kind.__name__ == "System" and hasattr(value, "dimensionless"):
            raise ValueError(f"{name}: a {type(value).__name__} is not a System; call .dimensionless()")
        article = "an" if kind.__name__[0] in "AEIOU" else "a"
        raise ValueError(f"{name}: {short_repr(value)} is not {article} {kind.__name__}")
    return value


def real(name: str, value) -> float:
    """Return a finite real number as a float; text and truth values are rejected.

    Raises
    ------
    ValueError
        If the value is not such a number.
    """
    if not isinstance(value, float) and not _is_real(value):
        raise ValueError(f"{name}: {short_repr(value)} is not a number")
    try:
        number = float(value)
    except OverflowError:
        raise ValueError(f"{name}: {short_repr(value)} is beyond the range of floats") from None
    if not math.isfinite(number):
        raise ValueError(f"{name}: {short_repr(value)} is not finite")
    return number


def positive(name: str, value) -> float:
    """Return a finite number above 0 as a float.

    Raises
    ------
    ValueError
        If the value is not such a number.
    """
    number = real(name, value)
    if number <= 0:
        raise ValueError(f"{name}: {number} is not above 0")
    return number


def pair(name: str, values) -> tuple[float, float]:
    """Return a pair of numbers (list, tuple or array) as floats.

    Raises
    ------
    ValueError
        If the argument is not a pair of finite real numbers.
    """
    try:
        one, two = values
    except (TypeError, ValueError):
        raise ValueError(f"{name}: {short_repr(values)} is not a pair of numbers") from None
    return real(name, one), real(name, two)


def whole(name: str, value, least: int, most: int) -> int:
    """Return a whole number from `least` to `most` as an int; floats such as 2.0 are accepted.

    Raises
    ------
    ValueError
        If the value is not such a number.
    """
    if not (_is_real(value) and least <= value <= most and int(value) == value):
        raise ValueError(f"{name}: {short_repr(value)} is not a whole number from {least} to {most}")
    return int(value)


def reals(name: str, values) -> np.ndarray:
    """Return `values` as a new float array of any shape; entries may be infinite or nan.

    Raises
    ------
    ValueError
        If `values` is masked, or is not an array of real numbers.
    """
    try:
        array = np.array(values)
    except (TypeError, ValueError):  # the rows have different lengths
        array = None
    if array is not None and array.dtype == object and all(map(_is_real, array.flat)):
        array = np.array(array.tolist())  # Numbers from a table row can have dtype object.
    if array is None or array.dtype.kind not in "iuf":
        raise ValueError(f"{name}: {short_repr(values)} is not an array of real numbers")
    if np.ma.isMaskedArray(values) or (array.ndim > 1 and any(map(np.ma.isMaskedArray, values))):
        raise ValueError(f"{name}: masked arrays are not supported")
    return array.astype(float, copy=False)


def _is_real(value):
    return type(value) in (int, float) or (isinstance(value, numbers.Real) and not isinstance(value, bool))


def short_repr(value) -> str:
    """Return the repr of a value on one short line."""
    try:
        text = " ".join(repr(value).split())
    except ValueError:  # `value` is an integer with more digits than Python prints
        text = f"{type(value).__name__} with too many digits to print"
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 4]} ..."
