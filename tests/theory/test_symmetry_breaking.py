"""Where asymmetric motions leave the symmetric ones: closed form at finite epsilon, its slope by computer algebra."""

import numpy as np
import pytest
import sympy
from scipy.optimize import brentq

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.exact.orbits.search import half_period_multipliers, symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C

SLOPE = np.pi**2 * (np.pi**2 - 12) / (np.pi**2 - 4) ** 2
"""By how much it moves per epsilon (docs/derivation.md, section 13)."""


def C_at_breaking(epsilon, omega, rates, start, half, pi):
    """C of a single module, by the steady response Q of its box to unit impulses, one a period T.

    Q(s) is the sum of r-terms (e^(rs) / (1 - e^(rT))) / (r - r') over both rates; `start` and `half` give epsilon times
    the term in brackets at s = 0 and T/2. With impacts at -uT/2 and uT/2 of strength I, u = (1 - v)/2, and a forced
    motion A sin + B cos of the box, the sum of Newton's rules and the way from wall to wall are

        2 Omega A sin(pi v/2) + epsilon I (Q'(T - uT) - Q'(uT)) = v I,
        (1 - v^2) I T/4 = 2 + 2 A cos(pi v/2) + epsilon I (2 Q(0) - Q(uT) - Q(T - uT)),

    without kappa, B and the force. The first, divided by v, is pi Omega A = I (1 - epsilon T Q''(T/2)) at v = 0.
    """
    period, (plus, minus) = 2 * pi / omega, rates
    at_start = (start(plus) - start(minus)) / (plus - minus)
    at_half = (half(plus) - half(minus)) / (plus - minus)
    bend = (plus**2 * half(plus) - minus**2 * half(minus)) / (plus - minus)
    way = period / 4 - 2 * (1 - period * bend) / (pi * omega) - 2 * (at_start - at_half)
    return (1 + epsilon) * period / 4 / way


def test_the_slope_by_computer_algebra():
    """For any damping and detuning of the box and the force: rates i + a epsilon + b epsilon^2 and another pair.

    With rT = 2 pi i + epsilon w, epsilon / (1 - e^(rT)) is -(1 - epsilon w/2) / w, and half a period later 1 / w, both
    up to epsilon^2.
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
def test_exact_orbits_break_their_symmetry_there(kappa):
    """At epsilon = 0.1, where the half-period multiplier of a module alone, the second one, is -1."""
    uncoupled = PARAMETERS | dict(alpha12_hat=0, gamma12_hat=0, sigma20_hat=0, kappa=kappa)

    def orbit(force):
        system = vi.System(**uncoupled, f10_hat=1.0, f20_hat=force)
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
    assert abs(expected - two_terms) > 1e-3  # so this is more than the slope
