"""Extrapolate the end of a chatter, the limit of infinitely many impacts, from its first impacts."""

import math
from fractions import Fraction

from vibroimpact.accuracy.reference.taylor_models import to_ball


class Chatter:
    """Consecutive impacts of the same balls on the same walls, and the limit of the states after the impacts.

    The map from impact to impact is analytic in the rebound speed. States with the rebound speed 0 are its fixed
    points, with the eigenvalues kappa and 1. In Koenigs' linearising coordinate, the map multiplies by kappa. A
    coordinate after impact n is therefore limit + c1 kappa^n + c2 kappa^(2n) + ... Richardson extrapolation removes
    these powers. The error falls like kappa^(n^2 / 2).
    """

    def __init__(self, contacts, kappa: Fraction):
        self.contacts = contacts
        # Only every stride-th impact is used. Since kappa^stride <= 1/2, rounding is amplified less than tenfold.
        self._stride = max(1, math.ceil(math.log(2) / -math.log(kappa)))
        self._ratio = to_ball(kappa) ** self._stride
        self._impacts = 0
        self._row = []
        self.change = None

    @property
    def limit(self):
        """Extrapolated state at the end of the chatter, in the coordinates that are passed to add()."""
        return self._row[-1]

    def add(self, coordinates) -> bool:
        """Add the state after the next impact; return True if the limit is now more accurate.

        In practice, `change` then bounds the error of the previous limit.
        """
        self._impacts += 1
        if (self._impacts - 1) % self._stride:
            return False
        previous, row, power = self._row, [coordinates], self._ratio
        for column in previous:
            row.append([(new - power * old) / (1 - power) for new, old in zip(row[-1], column, strict=True)])
            power = power * self._ratio
        self._row = row
        if not previous:
            return False
        self.change = max(abs(new - old).upper() for new, old in zip(row[-1], previous[-1], strict=True))
        return True
