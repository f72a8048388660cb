"""Certificate of a run: proofs that no impact was missed, and error estimates of its states.

Rounding errors are estimated by a unit error at the start and after every event, propagated by the variational flow.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine import contact
from vibroimpact.exact.engine.compiled import compiled, inlined, inlined_source
from vibroimpact.exact.engine.flow import advance_phase
from vibroimpact.exact.engine.margins import DEPTH, DOUBT, DOUBTS, GAP, hits_of, margins_of, turning_points
from vibroimpact.exact.engine.variation import (
    AFTER,
    BEFORE,
    COLUMNS,
    FORCING,
    LENGTH,
    WALLS,
    fill_event,
    fill_flight,
    fill_rate,
    land,
    start_of,
)  # fmt: skip
from vibroimpact.system.representation import Representation, brief
from vibroimpact.system.state import IMPACT

UNIT = np.finfo(float).eps
TABLE, REBOUND = 0.15, 0.25
"""Typical rounding, in units, of an entry of the flow tables, and of restitution times approach. A rounding that
repeats (the same entry is read again, or kappa is close to 1) adds up instead of averaging out."""


class Errors(NamedTuple):
    """Estimated errors of a state in units of rounding.

    independent: covariance (8, 8) of independent roundings. repeated: sums (8, 6) of roundings that are equal each
    time, one column for each source: growth and rotation of either box by the tables, rebound of either ball.
    """

    independent: np.ndarray
    repeated: np.ndarray


@compiled
def errors_of(flow, flights, events, limit):
    """Return estimated errors at the start and end of every flight, rows (m + 1, 2), and of the final state.

    An error is the root mean square over the whole state. It is inf from the first event (or the end) on after which it
    exceeds the limit.
    """
    q = flow.coefficients
    estimates, largest = np.full((len(flights), 2), math.inf), limit / UNIT
    errors = Errors(np.zeros((8, 8)), np.zeros((8, 6)))
    matrix, product, part = np.empty((8, 8)), np.empty((8, 8)), np.empty(COLUMNS)
    _begin(q, flights[0], errors)
    root = _root(errors)
    for n in range(len(flights)):
        estimates[n, 0] = estimates[n, 1] = UNIT * root
        if flights[n, LENGTH] > 0.0:
            _copy(flights[n], part)
            _fly(flow, part, errors, matrix, product)
            estimates[n, 1] = UNIT * _root(errors)
        if n < len(events):
            _pass(q, flights, events, n, errors, matrix, product)
        else:
            _end(q, flights[n], 0.0, errors, product[0])
        root = _root(errors)
        if not root <= largest:  # also for nan, from an impact without velocity
            return estimates, math.inf
    return estimates, UNIT * root


@compiled
def errors_at(flow, flights, events, times, limit):
    """Return estimated errors (n,) of the states at ascending times since the start.

    Each is the error that `errors_of` gives for a run that ends at this time.
    """
    q = flow.coefficients
    estimates, largest, start, k = np.full(len(times), math.inf), limit / UNIT, 0.0, 0
    errors = Errors(np.zeros((8, 8)), np.zeros((8, 6)))
    there = Errors(np.zeros((8, 8)), np.zeros((8, 6)))
    matrix, product, part = np.empty((8, 8)), np.empty((8, 8)), np.empty(COLUMNS)
    _begin(q, flights[0], errors)
    for n in range(len(flights)):
        last = n == len(events)
        while k < len(times) and (last or times[k] < start + flights[n, LENGTH]):
            _copy(flights[n], part)
            _copy(errors.independent.flat, there.independent.flat)
            _copy(errors.repeated.flat, there.repeated.flat)
            part[LENGTH] = min(max(times[k] - start, 0.0), flights[n, LENGTH])
            _fly(flow, part, there, matrix, product)
            land(flow, part)
            _end(q, part, times[k], there, product[0])
            if _root(there) <= largest:
                estimates[k] = UNIT * _root(there)
            k += 1
        if last:
            break
        _copy(flights[n], part)
        _fly(flow, part, errors, matrix, product)
        _pass(q, flights, events, n, errors, matrix, product)
        if not _root(errors) <= largest:
            break
        start += flights[n, LENGTH]
    return estimates


@inlined
def _begin(q, flight, errors):
    """Add to errors the rounding of the initial state, including the velocity of a ball put on a wall."""
    state = flight[BEFORE:AFTER]
    touching = abs(state[0] - state[4]) >= 1.0, abs(state[1] - state[5]) >= 1.0
    _add_rounding(q, errors, flight[:AFTER], state, touching)


@inlined
def _fly(flow, flight, errors, matrix, product):
    """Propagate errors over a flight, adding the rounding of the tables at each end of a piece.

    The row of the flight is replaced by its last piece.
    """
    left = flight[LENGTH]
    while left > 0.0:
        flight[LENGTH] = min(left, flow.longest)
        if flight[LENGTH] > 0.5 * flow.spacing:  # the first entry is the identity, without rounding
            _add_table(flow.coefficients, flight[BEFORE:AFTER], errors.repeated)
        fill_flight(flow, flight, matrix)
        _carry(matrix, errors, product)
        left -= flight[LENGTH]
        if left > 0.0:
            land(flow, flight)
            _add_rounding(flow.coefficients, errors, flight[:AFTER], flight[AFTER:], (False, False))
            _copy(flight[AFTER:], flight[BEFORE:AFTER])
            flight[FORCING], _ = advance_phase(flight[FORCING], 0.0, flow.coefficients.omega, flight[LENGTH])


@inlined
def _pass(q, flights, events, n, errors, matrix, product):
    """Propagate errors over event n, adding a rounding."""
    _add_miss(errors.independent, flights[n], events[n])
    fill_event(q, flights, events, n, matrix)
    _carry(matrix, errors, product)
    i, reached = int(events[n, 1]) - 1, flights[n + 1, BEFORE:AFTER]
    if events[n, 3] == IMPACT:
        follows = (6 if q.epsilon <= 1.0 else 2) + i
        errors.repeated[follows, 4 + i] += REBOUND * (reached[2 + i] - reached[6 + i])
    _add_rounding(q, errors, flights[n, :AFTER], reached, (i == 0, i == 1))


@inlined
def _end(q, flight, elapsed, errors, rate):
    """Add to errors at the end of a run, or at a sample, the error of the time and the rounding of the state."""
    _add_lateness(q, errors.independent, flight, elapsed, rate)
    _add_rounding(q, errors, flight[:AFTER], flight[AFTER:], (False, False))


@inlined
def _carry(matrix, errors, product):
    """Replace errors by their product with a matrix M, and a covariance C by M (M C)^T."""
    covariance, sums = errors.independent, errors.repeated
    _multiply(matrix, covariance, product)
    for i in range(8):
        for j in range(i):
            product[i, j], product[j, i] = product[j, i], product[i, j]
    _multiply(matrix, product, covariance)
    _multiply(matrix, sums, product)
    for i in range(8):
        for j in range(sums.shape[1]):
            sums[i, j] = product[i, j]


@inlined
def _multiply(a, b, product):
    """Fill in the product of a sparse matrix (8, 8) and vectors (8, m)."""
    columns = b.shape[1]
    for i in range(8):
        for j in range(columns):
            product[i, j] = 0.0
        for k in range(8):
            weight = a[i, k]
            if weight != 0.0:
                for j in range(columns):
                    product[i, j] += weight * b[k, j]


@inlined
def _copy(source, target):
    """Copy entries one by one; an array assignment would make Numba compile an error message for 2 s."""
    for i in range(len(source)):
        target[i] = source[i]


@inlined
def _root(errors):
    """Return the root mean square of errors over the whole state."""
    total = 0.0
    for k in range(8):
        row = errors.independent[k, k]  # separate rows, which the processor can add in parallel
        for j in range(errors.repeated.shape[1]):
            row += errors.repeated[k, j] ** 2
        total += row
    return math.sqrt(total)


@inlined_source
def _add_miss(covariance, flight, event):
    """Add to a covariance before an impact the distance by which the ball was moved onto its wall."""
    if event[3] == IMPACT:
        i = int(event[1]) - 1
        miss = 1.0 - abs(flight[AFTER + i] - flight[AFTER + 4 + i])
        covariance[4 + i, 4 + i] += (miss / UNIT) ** 2


@inlined
def _add_lateness(q, covariance, flight, elapsed, rate):
    """Add the effect of a rounding error in the duration to the covariance at the end of a flight.

    The end of a run and its sample times are differences: of phases since the start of the last cycle, and of elapsed
    times (`elapsed` = 0: only the phase counts).
    """
    late = 2.0 / q.omega + flight[LENGTH] + elapsed
    _, _, walls = start_of(flight)
    fill_rate(q, walls, flight[AFTER:], flight[FORCING] + q.omega * flight[LENGTH], rate)
    for k in range(8):
        covariance[k, k] += (late * rate[k]) ** 2


@inlined
def _add_table(q, state, sums):
    """Add the rounding of a table entry to sums before a flight from a state (8,).

    Each box grows and rotates by this rounding.
    """
    for i in range(2):
        x, v = state[i], state[2 + i]
        omega = math.sqrt(max(q.k11 if i == 0 else q.k22, 1.0))
        sums[i, 2 * i] += TABLE * x
        sums[2 + i, 2 * i] += TABLE * v
        sums[i, 2 * i + 1] += TABLE * v / omega
        sums[2 + i, 2 * i + 1] -= TABLE * x * omega


@inlined
def _add_rounding(q, errors, flight, state, met):
    """Add a unit rounding error of a state (8,), [boxes, balls], at the end of a flight (row up to its start).

    A flight adds up the effect of the force, F / Omega^2 for a position and F / Omega for a velocity, and rounds it in
    absolute terms even if it cancels later. The same holds for the velocities due to a stiff spring. The velocity of a
    free ball is only computed at an impact.
    """
    covariance, began = errors.independent, flight[BEFORE:]
    speed = q.drive / max(1.0, q.omega)
    place = speed / max(1.0, q.omega)
    farthest = max(abs(began[0]), abs(state[0])) + max(abs(began[1]), abs(state[1]))
    speed += (math.sqrt(max(q.k11, q.k22, 1.0)) - 1.0) * farthest
    for k in range(8):
        swing = 0.0 if k > 3 else (place if k < 2 else speed)
        if k < 6 or met[k - 6] or flight[WALLS + k - 6] != 0.0:
            covariance[k, k] += (1.0 + abs(state[k]) + swing) ** 2


HORIZON_ERROR = 1e-3
"""Estimated error at the horizon of a run; a printed figure can show such an error."""

CLEARANCE_FACTOR = 4.0
"""An event is decided if its margin exceeds the estimated error by this factor; true errors stay below 2.6 times the
estimate."""


@dataclass(frozen=True, repr=False)
class Certificate(Representation):
    """Proof and error estimates of one run.

    Attributes
    ----------
    flights, exclusions : int
        Number of flights, and of proofs that nothing happens over an interval. Proofs cover every instant of the run;
        otherwise the run raises an error.
    chatters : int
        Number of infinite sequences of impacts that were completed.
    neglected : float
        Bound on the change of the state by completing them.
    wall_residual : float
        Largest ||W| - 1| at an impact before it was set to zero.
    nearest_miss : float
        Smallest gap at which a ball turned before a wall, in that half of its box; inf if none did.
    shallowest_hit : float
        Smallest depth that an impact prevented.
    clearance : float
        Smallest ratio of a distance from a change of the event sequence to the estimated error at that time. Distances
        are the two above, the contact forces of sticking and released balls, and the distances of events from the start
        and the end of the run.
    undecided : int
        Number of turns and impacts that cannot be distinguished within rounding.
    error : float
        Estimated error of the final state (root mean square), from unit roundings after every event propagated by the
        variational flow; inf beyond the horizon.
    horizon : float
        Time tau of the first event, or end, at which this estimate exceeds 1e-3; inf if it never does. Beyond it the
        trajectory is a possible motion of the system, but not the one from this initial state.

    Notes
    -----
    docs/engine.md explains the proofs and the estimates.

    Examples
    --------
    >>> run = vi.simulate(system, [0.0] * 8, cycles=100)
    >>> run.certificate.decided
    True
    """

    flights: int
    exclusions: int
    chatters: int
    neglected: float
    wall_residual: float
    nearest_miss: float
    shallowest_hit: float
    clearance: float
    undecided: int
    error: float
    horizon: float

    @classmethod
    def of(cls, run) -> "Certificate":
        """Return the certificate of a finished run."""
        counters, (flow, flights, rows) = run.counters, run.trajectory
        q, phase, duration = flow.coefficients, flights[0, FORCING], run.cycles * run.system.period
        turns, hits = turning_points(flow, flights), hits_of(q, flights, rows)
        errors, error = errors_of(flow, flights, rows, HORIZON_ERROR)
        margins = margins_of(q, flights, turns, hits, rows, phase, duration)
        return cls(
            flights=int(counters[contact.FLIGHTS]),
            exclusions=int(counters[contact.EVALUATIONS]),
            chatters=int(counters[contact.CHATTERS]),
            neglected=float(counters[contact.NEGLECTED]),
            wall_residual=float(counters[contact.RESIDUAL]),
            nearest_miss=float(turns[:, GAP].min()),
            shallowest_hit=float(hits[:, DEPTH].min(initial=np.inf)),
            clearance=_least_ratio(margins, errors),
            undecided=int(counters[contact.UNDECIDED] + turns[:, DOUBTS].sum() + hits[:, DOUBT].sum()),
            error=error,
            horizon=run.tau0 + _horizon(errors, error, rows[:, 0], duration),
        )

    def _shown(self):
        shown = ("clearance", "error", "horizon", "nearest_miss", "undecided")
        return {"decided": str(self.decided), **{name: brief(getattr(self, name)) for name in shown}}

    @property
    def decided(self) -> bool:
        """True if the margin of every event exceeds the estimated error by CLEARANCE_FACTOR, to the end of the run."""
        return not self.undecided and self.clearance > CLEARANCE_FACTOR and bool(np.isfinite(self.error))


def _least_ratio(margins, errors):
    """Return the smallest ratio of a margin to its error; 0 beyond the horizon."""
    known = np.isfinite(errors)
    return float((margins[known] / errors[known]).min()) if known.all() else 0.0


def _horizon(errors, error, times, duration):
    """Return the time of the first event, or the end, at which the estimated error is infinite."""
    if np.isfinite(error):
        return np.inf
    return [*times, duration][np.count_nonzero(np.isfinite(errors[:, 0])) - 1]
