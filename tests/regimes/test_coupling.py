"""Both balls leaning, from weak to strong coupling: what tells the patterns apart, mirror images, proofs, power."""

import numpy as np
import pytest
import sympy as sp

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions
from vibroimpact.exact.orbits.newton import newton
from vibroimpact.figures.companion_coupling import ALIKE, WATCHED
from vibroimpact.regimes.coupling import (
    OPPOSITE,
    SAME,
    coupled,
    impact_power,
    lean,
    leaning_orbits,
    mirrored,
    pattern,
    patterns,
    splitting,
)
from vibroimpact.regimes.families import AsymmetricOrbits

TUNED_ALIKE = vi.System(**PARAMETERS | ALIKE)
SMALL = (0.02, 0.01, 0.005)


@pytest.fixture(scope="module", params=WATCHED)
def leaning(request):
    return leaning_orbits(coupled(TUNED_ALIKE, request.param))


def apart(system):
    """Exact roots of the same way and of its partner, and how far they are apart, ball 2 of the partner mirrored."""
    roots = [(root, AsymmetricOrbits.member(system, root)) for root in AsymmetricOrbits.roots(system)]
    root = next(root for root, one in roots if one.admissible and pattern(one) == SAME and lean(one)[0] > 0)
    partner = newton(AsymmetricConditions(system), mirrored(system, root)[None])[0]
    assert pattern(AsymmetricOrbits.member(system, partner)) == OPPOSITE
    difference = root - mirrored(system, partner)
    difference[:4] = (difference[:4] + system.period / 2) % system.period - system.period / 2
    return root, difference


def test_the_derived_term_tells_the_patterns_apart_better_than_in_proportion_to_epsilon():
    """At forces at which both lean however small epsilon; the relative error falls at first order at least."""
    errors, sizes = [], []
    for epsilon in SMALL:
        system = TUNED_ALIKE.with_(epsilon=epsilon, f10_hat=1.7, f20_hat=1.72)
        root, exact = apart(system)
        derived = splitting(system, root)
        errors.append(np.linalg.norm(derived - exact) / np.linalg.norm(exact))
        sizes.append(np.linalg.norm(exact) / epsilon**2)
    assert max(errors) < 0.02
    assert (np.diff(np.log(errors)) / np.diff(np.log(SMALL)) > 1).all()
    # Of the second order in epsilon: the difference over its square stays within a factor of 3 while that falls 16 times.
    assert max(sizes) < 3 * min(sizes)


def test_without_coupling_all_patterns_have_the_same_amplitudes():
    system = TUNED_ALIKE.with_(alpha12_hat=0.0, gamma12_hat=0.0)
    found = {pattern(one): one for one in leaning_orbits(system)}
    np.testing.assert_allclose(found[SAME].C, found[OPPOSITE].C, atol=1e-9)
    np.testing.assert_allclose(abs(found[SAME].multipliers), abs(found[OPPOSITE].multipliers), atol=1e-6)
    np.testing.assert_allclose(splitting(system, patterns(system)[SAME]), 0, atol=1e-15)


def test_what_an_even_harmonic_passes_through_the_coupling():
    """By computer algebra: the response of box 1 to a force on box 2, boxes undamped at Omega n, natural frequency 1."""
    n, K = sp.symbols("n K")
    stiffness = sp.Matrix([[1 - n**2 + K, -K], [-K, 1 - n**2 + K]])
    through = stiffness.inv()[0, 1]
    assert sp.simplify(through - K / ((n**2 - 1) * (n**2 - 1 - 2 * K))) == 0
    assert sp.simplify(sp.diff(through, K).subs(K, 0) - 1 / (n**2 - 1) ** 2) == 0


def test_patterns_come_in_mirror_images(leaning):
    """state(tau) -> -state(tau + T/2), by the engine: half a period of each orbit ends on its mirror image."""
    for one in leaning:
        half = vi.simulate(one.system, one.state, 1, sample_times=[one.system.period / 2]).samples[0]
        distances = [np.abs(half + other.state).max() for other in leaning]
        image = leaning[int(np.argmin(distances))]
        assert min(distances) < 1e-9
        np.testing.assert_allclose(lean(image), -lean(one), atol=1e-9)
        assert pattern(image) == pattern(one)


def test_all_stable_patterns_that_the_page_names_are_proved(leaning):
    strong = leaning[0].system.alpha12_hat > 10
    assert [pattern(one) for one in leaning].count(SAME) == 2
    assert [pattern(one) for one in leaning].count(OPPOSITE) == (0 if strong else 2)
    for one in leaning:
        proved = one.with_proof()
        assert proved.proved
        assert proved.stable


def test_responses_whose_power_the_page_compares_are_proved_and_balance_their_energy():
    for force in (0.5, 1.0, 1.1):
        system = vi.System(**PARAMETERS, f10_hat=force, f20_hat=force)
        for one in (one for one in vi.orbits(system) if one.admissible and (one.symmetric or one.stable)):
            proved = one.with_proof()
            assert proved.proved
            assert proved.stable is not one.symmetric
            energy = vi.simulate(system, one.state, 1).energy
            taken = energy.work.sum() - energy.ground.sum() - energy.coupling  # nothing is stored over a period
            assert impact_power(system, [one.state], 1)[0] * system.period == pytest.approx(taken, rel=1e-9)
