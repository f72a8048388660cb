"""Midpoints of equal cells of an interval, and of a plane of forces."""

import numpy as np


def centres(interval, points: int) -> np.ndarray:
    """Return the midpoints of `points` equal cells of an interval, shape (points,)."""
    low, high = interval
    return low + (high - low) * (np.arange(points) + 0.5) / points


def plane_of_forces(f10_range, f20_range, points: int) -> np.ndarray:
    """Return (f10_hat, f20_hat) at the midpoints of points x points cells, shape (points^2, 2), f20_hat fastest."""
    f10, f20 = np.meshgrid(centres(f10_range, points), centres(f20_range, points), indexing="ij")
    return np.stack([f10.ravel(), f20.ravel()], axis=1)
