"""Each promise of the certificate, in chosen runs; test_attack.py tests them in random runs."""

import copy
import pickle

import numpy as np
import pytest

import vibroimpact as vi
from attacks import MAX_ERROR_RATIO, Attack, Observer, truth
from one_box import one_box, run_error_ratio
from vibroimpact.exact.engine.certificate import HORIZON_ERROR

MISSES = [
    # forces, changes, start, and the nearest miss in dense samples; in the first run a ball turns twice in one proof
    ((0.3664, 0.3071), dict(kappa=0.4582, sigma_e_hat=-0.2001),
     [0.1712, -0.3204, -0.6147, -1.1425, -0.7531, -0.2159, -0.7851, 0.2308], 3.0e-4),
    ((0.634, 0.614), {}, [0, -0.528, 0, 0.327, 0, 0.477, 0, -0.261], 1.87e-4),
    ((1.097, 0.85), {}, [0, 0.761, 0, 0.021, 0, -0.574, 0, -0.735], 6.2e-4),
]  # fmt: skip


@pytest.mark.parametrize(("forces", "changes", "start", "miss"), MISSES)
def test_the_nearest_miss_is_that_of_dense_samples(chapter, forces, changes, start, miss):
    system = chapter(*forces, **changes)
    run = vi.simulate(system, start, 20)
    assert run.certificate.nearest_miss == pytest.approx(Observer(system).nearest_miss(run), abs=1e-12)
    assert run.certificate.nearest_miss == pytest.approx(miss, rel=0.01)


def test_the_error_includes_the_rounding_of_the_final_state():
    system = vi.System(
        epsilon=0.5, kappa=0.65, alpha12_hat=60, gamma1_hat=0, gamma2_hat=10, gamma12_hat=0, sigma20_hat=0.6,
        sigma_e_hat=-1.8, f10_hat=200, f20_hat=20,
    )  # fmt: skip
    run = vi.simulate(system, [0.084525, 1.084524, 1.149032, 0.949032, 0, 0, 0, 0.5], 1)
    assert run.certificate.error >= np.finfo(float).eps * np.abs(run.final).max()


@pytest.mark.parametrize(("slip", "decided"), [(0.0, True), (1e-16, False), (-1e-16, False), (1e-9, True)])
def test_a_start_nearly_at_rest_on_a_wall_is_not_decided(chapter, slip, decided):
    run = vi.simulate(chapter(0.0, 0.0), [-0.5, -1.5, 0, 0, 0, -slip, 0, 0], 1)
    assert run.certificate.decided is decided


def test_the_error_at_the_end_is_infinite_beyond_the_horizon(chapter):
    """The end of the run counts, even if the error at the last event is below that of the horizon."""
    system = chapter(0.3739, 0.337, kappa=0.8258, sigma_e_hat=-0.1085)
    start = [0.1673, 1.0926, -0.8364, -1.4416, -0.1314, -0.7658, 0.3382, 0.613]
    for cycles in range(33, 45):
        certificate = vi.simulate(system, start, cycles).certificate
        assert certificate.error <= HORIZON_ERROR or (np.isinf(certificate.error) and certificate.horizon < np.inf)
        assert np.isfinite(certificate.error) or not certificate.decided


REPEATED = {
    "stiff coupling": (
        dict(
            epsilon=0.010088749731344757, kappa=0.01, alpha12_hat=32172.86353208844, gamma1_hat=3.0, gamma2_hat=0.2,
            gamma12_hat=0.0, sigma20_hat=0.0, sigma_e_hat=0.0, f10_hat=2471.2935421077354, f20_hat=127.73302003798888,
        ), [0.2234, 0.8877, -0.0504, -0.4697, -0.5717, -0.4313, 0.5768, 0.5723], 20,
    ),
    "many impacts of a light ball": (
        dict(
            epsilon=0.0074, kappa=0.967, alpha12_hat=128.0, gamma1_hat=0.14, gamma2_hat=371.0, gamma12_hat=243.0,
            sigma20_hat=171.0, sigma_e_hat=-108.2, f10_hat=14.8, f20_hat=-12.8,
        ), [-0.23, -0.443, 0.276, 0.401, -3.36, 2.792, -1.015, -2.023], 1,
    ),
}  # fmt: skip


