"""The saw-tooth function that carries the impacts of the leading-order solution, (10.11)."""

import numpy as np


def sawtooth(tau0, C, theta):
    """Z = (2 C / pi) arcsin cos(tau0 - theta), (10.11); arguments broadcast (dimensionless, radians).

    Written as the triangle wave it is: arcsin loses half the digits at the peaks, where the impacts are.
    """
    from_peak = np.abs(np.remainder(np.asarray(tau0) - theta + np.pi, 2 * np.pi) - np.pi)
    return C * (1 - 2 * from_peak / np.pi)
