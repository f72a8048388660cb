"""Period, symmetry and numbers of impacts of constructed motions."""

import numpy as np
import pytest

from vibroimpact.exact.measures.periodicity import (
    distance_after,
    impacts_per_cycle,
    mirror_distance,
    repeats_after,
    samples_per_cycle,
)

PERIOD, PER_CYCLE = 2 * np.pi / 1.02, 24


def times(cycles):
    return 6000 + np.arange(cycles * PER_CYCLE + 1) / PER_CYCLE * PERIOD


def waves(cycles, *amplitudes):
    """Return the sum of amplitudes[n - 1] sin(2 pi t / (n T)) in one column and of cosines in the other."""
    phase = 2 * np.pi * np.arange(cycles * PER_CYCLE + 1) / PER_CYCLE
    return sum(
        amplitude * np.stack([np.sin(phase / n), np.cos(phase / n)], axis=1)
        for n, amplitude in enumerate(amplitudes, start=1)
    )


@pytest.mark.parametrize(
    "tau", [times(10)[: PER_CYCLE - 2], times(1)[:1], times(2)[::-1]], ids=["too short", "single", "backwards"]
)
def test_times_without_a_whole_cycle_in_order_are_refused(tau):
    with pytest.raises(ValueError, match="tau"):
        samples_per_cycle(tau, PERIOD)


@pytest.mark.parametrize(("amplitudes", "period"), [((1.0,), 1), ((1, 0.1), 2), ((1, 0, 0.1), 3), ((1, 0.1, 0.1), 6)])
def test_period_is_the_smallest_that_fits(amplitudes, period):
    assert repeats_after(waves(12, *amplitudes), PER_CYCLE, 1e-9) == period


def test_a_drifting_motion_does_not_repeat():
    drifting = waves(12, 1.0) * np.linspace(1, 1.01, 12 * PER_CYCLE + 1)[:, None]
    assert repeats_after(drifting, PER_CYCLE, 1e-4) is None
    assert distance_after(drifting, PER_CYCLE, 6) == pytest.approx(0.005, rel=0.01)


def test_a_motion_that_returns_to_its_first_sample_only_does_not_repeat():
    """The first sample recurs after 2 and after 3 cycles, but the following samples differ."""
    motion = waves(12, 1, 0, 0.1)
    motion[2 * PER_CYCLE] = motion[0]
    assert repeats_after(motion, PER_CYCLE, 1e-9) is None
    assert repeats_after(waves(12, 1, 0, 0.1), PER_CYCLE, 1e-9) == 3


def test_odd_harmonics_are_symmetric_and_offsets_are_asymmetric():
    motion = waves(4, 1.0) + 0.2 * waves(4, 1.0) ** 3
    assert mirror_distance(motion, PER_CYCLE) < 1e-13
    assert mirror_distance(motion + 0.05, PER_CYCLE) == pytest.approx(0.1)


def test_impacts_are_counted_per_cycle_module_and_wall():
    tau = 100 + PERIOD * np.array([0.2, 0.7, 0.1, 1.2, 1.7, 1.8, 2.5, 3.1])
    module = np.array([1, 1, 2, 1, 1, 1, 2, 1])
    wall = np.array([1, -1, 1, 1, -1, -1, -1, 1])
    counts = impacts_per_cycle(tau, module, wall, 100, PERIOD, 3)
    assert counts.tolist() == [[[1, 1], [1, 0]], [[1, 2], [0, 0]], [[0, 0], [0, 1]]]


def test_samples_may_be_uneven_by_a_millionth_of_a_step():
    tau = times(4)
    all_steps, one_sample = tau - tau[0], PERIOD / PER_CYCLE * (np.arange(len(tau)) == 7)
    for change in (all_steps, one_sample):
        assert samples_per_cycle(tau + 0.5e-6 * change, PERIOD) == PER_CYCLE
        with pytest.raises(ValueError, match="evenly"):
            samples_per_cycle(tau + 2e-6 * change, PERIOD)


def test_an_odd_number_of_samples_has_no_mirror_image():
    with pytest.raises(ValueError, match="per_cycle: 23 is odd"):
        mirror_distance(waves(2, 1.0), 23)
