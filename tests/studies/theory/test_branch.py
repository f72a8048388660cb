"""The asymmetric branch agrees with computer algebra (docs/derivation.md, section 11) and with flights of the ball."""

import numpy as np
import pytest
import sympy as sp

from vibroimpact.studies.theory import branch
from vibroimpact.studies.theory.branch import ASYMMETRIC, charts
from vibroimpact.theory import masri

v, kappa, u, J, B, C, P, Q = sp.symbols("v kappa u J B C P Q", positive=True)
x, a, b = sp.symbols("x a b", real=True)
DIGITS = 30
PLACES = [(sp.Rational(3, 10), sp.Rational(13, 20)), (sp.Rational(7, 10), sp.Rational(1, 10))]
"""Values of v and kappa."""


def motion(place):
    """Return the values of all symbols. P = B cos m and Q = B sin m, where m is halfway between both impacts."""
    difference, restitution = place
    share = (1 - difference) / 2
    cosine, sine = sp.cos(sp.pi * share), sp.sin(sp.pi * share)
    jump = 4 * C / (sp.pi * (1 - difference**2))
    laws = [
        -2 * P * sine + 2 * C - 2,  # W = U + Z falls from 1 to -1, and Z by 2 C
        # Newton's rule where Z' changes by -J, from J u to -J (1 - u), and back.
        (1 + restitution) * (P * cosine + Q * sine) - jump * (1 - share - restitution * share),
        (1 + restitution) * (P * cosine - Q * sine) - jump * (restitution * (1 - share) - share),
    ]
    matrix, right = sp.linear_eq_to_matrix(laws, P, Q, C)
    found = dict(zip((P, Q, C), matrix.evalf(2 * DIGITS).LUsolve(right.evalf(2 * DIGITS)), strict=True))
    middle = sp.atan2(found[Q], found[P])
    places = {a: middle - sp.pi * share, b: middle + sp.pi * share}
    size = sp.sqrt(found[P] ** 2 + found[Q] ** 2)
    return {**found, **places, v: difference, kappa: restitution, u: share, J: jump.subs(found), B: size}


MOTIONS = [motion(place) for place in PLACES]


def at(expression, values):
    return complex(expression.evalf(DIGITS, subs=values))


@pytest.mark.parametrize("values", MOTIONS)
def test_the_impact_laws_give_the_branch(values):
    difference, restitution = float(values[v]), float(values[kappa])
    chart, squared = charts(restitution)[ASYMMETRIC], difference**2
    middle, phases = -chart.z(squared) / chart.beta(squared), branch.impact_phases(difference, restitution)
    assert complex(values[P], values[Q]) == pytest.approx(middle, rel=1e-13)
    assert float(values[C]) == pytest.approx(chart.amplitudes(squared)[0], rel=1e-13)
    assert [float(values[a]), float(values[b])] == pytest.approx(phases, abs=1e-13)


def test_symmetry_breaking_is_supercritical_for_every_kappa():
    """B increases away from v = 0, so the pair begins where the symmetric motion loses its stability."""
    G0, G2 = (sp.series(2 * v / sp.pi * sp.cot(sp.pi * v / 2), v, 0, 3).removeO().coeff(v, k) for k in (0, 2))
    squared_rho = sp.Symbol("rho", nonnegative=True)
    # Coefficient of v^2 in log B^2 = log(G^2 + rho^2) - 2 log(1 - v^2 - G) - 2 log cos(pi v / 2).
    growth = 2 * G0 * G2 / (G0**2 + squared_rho) + 2 * (1 + G2) / (1 - G0) + sp.pi**2 / 4
    assert growth.subs(squared_rho, 0) > 0
    assert sp.diff(growth, squared_rho).is_positive


@pytest.mark.parametrize("values", MOTIONS)
def test_the_first_harmonic_of_the_asymmetric_sawtooth_is_that_of_the_chart(values):
    """The Fourier integral over both flights is N times the amplitude -i B of U = Re(-i B exp(i x))."""
    down, up = -J * (1 - u) * (x - a), -J * (1 - u) * (b - a) + J * u * (x - b)
    antiderivatives = [sp.integrate(sp.expand(flight * sp.exp(-sp.I * x)), x) for flight in (down, up)]
    ends = [(a, b), (b, a + 2 * sp.pi)]
    integral = sum(f.subs(x, high) - f.subs(x, low) for f, (low, high) in zip(antiderivatives, ends, strict=True))
    harmonic = at(integral / sp.pi, values)
    chart, squared = charts(float(values[kappa]))[ASYMMETRIC], float(values[v]) ** 2
    N = chart.n(squared) / chart.z(squared)
    assert harmonic == pytest.approx(N * -1j * float(values[B]), rel=1e-12)


