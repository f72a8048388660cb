"""Convert between the amplitude C of the saw-tooth Z = W - U = -(1 + epsilon) Y, (10.11), and the path of a ball."""


def sawtooth_amplitude(epsilon: float, path):
    """Return the saw-tooth amplitude C of a ball that moves by `path` from one wall to the other.

    C is half the distance that Z covers on a flight, the same for both flights of a cycle, even if these have unequal
    durations and speeds. For a flight of half a period, C = (1 + epsilon) pi |Y'| / (2 Omega).

    Parameters
    ----------
    epsilon : float
        Mass ratio m / M.
    path : array_like
        Change of Y from one wall to the other, any shape, dimensionless. C has the sign of `path`.
    """
    return (1 + epsilon) * path / 2


def path_of(epsilon: float, C):
    """Return the change of Y on a flight of a ball with saw-tooth amplitude C, any shape.

    This is the inverse of `sawtooth_amplitude`.
    """
    return 2 * C / (1 + epsilon)
