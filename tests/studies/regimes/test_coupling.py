"""Orbits with two asymmetric balls, from weak to strong coupling: difference of the patterns, stable ranges, proofs."""

import numpy as np
import pytest
import sympy as sp

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions
from vibroimpact.exact.orbits.newton import newton
from vibroimpact.studies.figures.companion_coupling import ALIKE, LIMITS
from vibroimpact.studies.regimes.coupling import (
    ANTIPHASE,
    IN_PHASE,
    VANISHES,
    coupled,
    flight_asymmetry,
    pattern,
    patterns,
    stable_ranges,
)
from vibroimpact.studies.regimes.families import (
    FOLD,
    NEIMARK_SACKER,
    PERIOD_DOUBLING,
    AsymmetricOrbits,
    flight_fractions,
)

TUNED_ALIKE = vi.System(**PARAMETERS | ALIKE)
SMALL = (0.02, 0.01, 0.005)
HARMONICS = 2 * np.arange(1, 200)


def asymmetric_orbits(system):
    """Return the stable orbits on which both balls are asymmetric."""
    return [one for one in vi.orbits(system) if one.admissible and one.stable and pattern(one)]


@pytest.fixture(scope="module", params=[1.0, 3.0, 14.0, 30.0])
def asymmetric(request):
    """Return the stable orbits with two asymmetric balls at a coupling."""
    return asymmetric_orbits(coupled(TUNED_ALIKE, request.param))


def splitting(system, root):
    """Return `root` (6,) minus the `mirrored` root of the other pattern, to leading order.

    If one module is mirrored, one pattern turns into the other, except that the even harmonics that act through the
    coupling change their sign. The result is therefore -2 times the inverse Jacobian of the exact conditions times the
    contribution of these even harmonics to the conditions.
    """
    conditions = AsymmetricConditions(system)
    times, strengths = root[:4].reshape(2, 2), root[4:]
    u = flight_fractions(system, root)
    middle = times[:, 0] + u * system.period / 2
    n = HARMONICS * system.Omega
    link = system.alpha12 + 1j * n * system.gamma12
    through = link / ((n**2 - 1) * (n**2 - 1 - 2 * link))
    defect = np.zeros(6)
    for i, j in ((0, 1), (1, 0)):
        kicks = 4 * system.epsilon * strengths[j] / system.period * np.sin(n * u[j] * system.period / 2)
        waves = -1j * kicks * through * np.exp(1j * n * (times[i][:, None] - middle[j]))
        place, speed = waves.sum(axis=1).real, (1j * n * waves).sum(axis=1).real
        defect[2 * i : 2 * i + 2], defect[4 + i] = (1 + system.kappa) * speed, place[0] - place[1]
    return -2 * np.linalg.solve(conditions(root[None])[1][0], defect)


def mirrored(system, root):
    """Return the root (6,) that has the mirrored motion of ball 2: its walls are exchanged half a period later."""
    return root[[0, 1, 3, 2, 4, 5]] + np.array([0, 0, 1, 1, 0, 0]) * system.period / 2


def apart(system):
    """Return the exact in-phase root, and its difference from the antiphase root with ball 2 mirrored."""
    roots = [(root, AsymmetricOrbits.member(system, root)) for root in AsymmetricOrbits.roots(system)]
    root = next(
        root for root, one in roots if one.admissible and pattern(one) == IN_PHASE and flight_asymmetry(one)[0] > 0
    )
    partner = newton(AsymmetricConditions(system), mirrored(system, root)[None])[0]
    assert pattern(AsymmetricOrbits.member(system, partner)) == ANTIPHASE
    difference = root - mirrored(system, partner)
    difference[:4] = (difference[:4] + system.period / 2) % system.period - system.period / 2
    return root, difference


