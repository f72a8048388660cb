"""Row indices of the arrays for eight runs at once, and Taylor polynomials of the box positions.

Vector instructions advance eight runs together, one run in each lane. Each lane has one column in the arrays.
"""

import math

from vibroimpact.exact.engine import energy
from vibroimpact.exact.engine.compiled import inlined
from vibroimpact.exact.engine.flow import NUMBERS
from vibroimpact.exact.engine.vectors import fused, load, store, where

IMPACTS, LARGEST, PATH, INTEGRALS = 0, 2, 4, 6
LOST, STORED, STATISTICS = INTEGRALS + energy.LOSSES, INTEGRALS + energy.STORED, INTEGRALS + energy.ENTRIES
"""Indices of the statistics of a run, and their number STATISTICS. Two entries each, one per module: impacts,
largest |X_i|, length of the ball's path. From INTEGRALS on: the entries of a row of `energy.accumulate_energy`."""

X1, X2, V1, V2, Y1, Y2, U1, U2, SINE, COSINE = range(10)
Y1_LOW, Y2_LOW, PASSED, REACH, TRIAL, SIZE, LIMIT, TOUCH1, TOUCH2, DUE = range(10, 20)
PHASE, TAIL, REVOLUTIONS, STOP, ALIVE, WATCHED, EVENTS, STALLED, OUTCOME, STATISTICS_AT = range(20, 30)
TURNS_AT = STATISTICS_AT + STATISTICS
SINCE, HIGHEST, KEPT, TURN = 6, 7, 8, 9
STATES = TURNS_AT + 2 * TURN
"""Rows of the runs, (STATES, 8), one column per lane:

X1 to V2: boxes; Y1 to U2: balls at the start of the flight; SINE, COSINE: of the forcing phase
Y1_LOW, Y2_LOW: rounding remainders of the ball positions
PASSED, REACH: time since the start of the flight, and its largest value
TRIAL: length of the next step (0: begin a flight; -1: leave the run to the event loop)
SIZE: root of twice the energy of the boxes at the start of the flight
LIMIT: limit for the Bernstein coefficients
TOUCH1, TOUCH2: wall that each ball leaves, or 0; DUE: index of the module whose ball is at a wall, or -1
PHASE, TAIL, REVOLUTIONS: forcing phase at the start of the flight, its remainder, and the number of full turns
STOP: number of full turns at which the run stops; ALIVE: 1 if the lane has a run; WATCHED: 1 if the run is observed
EVENTS, STALLED: numbers of events, and of flights without progress in time
OUTCOME: state of the lane after a pass (`steps.step_to_event`); STATISTICS_AT: first row of the statistics

From TURNS_AT on, TURN rows for each box describe a turn, whose displacement may be the largest (`find_turns`): boxes
and forcing at a time near the turn (6 rows); SINCE: approximate time from these boxes to the turn; HIGHEST: bound on
the displacement; KEPT: 1 if a turn is stored.
"""

LOW_PARTS, SCALARS_AT = 24, 40
K11, K12, K22, GROUND, C11, C12, C22, F1, F2, OMEGA, EPSILON, KAPPA, DRIVE = range(SCALARS_AT, SCALARS_AT + 13)
IMPULSE, REST, UNIT = SCALARS_AT + 17, SCALARS_AT + 18, SCALARS_AT + 22
CA, SA, STEP, BEND, BEND_FORCE, ROUNDING, LEAST_ROUNDING, LOSS, FIRST, FIRST_TAIL, DRIFTS = (
    SCALARS_AT + NUMBERS + k for k in range(11)
)
DROPS = DRIFTS + len(energy.OBSERVED)
CONSTANTS = DROPS + 12 * len(energy.OBSERVED)
"""Rows of the constants, (CONSTANTS, 8), one column per lane, for the system of the run in the lane:

from 0: exp(A h) - 1 for a step h, four rows of six
LOW_PARTS: rounding remainders of exp(A h) - 1 in the columns for the boxes, four rows of four; without the remainders,
    rounding errors would add up
SCALARS_AT: scalars of `flow.numbers_of`, in their order
CA, SA: cos - 1 and sin of Omega h; STEP: h
BEND, BEND_FORCE: BEND times the root of twice the energy, plus BEND_FORCE, is a bound on (fourth derivative of a box
    displacement) / 72
ROUNDING, LEAST_ROUNDING: ROUNDING times the root of twice the energy, plus LEAST_ROUNDING, is a bound on rounding
    errors, without the part due to ball velocities
LOSS: energy loss of an impact divided by its squared relative velocity
FIRST, FIRST_TAIL: phase at the start of the run, and its remainder
DRIFTS: drift c of each integral (`energy.Squares`)
DROPS: for each integral, the two rows of its matrix S (`energy.Squares`) for the velocities of the boxes
"""

