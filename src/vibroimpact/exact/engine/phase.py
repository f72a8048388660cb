"""The forcing phase Omega tau: reduced exactly at the start of a run, carried on without loss, handed on exactly."""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from numba import types
from numba.extending import intrinsic

from vibroimpact.exact.engine.compiled import literal

TWO_PI = 2.0 * math.pi
TWO_PI_TAIL = 2.4492935982947064e-16  # 2 pi - float(2 pi)
_GUARD_BITS = 192


@dataclass(frozen=True)
class Instant:
    """The time offset + 2 pi turns, exactly, both rational: where a run ends that lasts a whole number of cycles.

    `float` gives the nearest float.
    """

    offset: Fraction
    turns: Fraction = Fraction(0)

    def later(self, cycles: int, omega: float) -> "Instant":
        """A number of periods 2 pi / omega later."""
        return Instant(self.offset, self.turns + Fraction(cycles) / Fraction(omega))

    def __float__(self):
        return float(self.offset + (self.turns and self.turns * _two_pi(_digits(self.turns))))


def exactly(tau: float | Instant) -> Instant:
    """The time that a float, or another rational number, stands for."""
    return tau if isinstance(tau, Instant) else Instant(Fraction(tau))


@lru_cache(maxsize=1024)
def phase_at(tau: float | Instant, omega: float) -> tuple[float, float]:
    """The phase omega tau modulo 2 pi, as a float in [0, 2 pi) and what it leaves out."""
    instant = exactly(tau)
    part, turns = Fraction(omega) * instant.offset, Fraction(omega) * instant.turns % 1
    two_pi = _two_pi(_digits(part))
    exact = (part + turns * two_pi) % two_pi
    phase = float(exact)
    return phase, float(exact - Fraction(phase))


def _digits(value):
    """Bits of 2 pi that leave guard bits behind the point after so many turns."""
    return _GUARD_BITS + max(math.ceil(abs(value)).bit_length(), 0)


@lru_cache(maxsize=64)
def _two_pi(bits):
    """2 pi, rounded to multiples of 2**-bits (Machin's formula)."""
    one = 1 << (bits + 16)
    return Fraction((8 * (4 * _arctan(5, one) - _arctan(239, one))) >> 16, 1 << bits)


def _arctan(inverse, one):
    """arctan(1 / inverse) in units of 1 / one, a few units off."""
    power = total = one // inverse
    k = 1
    while power:
        power //= -inverse * inverse
        k += 2
        total += power // k
    return total


@intrinsic
def _fused(_, a, b, c):
    """a b + c, rounded once."""
    signature = types.float64(types.float64, types.float64, types.float64)
    return signature, lambda context, builder, signature, arguments: builder.fma(*arguments)


QUARTER = 0.5 * math.pi
QUARTER_TAIL = 6.123233995736766e-17  # pi / 2 - float(pi / 2)
_SINE = -1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04, 2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10
_COSINE = 4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05, -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11


@literal
def sine_and_cosine(phase, tail):
    """Sine and cosine of a phase in [0, 7) and what it leaves out."""
    turns = math.floor(phase * (1.0 / QUARTER) + 0.5)
    x = _fused(-turns, QUARTER, phase)
    y = tail - turns * QUARTER_TAIL
    z = x * x
    w = z * z
    s = _fused(w, _fused(z, _SINE[5], _SINE[4]), _fused(z, _SINE[3], _SINE[2]))
    s = _fused(w, s, _fused(z, _SINE[1], _SINE[0]))
    c = _fused(w, _fused(z, _COSINE[5], _COSINE[4]), _fused(z, _COSINE[3], _COSINE[2]))
    c = _fused(w, c, _fused(z, _COSINE[1], _COSINE[0]))
    h = 0.5 * z
    one = 1.0 - h
    sine = x + (y - h * y + (z * x) * s)
    cosine = one + (((1.0 - one) - h) + (w * c - x * y))
    quarter = int(turns)
    if quarter & 1:
        sine, cosine = cosine, -sine
    return (-sine, -cosine) if quarter & 2 else (sine, cosine)


@literal
def ahead(phase, tail, omega, t):
    """The phase a time t later, not reduced; what product and sum round off goes to the tail."""
    step = omega * t
    total = phase + step
    part = total - phase
    return total, tail + ((phase - (total - part)) + (step - part) + _fused(omega, t, -step))


@literal
def reduced(phase, tail):
    """A phase a full turn less, its tail small again."""
    phase, tail = phase - TWO_PI, tail - TWO_PI_TAIL
    total = phase + tail
    part = total - phase
    return total, (phase - (total - part)) + (tail - part)