def test_the_derived_difference_of_the_patterns_is_exact_to_leading_order():
    """The relative error falls at least at first order in epsilon; both balls are asymmetric at any epsilon here."""
    errors, sizes = [], []
    for epsilon in SMALL:
        system = TUNED_ALIKE.with_(epsilon=epsilon, f10_hat=1.7, f20_hat=1.72)
        root, exact = apart(system)
        derived = splitting(system, root)
        errors.append(np.linalg.norm(derived - exact) / np.linalg.norm(exact))
        sizes.append(np.linalg.norm(exact) / epsilon**2)
    assert max(errors) < 0.02
    assert (np.diff(np.log(errors)) / np.diff(np.log(SMALL)) > 1).all()
    # The difference is of second order: over epsilon^2, which falls 16-fold, it changes by less than a factor of 3.
    assert max(sizes) < 3 * min(sizes)


def test_without_coupling_all_patterns_have_the_same_amplitudes():
    system = TUNED_ALIKE.with_(alpha12_hat=0.0, gamma12_hat=0.0)
    found = {pattern(one): one for one in asymmetric_orbits(system)}
    np.testing.assert_allclose(found[IN_PHASE].C, found[ANTIPHASE].C, atol=1e-9)
    np.testing.assert_allclose(abs(found[IN_PHASE].multipliers), abs(found[ANTIPHASE].multipliers), atol=1e-6)
    np.testing.assert_allclose(splitting(system, patterns(system)[IN_PHASE]), 0, atol=1e-15)


def test_the_response_to_an_even_harmonic_through_the_coupling():
    """Computer algebra gives the response of box 1 to a force on box 2, for undamped boxes of natural frequency 1."""
    n, K = sp.symbols("n K")
    through = sp.Matrix([[1 - n**2 + K, -K], [-K, 1 - n**2 + K]]).inv()[0, 1]
    assert sp.simplify(through - K / ((n**2 - 1) * (n**2 - 1 - 2 * K))) == 0


@pytest.fixture(scope="module")
def ranges():
    """Return the ranges of coupling with stable patterns."""
    return list(stable_ranges(TUNED_ALIKE, LIMITS))


def test_stable_ranges_end_in_the_bifurcations_of_the_page_on_coupling(ranges):
    assert [(name, ends) for name, _, _, ends in ranges] == [
        (IN_PHASE, (FOLD, FOLD)),
        (ANTIPHASE, (PERIOD_DOUBLING, NEIMARK_SACKER)),
        (ANTIPHASE, (NEIMARK_SACKER, VANISHES)),
        (IN_PHASE, (VANISHES, "")),
    ]


def test_orbits_of_a_pattern_exist_inside_and_not_outside_of_its_stable_range(ranges):
    """A search looks for orbits at 1 % inside and outside of each end. At bifurcations, a multiplier has modulus 1."""
    for name, _, found, ends in ranges:
        for (value, orbit), end, outwards in zip((found[0], found[-1]), ends, (0.99, 1.01), strict=True):
            if not end:
                continue
            inside, outside = (asymmetric_orbits(coupled(TUNED_ALIKE, value * by)) for by in (1 / outwards, outwards))
            assert name in map(pattern, inside)
            assert name not in map(pattern, outside)
            if end != VANISHES:
                assert abs(orbit.multipliers[0]) == pytest.approx(1, abs=0.03)


def test_all_stable_patterns_of_the_page_on_coupling_are_proved(asymmetric):
    named = {1.0: (2, 2), 3.0: (2, 2), 14.0: (0, 2), 30.0: (2, 0)}
    found = [pattern(one) for one in asymmetric]
    assert (found.count(IN_PHASE), found.count(ANTIPHASE)) == named[asymmetric[0].system.alpha12_hat]
    for one in asymmetric:
        proved, (plus, minus) = one.with_proof(), one.impact_phases.T
        assert proved.proved
        assert proved.stable
        np.testing.assert_allclose(flight_asymmetry(one), 1 - 2 * ((minus - plus) % 1.0), atol=1e-9)
