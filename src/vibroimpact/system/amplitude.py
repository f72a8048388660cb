"""Amplitude C of the saw-tooth Z = W - U = -(1 + epsilon) Y of a motion, (10.11)."""


def sawtooth_amplitude(epsilon: float, path):
    """Return the amplitude C of a ball that moves by `path` from wall to wall.

    C is half the path of Z on a flight, which is the same for both flights. For a flight of half a period, C = (1 +
    epsilon) pi |Y'| / (2 Omega). Flights of unequal length have unequal speeds but one amplitude.

    Parameters
    ----------
    epsilon : float
        Mass ratio m / M.
    path : array_like
        Displacement of Y from one wall to the other, any shape, dimensionless; C has its sign.
    """
    return (1 + epsilon) * path / 2


def path_of(epsilon: float, C):
    """Return the displacement of Y on a flight of the saw-tooth of amplitude C, any shape.

    This is the inverse of `sawtooth_amplitude`.
    """
    return 2 * C / (1 + epsilon)
