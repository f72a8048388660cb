"""The amplitude at which asymmetric motions leave symmetric ones: closed form at finite epsilon, and its slope."""

import numpy as np
import pytest
import sympy
from scipy.optimize import brentq

from chapter import system_of
from vibroimpact.exact.orbits.search import half_period_multipliers, symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C

SLOPE = np.pi**2 * (np.pi**2 - 12) / (np.pi**2 - 4) ** 2
"""Derivative of the amplitude with respect to epsilon at 0 (docs/derivation.md, section 13)."""


def C_at_breaking(epsilon, omega, rates, start, half, pi):
    """Return C of a single module, by the steady response Q of its box to one unit impulse per period T.

    Q(s) is the sum of (e^(rs) / (1 - e^(rT))) / (r - r') over both rates r; `start` and `half` return epsilon times
    the term in brackets at s = 0 and T/2. With impacts at -uT/2 and uT/2 of strength I, u = (1 - v)/2, and a forced
    motion A sin + B cos of the box, the sum of Newton's rules and the distance from wall to wall are

        2 Omega A sin(pi v/2) + epsilon I (Q'(T - uT) - Q'(uT)) = v I,
        (1 - v^2) I T/4 = 2 + 2 A cos(pi v/2) + epsilon I (2 Q(0) - Q(uT) - Q(T - uT)),

    without kappa, B and the force. The first, divided by v, is pi Omega A = I (1 - epsilon T Q''(T/2)) at v = 0.
    """
    period, (plus, minus) = 2 * pi / omega, rates
    at_start = (start(plus) - start(minus)) / (plus - minus)
    at_half = (half(plus) - half(minus)) / (plus - minus)
    bend = (plus**2 * half(plus) - minus**2 * half(minus)) / (plus - minus)
    distance = period / 4 - 2 * (1 - period * bend) / (pi * omega) - 2 * (at_start - at_half)
    return (1 + epsilon) * period / 4 / distance


def test_the_slope_by_computer_algebra():
    """The slope is the same for any damping and detuning, with rates i + a epsilon + b epsilon^2 and a second pair.

    With rT = 2 pi i + epsilon w, epsilon / (1 - e^(rT)) is -(1 - epsilon w/2) / w, and 1 / w half a period later, up to
    epsilon^2.
    """
    epsilon, sigma, a, b, c, d = sympy.symbols("epsilon sigma a b c d")
    omega = 1 + epsilon * sigma
    rates = sympy.I + epsilon * a + epsilon**2 * b, -sympy.I + epsilon * c + epsilon**2 * d

    def w(rate):
        return sympy.cancel(2 * sympy.pi * (rate - rate.subs(epsilon, 0) * omega) / (epsilon * omega))

    C = C_at_breaking(epsilon, omega, rates, lambda r: -1 / w(r) + epsilon / 2, lambda r: 1 / w(r), sympy.pi)
    assert sympy.simplify(C.subs(epsilon, 0)) == sympy.pi**2 / (sympy.pi**2 - 4)
    slope = sympy.simplify(sympy.diff(C, epsilon).subs(epsilon, 0))
    assert not slope.free_symbols
    assert float(slope) == pytest.approx(SLOPE, rel=1e-14)
    assert float(C.subs(epsilon, 0).simplify()) == pytest.approx(SYMMETRY_BREAKING_C, rel=1e-14)


@pytest.mark.parametrize("kappa", [0.4, 0.65])
def test_a_half_period_multiplier_of_exact_orbits_is_minus_one_at_the_closed_form(kappa):
    """The force on the second of two uncoupled modules is varied, at epsilon = 0.1."""

    def orbit(force):
        system = system_of("equal", alpha12_hat=0, gamma12_hat=0, sigma20_hat=0, kappa=kappa, f20_hat=force)
        return symmetric_orbit(system, max(symmetric_solutions(system), key=lambda root: root[2:].min()))

    found = orbit(brentq(lambda force: np.prod(1 + half_period_multipliers(orbit(force))).real, 1.4, 1.7, xtol=1e-13))
    system = found.system
    rates = np.roots([1, system.gamma2, 1])

    def start(rate):
        return system.epsilon / (1 - np.exp(rate * system.period))

    def half(rate):
        return start(rate) * np.exp(rate * system.period / 2)

    expected = C_at_breaking(system.epsilon, system.Omega, rates, start, half, np.pi)
    assert found.C[1] == pytest.approx(expected.real, rel=1e-9)
    assert abs(expected.imag) < 1e-12
    two_terms = SYMMETRY_BREAKING_C + system.epsilon * SLOPE
    assert abs(expected - two_terms) > 1e-3  # the test is sharper than one of the slope
