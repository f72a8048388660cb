"""Extrapolate the state at the end of a chatter from the first impacts.

In a chatter, a ball hits the same wall infinitely often, in ever shorter flights.
"""

import math
from fractions import Fraction

from vibroimpact.accuracy.reference.taylor_models import to_ball


class Chatter:
    """Sequence of impacts in which the same balls hit the same walls, and the limit of the states after these impacts.

    The map from the state after one impact to the state after the next impact is analytic in the rebound speed. Each
    state with the rebound speed 0 is a fixed point of the map. The derivative of the map at such a state has the
    eigenvalues kappa (for the rebound speed) and 1. In Koenigs' linearising coordinate, the map is a multiplication by
    kappa. A coordinate after impact n is therefore limit + c1 kappa^n + c2 kappa^(2n) + ... Richardson extrapolation
    removes the powers of kappa one by one. The error of the extrapolated limit falls like kappa^(n^2 / 2).
    """

    def __init__(self, contacts, kappa: Fraction):
        self.contacts = contacts
        # Only every stride-th impact is used, so that kappa^stride <= 1/2. The extrapolation then amplifies rounding
        # errors by less than a factor of 10.
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

        If so, `change` is set to the largest difference between the new and the previous limit. In practice, `change`
        bounds the error of the previous limit.
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
