"""Free flight in closed form: the linear flow of the boxes and the forcing phase.

Between events, the vector z = [X1, X2, X1', X2', sin, cos] obeys z' = A z; sin and cos belong to the forcing phase. A
table contains Taylor polynomials of the motion about the times j h (`jet_at`). For a time t, the nearest j h differs
from t by at most h / 2. The polynomial about this j h gives the motion at t, exact to rounding. No eigenvalues are
used, so repeated, defective, undamped and resonant spectra need no special treatment.

At the start of a run, the forcing phase Omega tau is computed exactly (`Instant`) and reduced modulo 2 pi.
"""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import inlined, inlined_source
from vibroimpact.exact.engine.flow_tables import exact_rates, tables
from vibroimpact.exact.engine.vectors import fused, to_fixed_tuple, weighted_sum

CONTACT_STATES = ((False, False), (True, False), (False, True), (True, True))
"""(ball 1 sticks, ball 2 sticks) for each contact state, in the order of the tables: index = stuck_1 + 2 stuck_2."""
STEPS_PER_UNIT = 32
LONGEST_TABLE = 8192
TWO_PI = 2.0 * math.pi
TWO_PI_TAIL = 2.4492935982947064e-16  # 2 pi - float(2 pi)
QUARTER = 0.5 * math.pi
QUARTER_TAIL = 0.25 * TWO_PI_TAIL
SINE_SERIES = tuple((-1) ** k / math.factorial(2 * k + 1) for k in range(1, 8))
COSINE_SERIES = tuple((-1) ** k / math.factorial(2 * k) for k in range(2, 9))
"""Taylor coefficients of the sine from x^3, and of the cosine from x^4."""
_GUARD_BITS = 192


class Coefficients(NamedTuple):
    """Coefficients of the equations of motion (10.2), for the compiled loops.

    ground: stiffness between box 2 and the ground.
    drive: amplitude of the force vector, |(f1, f2)|.
    growth: amplitude of the sixth derivative of the force vector, drive * omega^6.
    shift: bound on the displacement that the force causes in a period.
    mass: mass of a box with its ball.
    impulse: the factor (1 + kappa) / (1 + epsilon) as a float.
    impulse_rest: rounding remainder of `impulse`.
    """

    k11: float
    k12: float
    k22: float
    ground: float
    c11: float
    c12: float
    c22: float
    f1: float
    f2: float
    omega: float
    epsilon: float
    kappa: float
    drive: float
    growth: float
    shift: float
    mass: float
    inverse_mass: float
    impulse: float
    impulse_rest: float


class Flow(NamedTuple):
    """Coefficients and flow tables of one system.

    series: Taylor coefficients of both boxes at n times, shape (4, n, 6, 16); see `flow_tables.tables`.
    rotations: cosine and sine of the change of the forcing phase at n times, shape (n, 2).
    spacing: time step of the tables.
    density: 1 / spacing.
    longest: last time of the tables.
    unit: time unit of the system, the inverse of its fastest rate.
    rate: bound on the rate of change of the boxes in free flight, in the energy norm.
    """

    coefficients: Coefficients
    series: np.ndarray
    rotations: np.ndarray
    spacing: float
    density: float
    longest: float
    unit: float
    rate: float


SCALARS = len(Coefficients._fields)
NUMBERS = SCALARS + len(Flow._fields[3:])
"""Number of scalars that `tables_of` packs: the coefficients, and the fields of Flow that follow the arrays."""
SPACING, LONGEST, RATE, OMEGA = SCALARS, SCALARS + 2, SCALARS + 4, Coefficients._fields.index("omega")
PARAMETERS = (
    *("epsilon", "kappa", "alpha12_hat", "gamma1_hat", "gamma2_hat", "gamma12_hat"),
    *("sigma20_hat", "Omega", "f10_hat", "f20_hat"),
)


