"""Certificate of a run: proofs that no impact was missed, and error estimates for the states.

The estimates assume a rounding error of one float64 epsilon at the start and at every event, and errors of the flow
tables. The variational flow propagates these errors.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine import contact
from vibroimpact.exact.engine.compiled import compiled, inlined
from vibroimpact.exact.engine.flow import advance_phase
from vibroimpact.exact.engine.margins import DOUBTS, GAP, margins_of, turning_points
from vibroimpact.exact.engine.variation import (
    AFTER,
    BEFORE,
    COLUMNS,
    FORCING,
    LENGTH,
    WALLS,
    copy,
    fill_end,
    fill_event,
    fill_flight,
    fill_rate,
    start_of,
)  # fmt: skip
from vibroimpact.system.representation import Representation, brief
from vibroimpact.system.state import IMPACT

UNIT = np.finfo(float).eps
TABLE, REBOUND = 0.15, 0.25
"""Typical rounding errors in UNIT: TABLE of an entry of the flow tables, REBOUND of the rebound velocity per unit of
approach velocity. An error that repeats adds up instead of averaging out."""


class Errors(NamedTuple):
    """Estimated errors of a state, in units of UNIT (the float64 epsilon).

    independent: covariance of independent rounding errors, shape (8, 8).
    repeated: sums of rounding errors that recur with the same value, shape (8, 6).

    Each column of `repeated` belongs to one source of errors. Columns 0 to 3 belong to rounded entries of the flow
    tables. The errors in columns 0 and 1 change the amplitude and the phase of the free motion of box 1. The errors in
    columns 2 and 3 do the same for box 2. Columns 4 and 5 belong to impacts of ball 1 and ball 2.
    """

    independent: np.ndarray
    repeated: np.ndarray


@compiled
def errors_of(flow, flights, events, limit):
    """Return the estimated errors at the start and end of each flight, and the estimated error at the end of the run.

    A run with m events has m + 1 flights. The errors of the flights have shape (m + 1, 2). An error is the square root
    of the sum of the mean square errors of all components. If the error after an event exceeds `limit`, all later
    errors are inf. A final error above `limit` is replaced by inf.
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
            copy(flights[n], part)
            _fly(flow, part, errors, matrix, product)
            estimates[n, 1] = UNIT * _root(errors)
        if n < len(events):
            _pass_event(q, flights, events, n, errors, matrix, product)
        else:
            _end(q, flights[n], 0.0, errors, product[0])
        root = _root(errors)
        if not root <= largest:  # also True if the root is nan, as after an impact with velocity 0
            return estimates, math.inf
    return estimates, UNIT * root


