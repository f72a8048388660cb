"""Midpoints of equal cells of an interval."""

import numpy as np


def centres(interval, points: int) -> np.ndarray:
    """Return the midpoints of `points` equal cells of an interval, shape (points,)."""
    low, high = interval
    return low + (high - low) * (np.arange(points) + 0.5) / points