def numbers_of(systems, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the scalars of the flows of n systems, shape (n, NUMBERS), and the rate matrices from `exact_rates`.

    count: number of times in each flow table.
    """
    parameters = np.array([[getattr(system, name) for name in PARAMETERS] for system in systems])
    rates, impulses, fastest = exact_rates(parameters)
    stiff, damped = fastest.T
    k, c = -rates[:, 0, 0, 2:4, 0:2], -rates[:, 0, 0, 2:4, 2:4]
    e, kappa, omega, f1, f2 = parameters[:, [0, 1, 7, 8, 9]].T
    f1, f2, ground = e * f1, e * f2, 1.0 + e * parameters[:, 6]
    fastest = np.maximum(np.maximum(1.0, omega), np.maximum(stiff, damped))
    spacing = 2.0 ** np.floor(np.log2(1.0 / (STEPS_PER_UNIT * fastest)))  # a power of two, so its multiples are exact
    drive, longest = np.hypot(f1, f2), spacing * (count - 1)
    # `shift` bounds the displacement of a box, since sqrt(2 energy) grows by at most the time integral of the force.
    shift = drive * (2.0 * np.pi / omega) * np.maximum(1.0, 1.0 / np.sqrt(ground))
    numbers = [
        *(k[:, 0, 0], k[:, 0, 1], k[:, 1, 1], ground, c[:, 0, 0], c[:, 0, 1], c[:, 1, 1], f1, f2, omega, e, kappa),
        *(drive, drive * omega**6, shift, 1.0 + e, 1.0 / (1.0 + e), *impulses.T),
        *(spacing, 1.0 / spacing, longest, 1.0 / fastest, stiff + damped),
    ]
    return np.array(numbers).T.copy(), rates


@lru_cache(maxsize=64)
def flow_of(system) -> Flow:
    """Return the coefficients and flow tables of a system.

    The tables cover one forcing period. If a period needs more than LONGEST_TABLE times, the tables contain only the
    first LONGEST_TABLE times.
    """
    (numbers,), (rates,) = numbers_of([system], 2)
    count = min(LONGEST_TABLE, int(np.ceil(system.period / numbers[SPACING])) + 1)
    series, rotations = tables(rates, numbers[SPACING], count)
    numbers[LONGEST] = numbers[SPACING] * (count - 1)
    return Flow(Coefficients(*numbers[:SCALARS].tolist()), series, rotations, *numbers[SCALARS:].tolist())


@lru_cache(maxsize=64)
def tables_of(system) -> tuple[np.ndarray, ...]:
    """Return the Flow of a system as three arrays: (scalars, series, rotations).

    A call of a compiled function takes 1.5 us with these arrays, but 4 us with a Flow.
    """
    coefficients, series, rotations, *rest = flow_of(system)
    return np.array([*coefficients, *rest]), series, rotations


@inlined_source
def unpacked(numbers, series, rotations):
    """Return the Flow that `tables_of` packed into these arrays."""
    n = to_fixed_tuple(numbers, NUMBERS)
    return Flow(Coefficients(*n[:SCALARS]), series, rotations, *n[SCALARS:])


@inlined
def jet_at(flow, mode, boxes, sine, cosine, j):
    """Return the Taylor coefficients of both boxes about the time j * flow.spacing of a free flight.

    mode: contact state. boxes, sine, cosine: boxes and forcing phase at the start of the flight.
    """
    return weighted_sum(flow.series, mode, j, (boxes[0], boxes[1], boxes[2], boxes[3], sine, cosine))


@inlined
def acceleration(q, inverses, positions, velocities, forces):
    """Return the accelerations of both boxes.

    If the arguments are k-th derivatives of positions, velocities and forces, return the k-th derivatives of the
    accelerations.

    inverses: inverse of the moving mass of each module (`inverse_masses`).
    """
    (i1, i2), (x1, x2), (v1, v2), (s1, s2) = inverses, positions, velocities, forces
    a1 = i1 * (s1 - q.k11 * x1 - q.k12 * x2 - q.c11 * v1 - q.c12 * v2)
    a2 = i2 * (s2 - q.k12 * x1 - q.k22 * x2 - q.c12 * v1 - q.c22 * v2)
    return a1, a2


@inlined
def inverse_masses(q, mode):
    """Return 1 / (moving mass) of each module. If a ball sticks, its mass is added to the mass of its box."""
    return (q.inverse_mass if mode & 1 else 1.0), (q.inverse_mass if mode & 2 else 1.0)


@inlined
def mode_of(walls):
    """Return the index of the contact state in the flow tables, given the walls to which balls stick."""
    return (1 if walls[0] != 0 else 0) + (2 if walls[1] != 0 else 0)


@inlined
def jet(q, mode, boxes, sine, cosine):
    """Return two tuples with the Taylor coefficients X_i^(k) / k!, k = 0 to 7, of the boxes in free flight."""
    i1, i2 = inverse_masses(q, mode)
    x1, x2, v1, v2 = boxes
    fall = -q.omega * q.omega
    s, c = sine, q.omega * cosine  # the derivatives of the sine are s, c, -omega^2 s, -omega^2 c, ...
    a1, a2 = acceleration(q, (i1, i2), (x1, x2), (v1, v2), (q.f1 * s, q.f2 * s))
    b1, b2 = acceleration(q, (i1, i2), (v1, v2), (a1, a2), (q.f1 * c, q.f2 * c))
    s, c = fall * s, fall * c
    c1, c2 = acceleration(q, (i1, i2), (a1, a2), (b1, b2), (q.f1 * s, q.f2 * s))
    d1, d2 = acceleration(q, (i1, i2), (b1, b2), (c1, c2), (q.f1 * c, q.f2 * c))
    s, c = fall * s, fall * c
    e1, e2 = acceleration(q, (i1, i2), (c1, c2), (d1, d2), (q.f1 * s, q.f2 * s))
    g1, g2 = acceleration(q, (i1, i2), (d1, d2), (e1, e2), (q.f1 * c, q.f2 * c))
    return _scaled(x1, v1, a1, b1, c1, d1, e1, g1), _scaled(x2, v2, a2, b2, c2, d2, e2, g2)


@inlined
def _scaled(x, v, a, b, c, d, e, g):
    """Return the given derivatives of the orders k = 0 to 7, each divided by k!."""
    return x, v, a * (1 / 2), b * (1 / 6), c * (1 / 24), d * (1 / 120), e * (1 / 720), g * (1 / 5040)


@inlined
def value(p, t):
    """Return the value at t of the polynomial with the eight coefficients p.

    The higher terms are summed in independent pairs, because this is faster.
    """
    t2 = t * t
    upper = (p[2] + t * p[3]) + t2 * ((p[4] + t * p[5]) + t2 * (p[6] + t * p[7]))
    return p[0] + t * (p[1] + t * upper)


@inlined
def slope(p, t):
    """Return the derivative at t of the polynomial with the eight coefficients p."""
    t2 = t * t
    upper = (3.0 * p[3] + t * (4.0 * p[4])) + t2 * ((5.0 * p[5] + t * (6.0 * p[6])) + t2 * (7.0 * p[7]))
    return p[1] + t * (2.0 * p[2] + t * upper)


@inlined
def half_curvature(p, t):
    """Return half the second derivative at t of the polynomial with the eight coefficients p."""
    t2 = t * t
    return (p[2] + t * (3.0 * p[3])) + t2 * ((6.0 * p[4] + t * (10.0 * p[5])) + t2 * (15.0 * p[6] + t * (21.0 * p[7])))


@inlined
def evaluate(jets, t):
    """Return the boxes (X1, X2, X1', X2') at a short time t, from their Taylor polynomials `jets`.

    The time t may be negative.
    """
    one, two = jets
    return value(one, t), value(two, t), slope(one, t), slope(two, t)


@inlined
def rotate_phase(flow, sine, cosine, j):
    """Return sine and cosine of the forcing phase after the time j * flow.spacing."""
    ca, sa = flow.rotations[j, 0], flow.rotations[j, 1]
    return sine * ca + cosine * sa, cosine * ca - sine * sa


@inlined
def advance(flow, mode, boxes, sine, cosine, t):
    """Return ((X1, X2, X1', X2'), sine, cosine) after a free flight of duration t, 0 <= t <= flow.longest.

    sine, cosine: sine and cosine of the forcing phase.
    """
    j = int(t * flow.density + 0.5)
    r = t - j * flow.spacing
    jets = jet_at(flow, mode, boxes, sine, cosine, j)
    s, c = rotate_phase(flow, sine, cosine, j)
    angle = flow.coefficients.omega * r
    h = angle * angle  # h is below 1e-3; therefore the series for sa and ca are exact to rounding
    sa = angle * (1.0 - h * (1 / 6) * (1.0 - h * (1 / 20) * (1.0 - h * (1 / 42))))
    ca = 1.0 - h * (1 / 2) * (1.0 - h * (1 / 12) * (1.0 - h * (1 / 30)))
    return evaluate(jets, r), s * ca + c * sa, c * ca - s * sa


@dataclass(frozen=True)
class Instant:
    """Exact time offset + 2 pi * turns, for example the end of a run.

    Attributes
    ----------
    offset, turns : Fraction
        The two rational numbers in offset + 2 pi * turns.
    reached : bool
        True if this time is the end of a run. A run that starts at this time then continues that run.
    """

    offset: Fraction
    turns: Fraction = Fraction(0)
    reached: bool = False

    def later(self, cycles: int, omega: float) -> "Instant":
        """Return the end of a run that starts at this time and takes `cycles` periods 2 pi / omega."""
        return Instant(self.offset, self.turns + Fraction(cycles) / Fraction(omega), reached=True)

    def __float__(self):
        return float(self.offset + (self.turns and self.turns * _two_pi(_digits(self.turns))))


def exactly(tau: float | Instant) -> Instant:
    """Return a float or another rational number as an Instant, without rounding."""
    return tau if isinstance(tau, Instant) else Instant(Fraction(tau))


def continues(begin: float | Instant) -> bool:
    """Return True if a run that starts at the time `begin` continues another run."""
    return isinstance(begin, Instant) and begin.reached


@lru_cache(maxsize=1024)
def phase_at(tau: float | Instant, omega: float) -> tuple[float, float]:
    """Return the phase omega tau modulo 2 pi as a float in [0, 2 pi) and its rounding remainder."""
    instant = exactly(tau)
    part, turns = Fraction(omega) * instant.offset, Fraction(omega) * instant.turns % 1
    two_pi = _two_pi(_digits(part))
    exact = (part + turns * two_pi) % two_pi
    phase = float(exact)
    return phase, float(exact - Fraction(phase))


def _digits(value):
    """Return the number of binary places of 2 pi that are needed to compute value * 2 pi.

    The product then has _GUARD_BITS accurate binary places.
    """
    return _GUARD_BITS + math.ceil(abs(value)).bit_length()


@lru_cache(maxsize=64)
def _two_pi(bits):
    """Return 2 pi as a multiple of 2**-bits, by Machin's formula."""
    one = 1 << (bits + 16)
    return Fraction((8 * (4 * _arctan(5, one) - _arctan(239, one))) >> 16, 1 << bits)


def _arctan(inverse, one):
    """Return arctan(1 / inverse) multiplied by `one`, as an integer with an error of a few units."""
    power = total = one // inverse
    k = 1
    while power:
        power //= -inverse * inverse
        k += 2
        total += power // k
    return total


@inlined
def sine_and_cosine(phase, tail):
    """Return sine and cosine of phase + tail, accurate to one unit in the last place, for 0 <= phase <= 2 pi.

    The results have the same bits on every machine.
    """
    quarters = math.floor(phase * (1.0 / QUARTER) + 0.5)
    x, y = fused(-quarters, QUARTER, phase), tail - quarters * QUARTER_TAIL
    sine, cosine = sine_and_cosine_near(x, y)
    if int(quarters) & 1:
        sine, cosine = cosine, -sine
    return (-sine, -cosine) if int(quarters) & 2 else (sine, cosine)


@inlined
def sine_and_cosine_near(x, y):
    """Return sine and cosine of x + y, where |x| <= pi / 4 and y is the rounding remainder of x."""
    z = x * x
    half = 0.5 * z
    one = 1.0 - half
    sine = x + (y - half * y + (z * x) * _series(SINE_SERIES, z))
    cosine = one + (((1.0 - one) - half) + ((z * z) * _series(COSINE_SERIES, z) - x * y))
    return sine, cosine


@inlined
def _series(c, z):
    """Return the value at z of the polynomial with the seven coefficients c.

    The terms are summed in independent pairs, because this is faster.
    """
    w = z * z
    upper = fused(w, fused(w, c[6], fused(z, c[5], c[4])), fused(z, c[3], c[2]))
    return fused(w, upper, fused(z, c[1], c[0]))


@inlined
def advance_phase(phase, tail, omega, t):
    """Return the forcing phase and its rounding remainder after a time t, as (phase, tail).

    The phase is not reduced modulo 2 pi. The tail collects the rounding errors of the product omega t and of the sum.
    """
    step = omega * t
    total = phase + step
    part = total - phase
    return total, tail + ((phase - (total - part)) + (step - part) + fused(omega, t, -step))


@inlined
def reduced(phase, tail):
    """Subtract 2 pi from phase + tail; return the new (phase, tail).

    The new tail is again the rounding remainder of the phase.
    """
    phase, tail = phase - TWO_PI, tail - TWO_PI_TAIL
    total = phase + tail
    part = total - phase
    return total, (phase - (total - part)) + (tail - part)