@compiled
def errors_at(flow, flights, events, times, limit):
    """Return the estimated errors of the states at the times `times` of a run, shape (n,).

    The errors include the effect of rounding `times`. Errors above `limit` are replaced by inf.

    times: ascending times since the start of the run, shape (n,).
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
            copy(flights[n], part)
            copy(errors.independent.flat, there.independent.flat)
            copy(errors.repeated.flat, there.repeated.flat)
            part[LENGTH] = min(max(times[k] - start, 0.0), flights[n, LENGTH])
            _fly(flow, part, there, matrix, product)
            fill_end(flow, part)
            _end(q, part, times[k], there, product[0])
            if _root(there) <= largest:
                estimates[k] = UNIT * _root(there)
            k += 1
        if last:
            break
        copy(flights[n], part)
        _fly(flow, part, errors, matrix, product)
        _pass_event(q, flights, events, n, errors, matrix, product)
        if not _root(errors) <= largest:
            break
        start += flights[n, LENGTH]
    return estimates


@inlined
def _begin(q, flight, errors):
    """Add the rounding errors of the initial state to `errors`."""
    state = flight[BEFORE:AFTER]
    # the velocity of a ball has a rounding error only if the ball is at a wall
    touching = abs(state[0] - state[4]) >= 1.0, abs(state[1] - state[5]) >= 1.0
    _add_rounding(q, errors, flight[:AFTER], state, touching)


@inlined
def _fly(flow, flight, errors, matrix, product):
    """Propagate errors over a flight, and add the rounding errors of the flow tables.

    A long flight is cut into pieces. The row `flight` is overwritten and finally describes the last piece.
    """
    left = flight[LENGTH]
    while left > 0.0:
        flight[LENGTH] = min(left, flow.longest)
        # A piece shorter than half a spacing uses only the first table entry, an identity without rounding error.
        if flight[LENGTH] > 0.5 * flow.spacing:
            _add_table(flow.coefficients, flight[BEFORE:AFTER], errors.repeated)
        fill_flight(flow, flight, matrix)
        _propagate(matrix, errors, product)
        left -= flight[LENGTH]
        if left > 0.0:
            fill_end(flow, flight)
            _add_rounding(flow.coefficients, errors, flight[:AFTER], flight[AFTER:], (False, False))
            copy(flight[AFTER:], flight[BEFORE:AFTER])
            flight[FORCING], _ = advance_phase(flight[FORCING], 0.0, flow.coefficients.omega, flight[LENGTH])


@inlined
def _pass_event(q, flights, events, n, errors, matrix, product):
    """Propagate errors over event n, and add the rounding errors of the event."""
    i, reached = int(events[n, 1]) - 1, flights[n + 1, BEFORE:AFTER]
    if events[n, 3] == IMPACT:  # the run moved the ball onto its wall by the distance `miss`
        miss = 1.0 - abs(flights[n, AFTER + i] - flights[n, AFTER + 4 + i])
        errors.independent[4 + i, 4 + i] += (miss / UNIT) ** 2
    fill_event(q, flights, events, n, matrix)
    _propagate(matrix, errors, product)
    if events[n, 3] == IMPACT:
        follows = (6 if q.epsilon <= 1.0 else 2) + i
        errors.repeated[follows, 4 + i] += REBOUND * (reached[2 + i] - reached[6 + i])
    _add_rounding(q, errors, flights[n, :AFTER], reached, (i == 0, i == 1))


@inlined
def _end(q, flight, elapsed, errors, rate):
    """Add the rounding errors of time and state to `errors`, at the end of a run or at a sample.

    elapsed: time of a sample since the start of the run; the rounding error of the sample time grows with this time. At
    the end of a run, `elapsed` is 0.
    """
    late = 2.0 / q.omega + flight[LENGTH] + elapsed
    _, _, walls = start_of(flight)
    fill_rate(q, walls, flight[AFTER:], flight[FORCING] + q.omega * flight[LENGTH], rate)
    for k in range(8):
        errors.independent[k, k] += (late * rate[k]) ** 2
    _add_rounding(q, errors, flight[:AFTER], flight[AFTER:], (False, False))


@inlined
def _propagate(matrix, errors, product):
    """Propagate errors by the linear map M = `matrix`.

    Replace C = `errors.independent` by M C M^T, and S = `errors.repeated` by M S.
    """
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
    """Write the matrix product of `a` and `b` to `product`.

    a: sparse matrix, shape (8, 8). b: matrix, shape (8, m).
    """
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
def _root(errors):
    """Return the square root of the sum of the mean square errors of all components of the state."""
    total = 0.0
    for k in range(8):
        row = errors.independent[k, k]  # one sum for each row, since the processor can compute these sums in parallel
        for j in range(errors.repeated.shape[1]):
            row += errors.repeated[k, j] ** 2
        total += row
    return math.sqrt(total)


@inlined
def _add_table(q, state, sums):
    """Add the rounding error of a flow table entry to `sums`, for a flight that starts from `state`, shape (8,)."""
    for i in range(2):  # the error scales and rotates the motion of box i in the phase plane
        x, v = state[i], state[2 + i]
        omega = math.sqrt(max(q.k11 if i == 0 else q.k22, 1.0))
        sums[i, 2 * i] += TABLE * x
        sums[2 + i, 2 * i] += TABLE * v
        sums[i, 2 * i + 1] += TABLE * v / omega
        sums[2 + i, 2 * i + 1] -= TABLE * x * omega


@inlined
def _add_rounding(q, errors, flight, state, met):
    """Add the rounding errors of `state` to `errors`.

    A state is computed as a sum of contributions. The rounding error of a contribution remains even if contributions
    cancel. The force contributes F / Omega^2 to a position, and F / Omega to a velocity. A stiff spring also
    contributes to a velocity. The velocity of a free ball is computed and rounded only at an impact.

    state: [X1, X2, X1', X2', Y1, Y2, Y1', Y2'] at the start or end of the flight, shape (8,).
    met: for each ball, True if the ball is at a wall.
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
"""Largest estimated error up to the horizon of a run; an error of this size is just visible in a printed figure."""

