"""Forcing phase Omega tau, reduced exactly at the start of a run and advanced without loss of digits."""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from numba import config, types
from numba.extending import intrinsic

from vibroimpact.exact.engine.compiled import inlined
from vibroimpact.exact.engine.lanes import LANES, Lanes, fused_lanes

TWO_PI = 2.0 * math.pi
TWO_PI_TAIL = 2.4492935982947064e-16  # 2 pi - float(2 pi)
QUARTER = 0.5 * math.pi
QUARTER_TAIL = 0.25 * TWO_PI_TAIL
SINE = tuple((-1) ** k / math.factorial(2 * k + 1) for k in range(1, 8))
COSINE = tuple((-1) ** k / math.factorial(2 * k) for k in range(2, 9))
"""Taylor coefficients of the sine from the third power on, and of the cosine from the fourth."""
_GUARD_BITS = 192


@dataclass(frozen=True)
class Instant:
    """Exact time offset + 2 pi turns with rational offset and turns, such as the end of a run.

    `float` returns the nearest float.

    Attributes
    ----------
    offset, turns : Fraction
        Terms of the time.
    reached : bool
        True if this is the end of a run, so that a run from there continues it.
    """

    offset: Fraction
    turns: Fraction = Fraction(0)
    reached: bool = False

    def later(self, cycles: int, omega: float) -> "Instant":
        """Return the time a number of periods 2 pi / omega later, as the end of a run."""
        return Instant(self.offset, self.turns + Fraction(cycles) / Fraction(omega), reached=True)

    def __float__(self):
        return float(self.offset + (self.turns and self.turns * _two_pi(_digits(self.turns))))


def exactly(tau: float | Instant) -> Instant:
    """Return the Instant of a float or another rational number."""
    return tau if isinstance(tau, Instant) else Instant(Fraction(tau))


def continues(begin: float | Instant) -> bool:
    """Return True if a run from this time continues another, so that balls at rest on a wall already stick."""
    return isinstance(begin, Instant) and begin.reached


@lru_cache(maxsize=1024)
def phase_at(tau: float | Instant, omega: float) -> tuple[float, float]:
    """Return the phase omega tau modulo 2 pi as a float in [0, 2 pi) and the remainder."""
    instant = exactly(tau)
    part, turns = Fraction(omega) * instant.offset, Fraction(omega) * instant.turns % 1
    two_pi = _two_pi(_digits(part))
    exact = (part + turns * two_pi) % two_pi
    phase = float(exact)
    return phase, float(exact - Fraction(phase))


def _digits(value):
    """Return the number of bits of 2 pi needed for guard bits behind the binary point after these turns."""
    return _GUARD_BITS + max(math.ceil(abs(value)).bit_length(), 0)


@lru_cache(maxsize=64)
def _two_pi(bits):
    """Return 2 pi, rounded to a multiple of 2**-bits (Machin's formula)."""
    one = 1 << (bits + 16)
    return Fraction((8 * (4 * _arctan(5, one) - _arctan(239, one))) >> 16, 1 << bits)


def _arctan(inverse, one):
    """Return arctan(1 / inverse) in units of 1 / one, to a few units."""
    power = total = one // inverse
    k = 1
    while power:
        power //= -inverse * inverse
        k += 2
        total += power // k
    return total


@intrinsic
def fused(_, a, b, c):
    """Return a b + c, rounded once."""
    lanes = [kind for kind in (a, b, c) if isinstance(kind, Lanes)]
    if lanes:
        return LANES(a, b, c), fused_lanes
    signature = types.float64(types.float64, types.float64, types.float64)
    return signature, lambda context, builder, signature, arguments: builder.fma(*arguments)


if config.DISABLE_JIT:

    def fused(*_):
        """Raise RuntimeError, since only compiled code rounds a b + c once."""
        raise RuntimeError("the simulation requires compiled code; unset NUMBA_DISABLE_JIT")


@inlined
def sine_and_cosine(phase, tail):
    """Return sine and cosine of a phase in [0, 2 pi] plus its remainder, to a unit in the last place.

    The Taylor series over the eighth of a turn next to the nearest quarter gives the same bits on every machine.
    """
    quarters = math.floor(phase * (1.0 / QUARTER) + 0.5)
    x, y = fused(-quarters, QUARTER, phase), tail - quarters * QUARTER_TAIL
    sine, cosine = sine_and_cosine_near(x, y)
    if int(quarters) & 1:
        sine, cosine = cosine, -sine
    return (-sine, -cosine) if int(quarters) & 2 else (sine, cosine)


@inlined
def sine_and_cosine_near(x, y):
    """Return sine and cosine of an angle within an eighth of a turn of 0, plus its remainder."""
    z = x * x
    half = 0.5 * z
    one = 1.0 - half
    sine = x + (y - half * y + (z * x) * _series(SINE, z))
    cosine = one + (((1.0 - one) - half) + ((z * z) * _series(COSINE, z) - x * y))
    return sine, cosine


@inlined
def _series(c, z):
    """Return a polynomial of degree 6, c (7,), at z; in independent pairs."""
    w = z * z
    upper = fused(w, fused(w, c[6], fused(z, c[5], c[4])), fused(z, c[3], c[2]))
    return fused(w, upper, fused(z, c[1], c[0]))


@inlined
def advance_phase(phase, tail, omega, t):
    """Return the phase a time t later, not reduced.

    Rounding errors of product and sum go to the tail.
    """
    step = omega * t
    total = phase + step
    part = total - phase
    return total, tail + ((phase - (total - part)) + (step - part) + fused(omega, t, -step))


@inlined
def reduced(phase, tail):
    """Return a phase reduced by a full turn, with its tail made small again."""
    phase, tail = phase - TWO_PI, tail - TWO_PI_TAIL
    total = phase + tail
    part = total - phase
    return total, (phase - (total - part)) + (tail - part)