LONGEST_STEP = 0.52  # longest step of a lane, in units of 1 / (largest rate of boxes and forcing)
ORDER = next(n for n in range(1, 99) if LONGEST_STEP**n / math.factorial(n - 1) < 2.0**-53)
"""Order n of the Taylor polynomials over a time t <= LONGEST_STEP / r, where r bounds the rates of boxes and forcing.

The derivative of order n of a velocity is at most r^n E + n r^(n - 1) F, where E is the root of twice the energy of
the boxes and F the force. The truncation error of a velocity is therefore below the rounding error of E / n + F / r,
and the truncation error of a position is t / (n + 1) times as large.
"""
SECOND = ORDER + 1
"""First row of the polynomial of box 2 in the workspace (2 ORDER + 2, 8); the polynomial of box 1 starts at row 0."""
TERMS = 7  # number of Taylor terms that suffice to find the time at which a box reverses its motion


@inlined
def least(a, b):
    """Return the smaller of the numbers a and b in each lane."""
    return where(a < b, a, b)


@inlined
def most(a, b):
    """Return the larger of the numbers a and b in each lane."""
    return where(a > b, a, b)


@inlined
def expand(c, x1, x2, v1, v2, s, k, work):
    """Write the Taylor coefficients of both box positions, from order 0 to ORDER, to `work`.

    c: constants of the systems. x1, x2, v1, v2: positions and velocities of the boxes. s, k: sine and cosine of the
    forcing phase.
    """
    omega = load(c, OMEGA)
    store(work, 0, x1)
    store(work, 1, v1)
    store(work, SECOND, x2)
    store(work, SECOND + 1, v2)
    f1, f2, g1, g2 = load(c, F1) * s, load(c, F2) * s, load(c, F1) * (omega * k), load(c, F2) * (omega * k)
    k11, k12, k22, fall = -load(c, K11), -load(c, K12), -load(c, K22), -(omega * omega)
    c11, c12, c22 = load(c, C11), load(c, C12), load(c, C22)
    for m in range(2, ORDER + 1):
        over = 1.0 / (m * (m - 1.0))
        a1 = fused(1.0 - m, fused(c11, v1, c12 * v2), fused(k11, x1, fused(k12, x2, f1)))
        a2 = fused(1.0 - m, fused(c12, v1, c22 * v2), fused(k12, x1, fused(k22, x2, f2)))
        x1, x2, v1, v2 = v1, v2, a1 * over, a2 * over
        f1, f2, g1, g2 = g1, g2, f1 * (fall * over), f2 * (fall * over)
        store(work, m, v1)
        store(work, SECOND + m, v2)


@inlined
def evaluate(work, first, t):
    """Return the value and the derivative of a polynomial at t.

    The coefficients of the polynomial are in the rows of `work` from row `first` on.
    """
    value, slope = load(work, first + ORDER), 0.0 * t
    for m in range(ORDER - 1, -1, -1):
        slope = fused(slope, t, value)
        value = fused(value, t, load(work, first + m))
    return value, slope