CLEARANCE_FACTOR = 4.0
"""An event is decided if its margin is more than CLEARANCE_FACTOR times the estimated error. True errors stay below 2.6
times the estimate."""


@dataclass(frozen=True, repr=False)
class Certificate(Representation):
    """Proof and error estimates of one run.

    Attributes
    ----------
    flights, exclusions : int
        Number of flights, and number of proofs. Each proof shows that a time interval contains no event. The proofs
        cover the whole run; otherwise `simulate` raises ArithmeticError.
    chatters : int
        Number of completed chatters (infinite sequences of impacts).
    neglected : float
        Bound on the change of the state that is neglected when chatters are completed.
    wall_residual : float
        Largest ||W| - 1| at an impact, before the ball was moved onto the wall.
    nearest_miss : float
        Smallest gap to a wall at which a ball turned back without an impact; inf if no ball turned back.
    shallowest_hit : float
        Smallest depth beyond a wall that a ball would have reached without an impact.
    clearance : float
        Smallest ratio of a margin to the estimated error of the state at the same time. A margin is the size of a state
        error that would change the sequence of events.
    undecided : int
        Number of times at which rounding decides whether an event happens, such as a grazing impact.
    error : float
        Estimated error of the final state (root mean square); inf if the run ends beyond `horizon`. The estimate
        includes a rounding error at every event.
    horizon : float
        Time tau of the first event (or of the end) after which the estimated error exceeds 1e-3, or inf if there is
        none. Beyond the horizon, the run is a possible motion of the system, but not the motion from the given initial
        state.

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
        turns = turning_points(flow, flights)
        errors, error = errors_of(flow, flights, rows, HORIZON_ERROR)
        margins, depths, doubts = margins_of(q, flights, turns, rows, phase, duration)
        known, horizon = np.isfinite(errors), np.inf
        # If the final error is inf, the horizon is the time of the first event after which the error is inf. If there
        # is no such event, the horizon is the end of the run.
        if not np.isfinite(error):
            horizon = run.tau0 + [*rows[:, 0], duration][np.count_nonzero(known[:, 0]) - 1]
        return cls(
            flights=int(counters[contact.FLIGHTS]),
            exclusions=int(counters[contact.EXCLUSIONS]),
            chatters=int(counters[contact.CHATTERS]),
            neglected=float(counters[contact.NEGLECTED]),
            wall_residual=float(counters[contact.RESIDUAL]),
            nearest_miss=float(turns[:, GAP].min()),
            shallowest_hit=float(depths.min(initial=np.inf)),
            clearance=float((margins / errors).min()) if known.all() else 0.0,
            undecided=int(counters[contact.UNDECIDED] + turns[:, DOUBTS].sum() + doubts.sum()),
            error=error,
            horizon=horizon,
        )

    def _shown(self):
        shown = ("clearance", "error", "horizon", "nearest_miss", "undecided")
        return {"decided": str(self.decided), **{name: brief(getattr(self, name)) for name in shown}}

    @property
    def decided(self) -> bool:
        """True if `undecided` is 0, `clearance` exceeds CLEARANCE_FACTOR, and the run ends before `horizon`."""
        return not self.undecided and self.clearance > CLEARANCE_FACTOR and bool(np.isfinite(self.error))
