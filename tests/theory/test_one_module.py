"""One module alone, the other uncoupled: against what is published of it, and its thresholds in closed form."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

import vibroimpact as vi
from vibroimpact.theory.manifold import B_min, B_of_C, C_min, C_of_B, impact_phase, rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC


def uncoupled(epsilon=0.1, kappa=0.65, gamma=0.2, sigma=0.0, force=1.0, other=3.0, **changes):
    """Module 1 as said, module 2 another one that it does not feel."""
    return vi.System(**{
        "epsilon": epsilon, "kappa": kappa, "alpha12_hat": 0.0, "gamma12_hat": 0.0, "gamma1_hat": gamma,
        "gamma2_hat": 0.5, "sigma20_hat": 0.7, "sigma_e_hat": sigma, "f10_hat": force, "f20_hat": other,
    } | changes)  # fmt: skip


# Published closed forms: Weidemann, Bergman, Vakakis and Krack 2025 (docs/methods.md), for sectors that move alike. Box
# and ball weigh 1 together, the ball epsilon_a; xi is B, theta C, D the damping ratio with the ball fixed, Gamma the
# clearance over the amplitude at resonance then, 1 / (2 D) for a force of 1.


def theirs(epsilon_a, kappa, D, xi, r):
    """theta, the phasor of the ball and Gamma, at amplitudes xi and frequencies r."""
    dissipation = (2 / np.pi) * (1 - kappa) / (1 + kappa)
    square = 1 + dissipation**2
    theta = (1 + np.sqrt(square * xi**2 - dissipation**2)) / square
    phasor = (theta - 1) / xi - 1j * dissipation * theta / xi
    box = (1 - (1 - epsilon_a) * r**2 + 2j * D * r) * xi
    return theta, phasor, 2 * D / np.abs(box - 8 * epsilon_a * theta * phasor * r**2 / np.pi**2)


def ours(epsilon_a, kappa, D, sigma):
    """The same module in the scaling of (10.4): mass 1 of the box alone, and their frequency."""
    epsilon, unit = epsilon_a / (1 - epsilon_a), np.sqrt(1 - epsilon_a)
    system = uncoupled(epsilon, kappa, gamma=2 * D / unit / epsilon, sigma=sigma)
    return system, system.Omega / unit


@pytest.mark.parametrize("kappa", [0.2, 0.65, 0.8])
def test_the_upper_arm_of_the_manifold_and_the_phases_on_it_are_those_published(kappa):
    r = rho(kappa)
    B = np.geomspace(1.001 * B_min(r), 30.0, 50)
    theta, phasor, _ = theirs(0.02, kappa, 1e-3, B, 1.0)
    C = C_of_B(B, r)[1]
    np.testing.assert_allclose(C, theta, rtol=1e-12)
    np.testing.assert_allclose(np.exp(1j * impact_phase(C, r)), (1j * phasor).conj(), rtol=1e-12)


def test_fixed_points_at_the_published_force_tend_to_the_published_amplitudes():
    """Their equation keeps Omega^2 where the slow flow has 1 + 2 epsilon sigma: the distance falls like epsilon."""
    errors = []
    for epsilon_a in (0.02, 0.01, 0.005):
        D = 0.05 * epsilon_a
        for sigma, C in ((-1.0, 1.3), (-0.3, 1.0), (0.0, 2.0), (0.5, 1.3)):
            system, r = ours(epsilon_a, 0.8, D, sigma)
            Gamma = theirs(epsilon_a, 0.8, D, B_of_C(C, rho(0.8)), r)[2]
            driven = system.with_(f10_hat=2 * D / Gamma / system.epsilon)
            errors.append(min(abs(point.C[0] - C) for point in vi.fixed_points(driven)))
    largest = np.reshape(errors, (3, 4)).max(axis=1)
    assert largest[-1] < 0.02
    np.testing.assert_allclose(largest[:-1] / largest[1:], 2.0, rtol=0.15)


def test_the_widest_clearance_with_a_resonant_response_tends_to_that_published():
    """Along the resonance the force takes its least value; for their balls of 2 % and D = 0.1 % Gamma is 0.339."""
    kappa, r, found = 0.8, rho(0.8), []
    for epsilon_a in (0.02, 0.01, 0.005):
        D = 0.05 * epsilon_a
        xi = np.geomspace(1.0001 * B_min(r), 20.0, 20001)
        phasor = theirs(epsilon_a, kappa, D, xi, 1.0)
        resonance = np.sqrt(xi / ((1 - epsilon_a) * xi + 8 * epsilon_a * phasor[0] * phasor[1].real / np.pi**2))
        published = theirs(epsilon_a, kappa, D, xi, resonance)[2].max()
        system, _ = ours(epsilon_a, kappa, D, 0.0)
        least = minimize_scalar(lambda C, s=system: along_resonance(s, C), bounds=(C_min(r), 5.0), method="bounded").fun
        found.append((published, 2 * D / system.epsilon / least))
    assert found[0] == pytest.approx((0.339, 0.326), abs=5e-4)
    off = np.abs(np.divide(*np.transpose(found)) - 1)
    assert off[-1] < 0.01
    np.testing.assert_allclose(off[:-1] / off[1:], 2.0, rtol=0.05)


def along_resonance(system, C):
    """f10_hat of a fixed point that is detuned to have its force in phase with the velocity, by its power balance."""
    B = B_of_C(C, rho(system.kappa))
    return system.gamma1_hat * B + FIRST_HARMONIC * rho(system.kappa) * C**2 / B


# Thresholds of the strongly modulated response.


def thresholds(kappa, gamma, sigma):
    """Forces, in closed form: the ball at rest is reached at B = 1; the fixed point is at the fold of the manifold."""
    r, impedance = rho(kappa), complex(-2 * sigma, gamma)
    return abs(impedance), abs(impedance * r + FIRST_HARMONIC * complex(r, 1) / (1 + r**2)) / np.sqrt(1 + r**2)


@pytest.mark.parametrize(("kappa", "gamma", "sigma"), [(0.65, 0.2, 0.0), (0.65, 0.2, -0.1), (0.8, 0.1, 0.05)])
def test_the_fixed_point_reaches_the_fold_at_a_force_in_closed_form(kappa, gamma, sigma):
    high, system = thresholds(kappa, gamma, sigma)[1], uncoupled(0.01, kappa, gamma, sigma)

    def beyond_fold(force):
        return max(point.C[0] for point in vi.fixed_points(system.with_(f10_hat=force))) - C_min(rho(kappa))

    assert brentq(beyond_fold, 0.9 * high, 1.1 * high, xtol=1e-12) == pytest.approx(high, rel=1e-8)


def test_between_two_forces_neither_rest_nor_a_resonant_response_lasts():
    """Of the exact system at a small epsilon: no impact below, bursts between, two impacts a cycle above."""
    low, high = thresholds(0.65, 0.2, 0.0)
    system = uncoupled(0.005)
    forces = np.array([0.95 * low, 1.05 * low, 0.95 * high, 1.05 * high])
    starts = [[0.0, 0.0, 0.0, 0.0, speed, 0.0, 0.0, 0.0] for speed in (0.0, 0.0, 0.3, 0.3)]
    runs = vi.ensemble([system.with_(f10_hat=force) for force in forces], starts, 3000, settle=2000)
    per_cycle = runs["impacts"][:, 0] / 1000
    assert per_cycle[0] == 0
    assert 0.3 < per_cycle[1] < per_cycle[2] < 1.95
    assert per_cycle[3] == 2
    crest = runs["largest"][:, 0] ** 2 / (2 * runs["mean_square"][:, 0])  # 1 of a sinusoid
    np.testing.assert_allclose(crest[[0, 3]], 1, atol=0.02)
    assert min(crest[1:3]) > 1.5