@pytest.mark.parametrize(("parameters", "start", "cycles"), REPEATED.values(), ids=REPEATED)
def test_the_estimate_covers_roundings_that_repeat_in_every_flight_or_impact(parameters, start, cycles):
    attack = Attack("repeated", vi.System(**parameters), np.array(start), 0.0)
    run = vi.simulate(attack.system, attack.start, cycles)
    assert run.certificate.decided
    assert np.abs(run.final - truth(attack, cycles=cycles).final).max() < run.certificate.error


@pytest.mark.parametrize(
    ("parameters", "start", "cycles"),
    [((0.5, 1 - 2**-53, -0.5), [0, 0, 0, 5.97389950059458], 300), ((2.778, 1 - 1e-14, -0.244), [0, 0.6, -7, 8.3], 300)],
    ids=["rounding of kappa times a speed", "one entry of the flow table"],
)
def test_the_estimate_covers_repeated_roundings_without_loss_of_energy(parameters, start, cycles):
    assert run_error_ratio(one_box(*parameters), start, cycles) < 1


def test_a_decided_run_of_25_000_impacts_without_loss_has_the_exact_number_of_impacts():
    """`run_error_ratio` compares the numbers of impacts, and returns None if the run is undecided."""
    ratio = run_error_ratio(one_box(0.5, 1 - 2**-53, -0.5), [0, 0, 0, 5.97389950059458], 1000)
    assert ratio is None or ratio < MAX_ERROR_RATIO


def test_the_error_of_a_module_without_events_is_not_overestimated(chapter):
    """Its box oscillates freely; roundings at the events of the uncoupled other module must not count for it."""
    system = chapter(0.0, 1.0, alpha12_hat=0.0, gamma12_hat=0.0, gamma1_hat=0.0)
    attack = Attack("free oscillation", system, np.array([0.5, 0, 0, 0, 0, 0, 0, 0.5]), 0.0)
    run = vi.simulate(system, attack.start, 300)
    assert len(run.events) > 500
    assert run.certificate.error < 50 * np.abs(run.final - truth(attack, cycles=300).final).max()


@pytest.mark.parametrize("copied", [lambda run: run, copy.deepcopy, lambda run: pickle.loads(pickle.dumps(run))])
def test_arrays_of_a_run_cannot_be_written_to(chapter, copied):
    original = vi.simulate(chapter(), np.zeros(8), 2, sample_times=[1.0])
    run = copied(original)
    np.testing.assert_array_equal(run.rows, original.rows)
    assert run.certificate == original.certificate
    energies = run.energy.work, run.energy.per_cycle
    for array in (run.start, run.samples, run.final, run.events, run.jacobian, run.rows, *energies):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_samples_far_from_time_zero_include_the_start_and_the_end(chapter):
    system, tau0 = chapter(), 1e12
    run = vi.simulate(system, np.zeros(8), 2, tau0, [tau0, tau0 + system.period, tau0 + 2 * system.period])
    np.testing.assert_array_equal(run.samples[[0, 2]], [np.zeros(8), run.final])


def test_errors_during_a_run_equal_the_errors_of_shorter_runs(chapter):
    system, cycles = chapter(0.5, 0.5), 60
    start = [0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.5]
    run = vi.simulate(system, start, cycles, tau0=0.4)
    times = run.tau0 + np.minimum(np.arange(1, cycles + 1) * system.period, float(run.end) - run.tau0)
    shorter = np.array([vi.simulate(system, start, n, tau0=0.4).certificate.error for n in range(1, cycles + 1)])
    finite, found = np.isfinite(shorter), run.errors(times)
    assert 20 < finite.sum() < cycles
    np.testing.assert_array_equal(np.isfinite(found), finite)
    excess = found[finite] - shorter[finite]
    assert (excess >= -1e-3 * found[finite]).all()
    # times of samples are rounded; no velocity exceeds 4
    assert (excess <= 4.0 * np.finfo(float).eps * (times - run.tau0)[finite]).all()