@pytest.mark.parametrize("values", MOTIONS)
def test_the_trace_of_the_impact_map_is_that_of_the_branch(values):
    """The derivative of the map from impact to impact is multiplied over both flights. Its determinant is kappa^4."""
    x0, x1, s0 = sp.symbols("x0 x1 s0", real=True)

    def derivative(wall, start, end, slope):
        arrival = 2 * wall + B * (sp.sin(x1) - sp.sin(x0)) + s0 * (x1 - x0)
        after = -kappa * s0 - (1 + kappa) * B * sp.cos(x1)
        by = [-sp.diff(arrival, y) / sp.diff(arrival, x1) for y in (x0, s0)]
        rows = [by, [sp.diff(after, y) + sp.diff(after, x1) * d for y, d in zip((x0, s0), by, strict=True)]]
        assert abs(at(arrival.subs({x0: start, x1: end, s0: slope}), values)) < 1e-25
        return sp.Matrix(rows).subs({x0: start, x1: end, s0: slope}).evalf(DIGITS, subs=values)

    cycle = derivative(-1, b, a + 2 * sp.pi, J * u) * derivative(1, a, b, -J * (1 - u))
    trace = branch.trace(float(values[v]) ** 2, float(values[kappa]))
    assert float(cycle.trace()) == pytest.approx(trace, rel=1e-11)
    assert float(cycle.det()) == pytest.approx(float(values[kappa]) ** 4, rel=1e-12)


@pytest.mark.parametrize("kappa", [0.1, 0.65, 0.95])
def test_the_branch_begins_where_symmetry_breaks_and_grows_monotonically(kappa):
    squared = np.linspace(0, 0.99, 400)
    C, B = branch.amplitudes(squared, kappa)
    assert C[0] == pytest.approx(masri.SYMMETRY_BREAKING_C, rel=1e-14)
    assert (np.diff(C) > 0).all()
    assert (np.diff(B) > 0).all()
    assert C.max() < 2
    ours, symmetric = (np.sort(of.real) for of in (branch.multipliers(0.0, kappa), masri.multipliers(C[0], kappa)))
    np.testing.assert_allclose(ours, symmetric, rtol=1e-9)


@pytest.mark.parametrize("kappa", [1e-6, 0.65, 0.95, 0.999])
def test_the_branch_is_stable_up_to_a_period_doubling(kappa):
    end = branch.period_doubling(kappa)
    assert (np.diff(branch.trace(np.linspace(0, 1.2 * end, 100), kappa)) < 0).all()
    assert min(abs(branch.multipliers(end, kappa) + 1)) < 1e-9
    for squared, expected in ((0.5 * end, "stable"), (end, "undecided"), (1.01 * end, "unstable"), (-0.01, "unstable")):
        assert branch.stable(squared, kappa) == expected
        inside = bool((abs(branch.multipliers(squared, kappa)) < 1).all())
        assert expected == "undecided" or inside == (expected == "stable")


@pytest.mark.parametrize(("v", "kappa"), [(0.02, 0.65), (0.3, 0.65), (0.45, 0.3), (0.6, 0.9)])
def test_the_overshoot_is_that_of_sampled_flights(v, kappa):
    """The ball stays between its walls in all motions except the last."""
    C, B = branch.amplitudes(v**2, kappa)
    jump = 4 * C / (np.pi * (1 - v**2))  # of the slope of the saw-tooth at an impact
    a, b = branch.impact_phases(v, kappa)
    largest = 1.0
    for wall, start, end, share in ((1, a, b, (1 + v) / 2), (-1, b, a + 2 * np.pi, (1 - v) / 2)):
        x = np.linspace(start, end, 20001)
        W = wall + B * (np.sin(x) - np.sin(start)) - wall * jump * share * (x - start)
        largest = max(largest, abs(W).max())
    assert branch.overshoot(v, kappa) == pytest.approx(largest - 1, abs=1e-6)
    assert branch.overshoot(-v, kappa) == pytest.approx(branch.overshoot(v, kappa), abs=1e-12)
