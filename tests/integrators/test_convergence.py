"""All methods converge to the reference in easy motions, with the order that theory predicts."""

import numpy as np
import pytest

from vibroimpact.accuracy.errors import run_errors
from vibroimpact.accuracy.work_precision import fitted_order
from vibroimpact.integrators.protocol import FINISHED

# name, settings from coarse to fine, bound on the error of the final state with the finest setting
SETTINGS = [
    ("heyoka", (1e-4, 1e-8, 1e-12), 1e-10),
    ("RK4, compiled", (32, 128, 1_024), 1e-9),
    ("RK45", (1e-4, 1e-6, 1e-8), 1e-6),
    ("DOP853", (1e-5, 1e-8, 1e-11), 1e-9),
    ("Radau", (1e-3, 1e-5, 1e-7), 1e-6),
    ("LSODA", (1e-4, 1e-7, 1e-10), 1e-7),
    ("Moreau-Jean", (100, 1_000, 10_000), 5e-3),
    ("penalty", (1e-2, 1e-3, 1e-5), 1e-4),
    ("Hertz", (1e-2, 1e-3, 1e-5), 1e-4),
    ("Hunt-Crossley", (1e-2, 1e-3, 1e-5), 1e-4),
    ("power law", (30, 300, 10_000), 5e-4),
    ("Ivanov", (100, 1_000, 30_000), 5e-4),
    ("Ivanov, events", (10, 100, 3_000), 1e-11),
]


def errors(method, motion, setting):
    system, state, cycles, reference = motion
    run = method.run(system, state, cycles, 0.0, setting)
    assert run.outcome == FINISHED
    return run_errors(run, reference, system.period)


@pytest.mark.parametrize(("name", "settings", "finest"), SETTINGS)
def test_the_error_decreases_with_finer_settings_and_no_impact_is_missed(name, settings, finest, method, motion):
    found = [errors(method(name), motion("periodic"), setting) for setting in settings]
    final = [error.error_state for error in found]
    assert final == sorted(final, reverse=True)
    assert final[-1] < finest
    assert (found[-1].missed, found[-1].spurious) == (0, 0)


ORDERLY = "Moreau-Jean", "penalty", "Hertz", "Hunt-Crossley", "power law", "Ivanov, events", "RK4, compiled", "RK45"


@pytest.mark.parametrize("name", ORDERLY)
def test_the_order_of_convergence_is_that_of_theory(name, method, motion):
    rival = method(name)
    system, state, cycles, reference = motion("periodic")
    points = []
    for setting in rival.settings:
        run = rival.run(system, state, cycles, 0.0, setting)
        points.append((rival.scale(setting, run), run_errors(run, reference, system.period).error_state))
    assert fitted_order(points) == pytest.approx(rival.order, rel=0.2)


def test_ivanov_s_method_is_of_first_order_if_jumps_are_not_located(method, motion):
    """The error depends on the place of the jump in a step, so that it is averaged over similar numbers of steps."""
    means = []
    for steps in (100, 1_000, 10_000):
        settings = (steps + n * steps // 100 for n in range(20))
        found = [errors(method("Ivanov"), motion("periodic"), setting).error_state for setting in settings]
        means.append(np.sqrt(np.mean(np.square(found))))
    assert -np.diff(np.log10(means)) == pytest.approx(1.0, abs=0.25)


CHATTER = {"heyoka": 1e-11, "RK4, compiled": 1e-9, "DOP853": 1e-9, "penalty": 1e-3, "Moreau-Jean": 1e-2, "Ivanov": 1e-3}


@pytest.mark.parametrize(("name", "allowed"), CHATTER.items())
def test_chatter_sticking_and_release_are_followed(name, allowed, method, motion):
    rival = method(name)
    found = errors(rival, motion("chatter"), rival.careful)
    assert found.error_state < allowed
    assert (found.missed, found.spurious) == (0, 0)


@pytest.mark.parametrize(("name", "allowed"), [("this engine", 1e-13), ("modal scan", 1e-12)])
def test_methods_with_exact_flights_are_exact_to_rounding_at_every_setting(name, allowed, method, motion):
    for setting in method(name).settings:
        for difficult in ("periodic", "chatter"):
            found = errors(method(name), motion(difficult), setting)
            assert found.error_state < allowed
            assert (found.missed, found.spurious) == (0, 0)


def test_methods_use_the_time_of_the_start(method, motion):
    """The run from minus the state half a period later is minus the run."""
    system, state, cycles, _ = motion("periodic")
    for name in ("modal scan", "heyoka", "RK4, compiled", "DOP853", "Moreau-Jean", "penalty", "power law", "Ivanov"):
        rival = method(name)
        setting = rival.settings[-2]
        one = rival.run(system, state, cycles, 0.0, setting).final
        other = rival.run(system, [-value for value in state], cycles, 0.5 * system.period, setting).final
        assert np.abs(one + other).max() < 1e-5  # the tolerance of the compliant methods
