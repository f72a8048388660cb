"""Extrapolate the end of a chatter, the limit of infinitely many impacts, from its first impacts."""

import math
from fractions import Fraction

from vibroimpact.accuracy.reference.taylor_models import to_ball


class Chatter:
    """Chatter: consecutive impacts of the same balls on the same walls, and the limit of the states after the impacts.

    The map from one impact to the next is analytic in the rebound speed. States with a rebound speed of 0 are fixed
    points of the map, with the eigenvalues kappa (for the speed) and 1 (for the other coordinates). In Koenigs'
    linearising coordinate the map is a multiplication by kappa, so that every coordinate of the state after the n-th
    impact is limit + c1 kappa^n + c2 kappa^(2n) + ... (the term c1 kappa^n is due to the geometric series of the flight
    times). Richardson extrapolation removes the powers one by one. The error after n impacts falls like
    kappa^(n^2 / 2).
    """

    def __init__(self, contacts, kappa: Fraction):
        self.contacts = contacts
        # For kappa above 1/2 only every stride-th impact is used. The ratio kappa^stride is then at most 1/2, and
        # the extrapolation amplifies rounding by less than a factor of 10.
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

        If the limit is more accurate, the attribute `change` is set to the largest difference of a coordinate between
        the new and the previous limit. In practice `change` bounds the error of the previous limit. The error of the
        new limit is much smaller.
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
