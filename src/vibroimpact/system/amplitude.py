"""Convert between the amplitude C of the saw-tooth Z = W - U, (10.11), and the path of a ball."""


def sawtooth_amplitude(epsilon: float, path):
    """Return the saw-tooth amplitude C of a ball that flies from one wall to the other.

    `path` is the change of the ball displacement Y during the flight. C has the sign of `path`. Its magnitude is half
    the distance that Z = -(1 + epsilon) Y covers during the flight. Both flights of a cycle have the same C.
    For a flight of half a period, C = (1 + epsilon) pi |Y'| / (2 Omega).
    """
    return (1 + epsilon) * path / 2


def path_of(epsilon: float, C):
    """Return the change of the ball displacement Y on a flight from wall to wall; C is the saw-tooth amplitude."""
    return 2 * C / (1 + epsilon)
