"""Convert between the amplitude C of the saw-tooth Z = W - U = -(1 + epsilon) Y, (10.11), and the path of a ball."""


def sawtooth_amplitude(epsilon: float, path):
    """Return the saw-tooth amplitude C of a ball that moves by `path` from one wall to the other.

    C is half the distance that the saw-tooth Z = -(1 + epsilon) Y covers on a flight. Both flights of a cycle have the
    same C, even if their durations and speeds differ. For a flight of half a period,
    C = (1 + epsilon) pi |Y'| / (2 Omega).

    Parameters
    ----------
    epsilon : float
        Mass ratio m / M.
    path : array_like
        Change of Y from one wall to the other, any shape, dimensionless. C has the sign of `path`.
    """
    return (1 + epsilon) * path / 2


def path_of(epsilon: float, C):
    """Return the change of the ball displacement Y on a flight from wall to wall, for amplitudes C of any shape.

    This is the inverse of `sawtooth_amplitude`.
    """
    return 2 * C / (1 + epsilon)
