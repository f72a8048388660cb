"""Errors of the theory are of first order in epsilon, and the fitted order of a power law is its exponent."""

import mpmath
import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.accuracy.second_term import first_order
from vibroimpact.studies.regimes.epsilon_limit import distance_to_orbit, order


def test_the_fitted_order_of_a_power_law_is_its_exponent():
    epsilon = np.geomspace(0.1, 1e-4, 7)
    slope, error = order(epsilon, 3 * epsilon**1.5)
    assert slope == pytest.approx(1.5, abs=1e-12)
    assert error < 1e-10
    noisy = epsilon * np.exp(0.1 * np.sin(5 * np.arange(7)))
    slope, error = order(epsilon, noisy)
    assert abs(slope - 1) < 3 * error


def upper_amplitude(epsilon, kappa, gamma_hat, sigma_e_hat, f_hat):
    """Return C of the upper orbit of a single module, from the closed-form response of one oscillator, with mpmath."""
    Omega, gamma = 1 + epsilon * sigma_e_hat, epsilon * gamma_hat
    h = mpmath.pi / Omega
    decay, ringing = gamma / 2, mpmath.sqrt(1 - gamma**2 / 4)
    denominator = mpmath.cosh(decay * h) + mpmath.cos(ringing * h)
    x = -mpmath.sin(ringing * h) / (2 * ringing * denominator)
    v = (mpmath.sinh(decay * h) + decay / ringing * mpmath.sin(ringing * h)) / (2 * denominator) - mpmath.mpf(1) / 2
    amplitude = abs(epsilon * f_hat / (1 - Omega**2 + 1j * gamma * Omega))
    real = (2 / h * (1 + 2 * epsilon - kappa) / (1 + kappa) + 4 * epsilon / h * v) / Omega
    imaginary = 4 * epsilon / h * x - 1
    a, b, c = real**2 + imaginary**2, 2 * imaginary, 1 - amplitude**2
    return (1 + epsilon) * (-b + mpmath.sqrt(b * b - 4 * a * c)) / (2 * a)


def test_the_second_term_of_a_single_module_is_that_of_the_closed_form(chapter):
    """Two equal modules are uncoupled. The closed form gives dC / depsilon at 0, computed with 60 digits."""
    alone = {"alpha12_hat": 0, "gamma12_hat": 0, "sigma20_hat": 0}
    system = chapter(1.5, 1.5, **alone)
    point = max(vi.fixed_points(system), key=lambda p: p.C.min())
    with mpmath.workdps(60):
        parameters = [mpmath.mpf(value) for value in (system.kappa, system.gamma1_hat, system.sigma_e_hat, 1.5)]
        low, high = (upper_amplitude(mpmath.mpf(10) ** -12 * n, *parameters) for n in (1, 2))
        slope, limit = float((high - low) * mpmath.mpf(10) ** 12), float(2 * low - high)
    np.testing.assert_allclose(point.C, limit, rtol=1e-12)
    np.testing.assert_allclose(first_order(system, point)[0], slope, rtol=1e-6)


@pytest.mark.parametrize(("f10", "f20"), [(1.0, 1.0), (0.5, 0.5)])
def test_errors_are_proportional_to_epsilon(chapter, f10, f20):
    """The errors are those of fixed points, eigenvalues of the slow flow, and multipliers of the impact map."""
    for point in vi.fixed_points(chapter(f10, f20)):
        found = [distance_to_orbit(chapter(f10, f20, epsilon=epsilon), point) for epsilon in (1e-3, 1e-4)]
        distances = [c.distance for c in found]
        slow = [abs(c.rates - c.predicted).max() for c in found]
        fast = [abs(c.multipliers - c.predicted_multipliers)[4:].max() for c in found]
        for errors in (distances, slow, fast):
            assert errors[0] / errors[1] == pytest.approx(10, rel=0.1)
