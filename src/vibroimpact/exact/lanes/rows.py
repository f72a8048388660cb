"""Rows of the arrays of runs in lanes: where each quantity is, and Taylor polynomials of the boxes."""

import math

from vibroimpact.exact.engine import energy
from vibroimpact.exact.engine.compiled import inlined
from vibroimpact.exact.engine.flow import NUMBERS
from vibroimpact.exact.engine.vectors import fused, load, store, where

IMPACTS, STICKS, LARGEST, PATH, INTEGRALS = 0, 2, 4, 6, 8
LOST, STORED, STATISTICS = INTEGRALS + energy.LOST, INTEGRALS + energy.STORED, INTEGRALS + energy.ENTRIES
"""Indices of the statistics of a run: for each module impacts, sticks, the largest |X_i| and the length of the ball's
path; then a row of `energy.accumulate_energy`; their number."""

X1, X2, V1, V2, Y1, Y2, U1, U2, SINE, COSINE = range(10)
Y1_LOW, Y2_LOW, PASSED, REACH, TRIAL, SIZE, LIMIT, TOUCH1, TOUCH2, DUE = range(10, 20)
PHASE, TAIL, TURNS, STOP, ALIVE, WATCHED, EVENTS, STALLED, OUTCOME, STATISTICS_AT = range(20, 30)
TURNS_AT = STATISTICS_AT + STATISTICS
SINCE, HIGHEST, KEPT, TURN = 6, 7, 8, 9
STATES = TURNS_AT + 2 * TURN
"""Rows of the runs, (STATES, 8): boxes; balls at the start of the flight; sine and cosine of the forcing phase;
remainders of the positions of the balls; time since the start of the flight, and time to its end; length of the next
step (0: begin a flight, -1: leave it to the event loop); bound on the energy of the boxes; limit for the Bernstein
coefficients; walls that the balls leave; module on a wall, or -1; phase at the start, with its tail; revolutions, and
those at which the run stops; 1 for a run; 1 if it is observed; its events; its flights without progress; result of a
pass; statistics; and, for each box, a turn that may be its largest displacement (`find_turns`): boxes and forcing at a
time near it, the approximate time from there to the turn, a bound on its displacement, and 1 if there is one."""

LOW_PARTS, SCALARS_AT = 24, 40
K11, K12, K22, GROUND, C11, C12, C22, F1, F2, OMEGA, EPSILON, KAPPA, DRIVE = range(SCALARS_AT, SCALARS_AT + 13)
IMPULSE, REST, UNIT = SCALARS_AT + 17, SCALARS_AT + 18, SCALARS_AT + 22
CA, SA, STEP, BEND, BEND_FORCE, ROUNDING, LEAST_ROUNDING, LOSS, FIRST, FIRST_TAIL, DRIFTS = (
    SCALARS_AT + NUMBERS + k for k in range(11)
)
DROPS = DRIFTS + len(energy.OBSERVED)
CONSTANTS = DROPS + 12 * len(energy.OBSERVED)
"""Rows of the constants, (CONSTANTS, 8), of each system: exp(A h) - 1, four rows of six; the remainders of its columns
for the boxes, four rows of four, since every step would repeat this error; the scalars of `flow.numbers_of`, in their
order; cos - 1 and sin of Omega h; h; B / 72 per bound on the energy and due to the force; rounding, in the same way;
loss of an impact; phase at the start; and, for each integral, its drift and the rows of its potential for both
velocities."""

LONGEST_STEP = 0.52  # times the largest rate of boxes and forcing
ORDER = next(n for n in range(1, 99) if LONGEST_STEP**n / math.factorial(n - 1) < 2.0**-53)
"""Order n of the Taylor polynomials over a time t <= LONGEST_STEP / r, where r bounds the rates of boxes and forcing.

The derivative of order n of a velocity is at most r^n E + n r^(n - 1) F, where E is the root of twice the energy of
the boxes and F the force. So the truncation error of a velocity is less than a rounding of E / n + F / r, and that of a
position is t / (n + 1) times as large.
"""
SECOND = ORDER + 1
"""First row of the polynomial of box 2 in the workspace (2 ORDER + 2, 8); that of box 1 starts at row 0."""
TERMS = 7  # terms that suffice for the time of a turn in a step


@inlined
def least(a, b):
    """Return the smaller number in each lane."""
    return where(a < b, a, b)


@inlined
def most(a, b):
    """Return the larger number in each lane."""
    return where(a > b, a, b)


@inlined
def expand(c, x1, x2, v1, v2, s, k, work):
    """Write the Taylor coefficients of both boxes, orders 0 to ORDER each."""
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
    """Return the polynomial from row `first` on and its derivative at t."""
    value, slope = load(work, first + ORDER), 0.0 * t
    for m in range(ORDER - 1, -1, -1):
        slope = fused(slope, t, value)
        value = fused(value, t, load(work, first + m))
    return value, slope
