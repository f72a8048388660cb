"""Midpoints of equal cells of an interval."""

import numpy as np


def centres(interval, points: int) -> np.ndarray:
    """Divide an interval into equal cells; return the midpoints of the cells, shape (n,).

    points: number n of cells.
    """
    low, high = interval
    return low + (high - low) * (np.arange(points) + 0.5) / points
