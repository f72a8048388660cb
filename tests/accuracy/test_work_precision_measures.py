"""Errors of impact sequences, fitted orders, and rows of the work-precision chart are right."""

from types import SimpleNamespace

import numpy as np
import pytest

from chapter import system_of
from vibroimpact.accuracy.errors import run_errors
from vibroimpact.accuracy.work_precision import Problem, fitted_order, measure
from vibroimpact.integrators.protocol import IMPACT, REFUSED, Method, MethodRun, failed
from vibroimpact.system.state import EVENT

SYSTEM = system_of("equal")
PROBLEM = Problem("settled", SYSTEM, (-0.0863, 0.3689, -0.4889, -0.7167, -0.1597, -0.6893, -0.3681, -1.2869), 2)


def reference(times, speeds):
    """Return a run with impacts of module 1 at wall +1, with given times and rebound speeds."""
    events = np.zeros(len(times), EVENT)
    events["tau"], events["module"], events["wall"], events["state"][:, 4] = times, 1, 1, speeds
    return SimpleNamespace(final=np.zeros(8), events=events)


def impacts(*times):
    return np.array([(t, 1, 1, 1.0) for t in times], IMPACT)


@pytest.mark.parametrize(
    ("found", "times", "missed", "spurious"),
    [
        ((1.02, 2.0, 2.99), 0.02, 0, 0),
        ((1.0, 3.0), 0.0, 1, 0),
        ((1.0, 1.5, 2.0, 3.0), 0.0, 0, 1),
        ((1.0, 2.5), 0.0, 2, 1),
    ],
)
def test_impacts_are_paired_in_order_and_by_their_walls(found, times, missed, spurious):
    expected, listed = reference((1.0, 2.0, 3.0), 1.0), impacts(*found)
    errors = run_errors(MethodRun(np.zeros(8), listed, 1), expected, period=1.0)
    assert (errors.missed, errors.spurious, errors.error_time) == (missed, spurious, pytest.approx(times))
    listed["wall"] = -1
    errors = run_errors(MethodRun(np.zeros(8), listed, 1), expected, period=1.0)
    assert (errors.missed, errors.spurious) == (3, len(found))


def test_missed_or_spurious_slow_impacts_at_the_end_of_a_chatter_do_not_count():
    tail = reference((1.0, 1.1, 1.101), (0.5, 5e-4, 5e-5))
    for found in (impacts(1.0), impacts(1.0, 1.1), impacts(1.0, 1.1, 1.1005, 1.1008)):
        errors = run_errors(MethodRun(np.zeros(8), found, 1), tail, period=1.0)
        assert (errors.missed, errors.spurious) == (0, 0)
    strict = run_errors(MethodRun(np.zeros(8), impacts(1.0), 1), tail, period=1.0, faint=0.0)
    assert strict.missed == 2


def test_the_order_is_fitted_only_to_errors_above_rounding():
    scales = np.geomspace(1.0, 1e-4, 9)
    points = [(h, max(1e-2 * h**3, 1e-13)) for h in scales]
    assert fitted_order(points) == pytest.approx(3.0, abs=0.05)
    assert fitted_order(points[-3:]) is None


class Refusing(Method):
    name, family, knob, settings, careful = "refusing", "test", "none", (1, 2), 1

    def run(self, system, state, cycles, tau0, setting):
        self.seen.append(setting)
        return failed(REFUSED, "not today", 3)


class Missing(Refusing):
    name = "missing"

    def available(self):
        return "not installed"


@pytest.mark.parametrize(("compiles", "settings"), [(False, [1, 1, 2]), (True, [1, 2, 1, 2])])
def test_failed_methods_have_rows_and_compiled_settings_run_once_before_the_timing(compiles, settings):
    refusing = Refusing()
    refusing.compiles_settings, refusing.seen = compiles, []
    rows = measure(PROBLEM, [refusing, Missing()], seconds=0.0)
    assert [(row["method"], row["outcome"], row["reason"]) for row in rows] == [
        ("refusing", "refused", "not today"),
        ("refusing", "refused", "not today"),
        ("missing", "unavailable", "not installed"),
    ]
    assert refusing.seen == settings
