"""One uncoupled module agrees with published closed forms, and has its thresholds at forces in closed form."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

import vibroimpact as vi
from vibroimpact.theory.manifold import B_min, B_of_C, C_min, C_of_B, impact_phase, rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC


def uncoupled(epsilon=0.1, kappa=0.65, gamma=0.2, sigma=0.0):
    """Return a system in which module 1 has the given parameters, and module 2 is not coupled to it."""
    return vi.System(
        epsilon=epsilon, kappa=kappa, alpha12_hat=0.0, gamma12_hat=0.0, gamma1_hat=gamma, gamma2_hat=0.5,
        sigma20_hat=0.7, sigma_e_hat=sigma, f10_hat=1.0, f20_hat=3.0,
    )  # fmt: skip


# Published closed forms: Weidemann, Bergman, Vakakis and Krack 2025 (docs/methods.md), for sectors in equal motion. Box
# and ball have the total mass 1, the ball epsilon_a; xi is B, theta is C, D is the damping ratio with the ball fixed,
# Gamma the ratio of the clearance to the amplitude at resonance with the ball fixed, 1 / (2 D) for a force of 1.


def published_response(epsilon_a, kappa, D, xi, r):
    """Return theta, the phasor of the ball and Gamma, at amplitudes xi and frequencies r."""
    dissipation = (2 / np.pi) * (1 - kappa) / (1 + kappa)
    square = 1 + dissipation**2
    theta = (1 + np.sqrt(square * xi**2 - dissipation**2)) / square
    phasor = (theta - 1) / xi - 1j * dissipation * theta / xi
    box = (1 - (1 - epsilon_a) * r**2 + 2j * D * r) * xi
    return theta, phasor, 2 * D / np.abs(box - 8 * epsilon_a * theta * phasor * r**2 / np.pi**2)


def scaled(epsilon_a, kappa, D, sigma):
    """Return the same module in the scaling of (10.4), in which the box has mass 1, and the published frequency."""
    epsilon, unit = epsilon_a / (1 - epsilon_a), np.sqrt(1 - epsilon_a)
    system = uncoupled(epsilon, kappa, gamma=2 * D / unit / epsilon, sigma=sigma)
    return system, system.Omega / unit


@pytest.mark.parametrize("kappa", [0.2, 0.65, 0.8])
def test_the_upper_arm_of_the_manifold_and_its_phases_are_the_published_ones(kappa):
    r = rho(kappa)
    B = np.geomspace(1.001 * B_min(r), 30.0, 50)
    theta, phasor, _ = published_response(0.02, kappa, 1e-3, B, 1.0)
    C = C_of_B(B, r)[1]
    np.testing.assert_allclose(C, theta, rtol=1e-12)
    np.testing.assert_allclose(np.exp(1j * impact_phase(C, r)), (1j * phasor).conj(), rtol=1e-12)


def test_fixed_points_at_the_published_force_tend_to_the_published_amplitudes():
    """The error is O(epsilon): the published equation has Omega^2, the slow flow 1 + 2 epsilon sigma."""
    errors = []
    for epsilon_a in (0.02, 0.01, 0.005):
        D = 0.05 * epsilon_a
        for sigma, C in ((-1.0, 1.3), (-0.3, 1.0), (0.0, 2.0), (0.5, 1.3)):
            system, r = scaled(epsilon_a, 0.8, D, sigma)
            Gamma = published_response(epsilon_a, 0.8, D, B_of_C(C, rho(0.8)), r)[2]
            driven = system.with_(f10_hat=2 * D / Gamma / system.epsilon)
            errors.append(min(abs(point.C[0] - C) for point in vi.fixed_points(driven)))
    largest = np.reshape(errors, (3, 4)).max(axis=1)
    assert largest[-1] < 0.02
    np.testing.assert_allclose(largest[:-1] / largest[1:], 2.0, rtol=0.15)


def test_the_largest_clearance_with_a_resonant_response_tends_to_the_published_one():
    """The force has a minimum along the resonance; Gamma is 0.339 for balls of 2 % and D = 0.1 %."""
    kappa, r, found = 0.8, rho(0.8), []
    for epsilon_a in (0.02, 0.01, 0.005):
        D = 0.05 * epsilon_a
        xi = np.geomspace(1.0001 * B_min(r), 20.0, 20001)
        theta, phasor, _ = published_response(epsilon_a, kappa, D, xi, 1.0)
        resonance = np.sqrt(xi / ((1 - epsilon_a) * xi + 8 * epsilon_a * theta * phasor.real / np.pi**2))
        published = published_response(epsilon_a, kappa, D, xi, resonance)[2].max()
        system, _ = scaled(epsilon_a, kappa, D, 0.0)
        smallest = minimize_scalar(lambda C, s=system: force_at_resonance(s, C), bounds=(C_min(r), 5), method="bounded")
        found.append((published, 2 * D / system.epsilon / smallest.fun))
    assert found[0] == pytest.approx((0.339, 0.326), abs=5e-4)
    errors = np.abs(np.divide(*np.transpose(found)) - 1)
    assert errors[-1] < 0.01
    np.testing.assert_allclose(errors[:-1] / errors[1:], 2.0, rtol=0.05)


def force_at_resonance(system, C):
    """Return f10_hat at a fixed point detuned so that force and velocity are in phase, by the power balance."""
    B = B_of_C(C, rho(system.kappa))
    return system.gamma1_hat * B + FIRST_HARMONIC * rho(system.kappa) * C**2 / B


def thresholds(kappa, gamma, sigma):
    """Return the forces at which the box reaches the ball at rest, B = 1, and the fixed point is at the fold."""
    r, impedance = rho(kappa), complex(-2 * sigma, gamma)
    return abs(impedance), abs(impedance * r + FIRST_HARMONIC * complex(r, 1) / (1 + r**2)) / np.sqrt(1 + r**2)


@pytest.mark.parametrize(("kappa", "gamma", "sigma"), [(0.65, 0.2, 0.0), (0.65, 0.2, -0.1), (0.8, 0.1, 0.05)])
def test_the_fixed_point_reaches_the_fold_at_a_force_in_closed_form(kappa, gamma, sigma):
    high, system = thresholds(kappa, gamma, sigma)[1], uncoupled(0.01, kappa, gamma, sigma)

    def beyond_fold(force):
        return max(point.C[0] for point in vi.fixed_points(system.with_(f10_hat=force))) - C_min(rho(kappa))

    assert brentq(beyond_fold, 0.9 * high, 1.1 * high, xtol=1e-12) == pytest.approx(high, rel=1e-8)


def test_the_response_is_modulated_between_the_two_thresholds():
    """In the exact system at a small epsilon: no impacts below, bursts between, two impacts per cycle above."""
    low, high = thresholds(0.65, 0.2, 0.0)
    system = uncoupled(0.005)
    forces = np.array([0.95 * low, 1.05 * low, 0.95 * high, 1.05 * high])
    starts = [[0.0, 0.0, 0.0, 0.0, speed, 0.0, 0.0, 0.0] for speed in (0.0, 0.0, 0.3, 0.3)]
    runs = vi.ensemble([system.with_(f10_hat=force) for force in forces], starts, 3000, settle=2000)
    per_cycle = runs["impacts"][:, 0] / 1000
    assert per_cycle[0] == 0
    assert 0.3 < per_cycle[1] < per_cycle[2] < 1.95
    assert per_cycle[3] == 2
    crest = runs["largest"][:, 0] ** 2 / (2 * runs["mean_square"][:, 0])  # 1 for a sinusoid
    np.testing.assert_allclose(crest[[0, 3]], 1, atol=0.02)
    assert min(crest[1:3]) > 1.5
