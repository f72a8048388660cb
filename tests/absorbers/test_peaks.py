"""Peaks of several starts over a band, and the spread that drawing the starts again would show."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.absorbers.peaks import peak, spread_of_largest
from vibroimpact.absorbers.references import without_balls
from vibroimpact.regimes.classification import starts

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
BAND = [SYSTEM.with_(sigma_e_hat=value) for value in (-0.5, 0.0, 0.5, 1.0)]


def test_a_peak_is_the_largest_of_certified_runs():
    states = starts(3, 1)
    found = peak(BAND, states, 30, 20)
    largest = np.zeros((len(BAND), len(states)))
    for n, system in enumerate(BAND):
        times = (20 + np.arange(10 * 400) / 400) * system.period
        for k, state in enumerate(states):
            samples = vi.simulate(system, state, 30, sample_times=times).samples
            largest[n, k] = np.abs(samples[:, [0, 2]]).max()
    np.testing.assert_allclose(found.starts, largest.max(axis=0), rtol=1e-4)
    assert found.value == found.starts.max()
    assert found.at == largest.max(axis=1).argmax()


@pytest.mark.parametrize("number", [2, 3, 8, 20])
def test_the_spread_is_that_of_drawing_again(number):
    """Against a hundred thousand drawings with replacement."""
    rng = np.random.default_rng(number)
    values = rng.gamma(3.0, 1.0, number)
    drawn = rng.choice(values, (100_000, number)).max(axis=1)
    assert spread_of_largest(rng.permutation(values)) == pytest.approx(drawn.std(), rel=0.02)


def test_one_value_has_no_spread_to_tell_and_equal_ones_have_none():
    assert np.isnan(spread_of_largest([3.0]))
    assert spread_of_largest([3.7] * 9) == 0.0
    with pytest.raises(ValueError, match=r"^values: needs finite numbers"):
        spread_of_largest([1.0, np.nan])


def test_balls_that_meet_no_wall_have_the_peak_of_none():
    faint = [system.with_(f10_hat=1e-3, f20_hat=1e-3) for system in BAND]
    found = peak(faint, np.zeros((1, 8)), 400, 390)
    amplitudes = [without_balls(system).amplitudes(system.Omega).max() for system in faint]
    assert found.value == pytest.approx(max(amplitudes), rel=1e-4)
    assert found.at == int(np.argmax(amplitudes))
