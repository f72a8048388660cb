"""Whether an enclosed orbit is a motion: each ball between its walls, but for the impacts, which it meets at speed.

Flights are halved until on each piece |W_i| < 1 in interval arithmetic, or, next to an impact, W_i leaves the wall or
nears it throughout. W_i is expanded to first order about the centre of a piece, the second order enclosed over it.
"""

from flint import arb

from vibroimpact.exact.orbits.proof.conditions import WALLS
from vibroimpact.exact.orbits.proof.passage import GAPS

LEGAL, ILLEGAL, NOT_PROVED = "legal", "not legal", "not proved"
_MOST = 2000  # pieces of a flight to look at


def between_walls(passage) -> str:
    """LEGAL or ILLEGAL where an EnclosedPassage proves it, else NOT_PROVED."""
    verdicts = {_of_flight(passage.rate, *flight) for flight in passage.flights()}
    return next(verdict for verdict in (ILLEGAL, NOT_PROVED, LEGAL) if verdict in verdicts)


def _of_flight(rate, start, end, state, duration):
    """Verdict on a free flight of this duration from a state (10, 1), from impact `start` to impact `end`."""
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
    """W_1, W_2 and their derivatives over a piece, and W_1, W_2 at its centre."""
    centre = (rate * (duration * ((low + high) / 2))).exp() * state
    offset = arb(0, (high - low) / 2) * duration
    around = (rate * offset).exp() * centre
    W, V, A = (GAPS * term for term in (centre, rate * centre, rate * (rate * around)))
    over = [W[i, 0] + V[i, 0] * offset + A[i, 0] * offset * offset / 2 for i in range(2)]
    return over, [V[i, 0] + A[i, 0] * offset for i in range(2)], [W[i, 0] for i in range(2)]


def _inside(i, W, V, leaving, nearing):
    """Whether ball i stays inside on a piece that starts with impact `leaving` and ends with `nearing`, or None."""
    touched = {WALLS[k]: sign for k, sign in ((leaving, -1), (nearing, 1)) if k is not None and k // 2 == i}
    return all(touched[wall] * wall * V > 0 if wall in touched else wall * W < 1 for wall in (1, -1))
