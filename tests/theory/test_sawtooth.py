"""The saw-tooth (10.11) against its definition, its Fourier series (10.19) and the impacts it must carry."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vibroimpact.theory.manifold import sawtooth

angle = st.floats(-50, 50)
amplitude = st.floats(-5, 5)


@given(angle, amplitude, angle)
def test_is_the_arcsine_of_the_cosine(tau0, C, theta):
    with mpmath.workdps(40):
        exact = 2 / mpmath.pi * mpmath.asin(mpmath.cos(mpmath.mpf(tau0) - mpmath.mpf(theta))) * mpmath.mpf(C)
    assert sawtooth(tau0, C, theta) == pytest.approx(float(exact), abs=5e-14)


def test_fourier_coefficients_are_those_of_10_19():
    samples = 2**14
    tau0 = 2 * np.pi * np.arange(samples) / samples
    C, theta = 0.7, 0.3
    spectrum = 2 * np.fft.rfft(sawtooth(tau0, C, theta)) / samples
    n = np.arange(1, 12)
    expected = np.where(n % 2, 8 / np.pi**2 * C / n**2, 0) * np.exp(-1j * n * theta)
    assert np.abs(spectrum[n] - expected).max() < 1e-7
