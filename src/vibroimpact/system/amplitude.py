"""C of a motion: the amplitude of its saw-tooth Z = W - U = -(1 + epsilon) Y, (10.11)."""


def sawtooth_amplitude(epsilon: float, path):
    """Return C of a ball that flies `path` from wall to wall: half the path of Z on a flight, the same on both.

    On a flight of half a period it is (1 + epsilon) pi |Y'| / (2 Omega). Flights of unequal length have unequal speeds
    but one amplitude.

    Parameters
    ----------
    path
        Displacement of Y from one wall to the other, any shape, dimensionless; C has its sign.
    """
    return (1 + epsilon) * path / 2


def path_of(epsilon: float, C):
    """Return the displacement of Y on a flight of the saw-tooth of amplitude C, any shape.

    This is the inverse of `sawtooth_amplitude`.
    """
    return 2 * C / (1 + epsilon)
