"""Follow an orbit over one period in interval arithmetic: flights, monodromy matrix, distances from the walls.

Entries 8 and 9 of the state are sin(Omega tau) and cos(Omega tau). A free flight over a time t is therefore a linear
map exp(A t) with a rate matrix A (10, 10). The saltation matrix is R + (A R - R A) z n^T / (n . A z). R is the
restitution matrix, n the normal of the wall, and z the state just before the impact. Impacts are numbered as in
conditions.py.
"""

from flint import arb, arb_mat

from vibroimpact.exact.orbits.proof.conditions import WALLS, identity
from vibroimpact.system.matrices import rate_matrix
from vibroimpact.system.restitution import after_impact
from vibroimpact.system.state import BALLS, BOXES, MODULES

_SIZE = 10
_DRIVEN = [*BOXES.tolist(), 8, 9]
GAPS = arb_mat([[1, -1] + [0] * 8, [0, 0, 1, -1] + [0] * 6])
"""Matrix (2, 10) that maps a state (10, 1) to W_1 and W_2."""
LEGAL, ILLEGAL, NOT_PROVED = "legal", "not legal", "not proved"
_NEAR = 1e-9
_MOST = 2000  # largest number of parts of a flight that are examined


class EnclosedPassage:
    """Enclosure of the periodic motion that belongs to a root of `EnclosedConditions`.

    unknowns: intervals that contain the root.
    phases: {number of an impact: impact time in periods}.
    speeds: {number of an impact: ball speed after the impact}.
    """

    def __init__(self, system, conditions, unknowns):
        self._conditions, self._unknowns = conditions, unknowns
        self._lags = conditions.lags(unknowns)
        self.phases = {m: unknowns[m] / conditions.period for m in conditions.impacts}
        self.speeds = {m: self._speed(m) for m in conditions.impacts}
        self._boxes = {m: conditions.before(m, unknowns, self._lags) for m in conditions.impacts}
        self._impacts = [_impact(i, conditions) for i in range(2)]
        self.rate = _rate(system)

    def flights(self):
        """Yield the flights in order of time.

        Each flight is a tuple: number of the impact at its start, number of the impact at its end, initial state, and
        duration.
        """
        order = sorted(self.phases, key=lambda m: float(self._unknowns[m].mid()))
        for m, following in zip(order, [*order[1:], order[0]], strict=True):
            yield m, following, self._impacts[m // 2] * self._before(m), self._lags[following, m]

    def states(self):
        """Yield the state at tau = 0, shape (10, 1).

        If the first impact is within 1e-9 of tau = 0, also yield the state just after this impact.
        """
        *_, (last, first, state, _) = self.flights()
        yield (self.rate * (self._conditions.period - self._unknowns[last])).exp() * state
        if abs(self._unknowns[first]) < _NEAR:
            yield self._impacts[first // 2] * self._before(first)

    def monodromy(self) -> arb_mat:
        """Return the monodromy matrix over the period that begins just before the first impact.

        The shape is (8, 8), or (4, 4) if only one module is active. If an impact may have zero relative velocity, the
        entries are not finite.
        """
        whole = identity(_SIZE)
        for m, _, after, duration in self.flights():
            impact, normal, field = self._impacts[m // 2], arb_mat([GAPS.tolist()[m // 2]]), self.rate * self._before(m)
            saltation = impact + (self.rate * after - impact * field) * normal / (normal * field)[0, 0]
            whole = (self.rate * duration).exp() * saltation * whole
        part = [place for place, module in enumerate(MODULES - 1) if module in self._conditions.modules]
        return arb_mat([[whole[row, column] for column in part] for row in part])

    def _before(self, m):
        """Return the state just before impact m, shape (10, 1)."""
        state = [arb(0)] * _SIZE
        for place, row in zip(BOXES, self._boxes[m], strict=True):
            state[place] = row[0]
        for i in self._conditions.modules:
            last = min((k for k in (2 * i, 2 * i + 1) if k != m), key=lambda k: float(self._lags[m, k].mid()))
            velocity = WALLS[last] * self.speeds[last]
            state[BALLS[i]] = self._boxes[last][i][0] - WALLS[last] + velocity * self._lags[m, last]
            state[BALLS[2 + i]] = velocity
        phase = self._conditions.boxes.omega * self._unknowns[m]
        return arb_mat([[entry] for entry in [*state[:8], phase.sin(), phase.cos()]])

    def _speed(self, k):
        """Return the speed of the ball on the flight after impact k."""
        u = self._conditions.fraction(k // 2, self._lags)
        return self._unknowns[4 + k // 2] * (1 - u if WALLS[k] == 1 else u)


def _rate(system):
    matrix = [[arb(0)] * _SIZE for _ in range(_SIZE)]
    for row, entries in zip(_DRIVEN, rate_matrix(system).tolist(), strict=True):
        for column, entry in zip(_DRIVEN, entries, strict=True):
            matrix[row][column] = arb(entry)
    for place, velocity in zip(BALLS[:2], BALLS[2:], strict=True):
        matrix[place][velocity] = arb(1)
    return arb_mat(matrix)


def _impact(i, conditions):
    matrix = identity(_SIZE).tolist()
    places = BOXES[2 + i], BALLS[2 + i]
    for column, velocities in zip(places, ((arb(1), arb(0)), (arb(0), arb(1))), strict=True):
        for row, entry in zip(places, after_impact(conditions.epsilon, conditions.kappa, *velocities), strict=True):
            matrix[row][column] = entry
    return arb_mat(matrix)


def between_walls(passage) -> str:
    """Return LEGAL or ILLEGAL if an enclosed motion is proved to be legal or illegal, else NOT_PROVED.

    In a legal motion |W_i| < 1 between impacts, and every ball hits its walls from inside.
    """
    verdicts = {_of_flight(passage.rate, *flight) for flight in passage.flights()}
    return next(verdict for verdict in (ILLEGAL, NOT_PROVED, LEGAL) if verdict in verdicts)


def _of_flight(rate, start, end, state, duration):
    """Return LEGAL, ILLEGAL or NOT_PROVED for a free flight from impact `start` to impact `end`.

    state: state at the beginning of the flight, shape (10, 1).
    """
    # The flight is divided into parts. Parts are halved until |W_i| < 1 is proved in each part. If ball i hits a wall
    # at an end of a part, it suffices for this wall to prove that W_i is monotonic in the part.
    pending = [(0.0, 1.0)]
    for _ in range(_MOST):
        if not pending:
            return LEGAL
        low, high = pending.pop()
        W, V, at_centre = _ranges(rate, state, duration, low, high)
        if any(abs(w) > 1 for w in at_centre):
            return ILLEGAL
        leaving = start if low == 0 else None
        nearing = end if high == 1 else None
        if not all(_inside(i, W[i], V[i], leaving, nearing) for i in range(2)):
            middle = (low + high) / 2
            pending += [(low, middle), (middle, high)]
    return NOT_PROVED


def _ranges(rate, state, duration, low, high):
    """Return enclosures of W_i on a part of a flight, of W_i' on this part, and of W_i at the centre of this part.

    Each of the three results is a list with one enclosure per module.
    low, high: ends of the part as fractions of the flight.
    state: state at the beginning of the flight, shape (10, 1).
    """
    centre = (rate * (duration * ((low + high) / 2))).exp() * state
    offset = arb(0, (high - low) / 2) * duration
    around = (rate * offset).exp() * centre
    W, V, A = (GAPS * term for term in (centre, rate * centre, rate * (rate * around)))
    # W_i is expanded to first order about the centre of the part. A encloses W_i'' and thus bounds the remainder.
    over = [W[i, 0] + V[i, 0] * offset + A[i, 0] * offset * offset / 2 for i in range(2)]
    return over, [V[i, 0] + A[i, 0] * offset for i in range(2)], [W[i, 0] for i in range(2)]


def _inside(i, W, V, leaving, nearing):
    """Return True if ball i is proved to stay between its walls on a part of a flight.

    leaving, nearing: numbers of the impacts at the beginning and at the end of the part, or None if there is no impact.
    """
    touched = {WALLS[k]: sign for k, sign in ((leaving, -1), (nearing, 1)) if k is not None and k // 2 == i}
    return all(touched[wall] * wall * V > 0 if wall in touched else wall * W < 1 for wall in (1, -1))
