"""Peaks over a band: a quantile over cycles, its standard error, and its dependence on the window."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.studies.absorbers.peaks import by_cycle, peak, peak_of, standard_error
from vibroimpact.studies.regimes.classification import starts

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
BAND = [SYSTEM.with_(sigma_e_hat=value) for value in (-0.5, 0.0, 0.5, 1.0)]
CHAOTIC = [SYSTEM.with_(kappa=0.1, f10_hat=1.05, f20_hat=1.05, sigma_e_hat=value) for value in (-0.5, 0.9)]


def test_a_peak_is_a_quantile_of_the_cycles_of_certified_runs():
    states, system = starts(3, 1), BAND[1]
    found = by_cycle(BAND, states, 30, 20)
    times = (20 + np.arange(10 * 400 + 1) / 400) * system.period
    each = []
    for state in states:
        run = vi.simulate(system, state, 30, sample_times=times)
        boxes = np.abs(run.samples[:, [0, 2]]).max(axis=1)
        each.append([boxes[400 * n : 400 * (n + 1) + 1].max() for n in range(10)])
    np.testing.assert_allclose(found.largest[1], each, rtol=1e-4)
    # Among thirty values, the quantile 0.99 is at 0.71 of the way from the second largest to the largest.
    ordered = np.sort(found.largest[1], axis=None)
    assert peak_of(found.largest)[1] == pytest.approx(0.29 * ordered[-2] + 0.71 * ordered[-1], rel=1e-12)
    assert peak(BAND, states, 30, 20) == (peak_of(found.largest).max(), standard_error(found.largest))


@pytest.mark.thorough
def test_the_peak_of_a_chaotic_response_does_not_grow_with_the_window_unlike_its_largest_displacement():
    """Means over ten sets of starts are compared, since rounding errors change single chaotic runs."""
    short, long = (
        [
            (by_cycle(CHAOTIC, states, 150 + cycles, 150).largest.max(), *peak(CHAOTIC, states, 150 + cycles, 150))
            for states in (starts(24, seed) for seed in range(3, 13))
        ]
        for cycles in (100, 1600)
    )
    largest, value, _ = np.mean(long, axis=0) / np.mean(short, axis=0)
    assert largest > 1.01
    assert value == pytest.approx(1.0, abs=0.03)
    assert np.mean(np.square(long), axis=0)[2] < 0.5 * np.mean(np.square(short), axis=0)[2]


def test_the_standard_error_is_the_scatter_over_other_starts():
    found = [peak(CHAOTIC, starts(9, seed)[1:], 250, 150) for seed in range(20, 50)]
    values, errors = np.transpose(found)
    assert 0.6 * np.std(values) < np.sqrt(np.mean(errors**2)) < 1.7 * np.std(values)


def test_the_standard_error_is_nan_for_one_start_and_zero_for_equal_starts():
    one = np.linspace(1.0, 2.0, 20).reshape(2, 1, 10)
    assert np.isnan(standard_error(one))
    assert standard_error(np.repeat(one, 3, axis=1)) < 1e-12


def test_unfinished_runs_are_counted_and_excluded():
    states = np.vstack([starts(2, 1), np.full(8, np.nan)])
    found, alone = by_cycle(BAND, states, 12, 8), by_cycle(BAND, states[:2], 12, 8)
    assert (found.unfinished, alone.unfinished) == (len(BAND), 0)
    assert peak_of(found.largest).tolist() == peak_of(alone.largest).tolist()
    assert found.rms == alone.rms
    assert np.isnan(peak_of(by_cycle(BAND, states[2:], 12, 8).largest)).all()
    with pytest.raises(ArithmeticError, match="4 runs"):
        peak(BAND, states, 12, 8)
    with pytest.raises(ValueError, match=r"^cycles: must be greater than settle = 8, got 8"):
        peak(BAND, states[:2], 8, 8)
