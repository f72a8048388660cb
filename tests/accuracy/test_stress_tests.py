"""Stress tests have the properties that their names state, and their verdicts follow from the results of runs."""

import numpy as np
import pytest

from vibroimpact.accuracy import stress_tests
from vibroimpact.accuracy.grazing import grazing_start
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.integrators import METHODS
from vibroimpact.integrators.protocol import REFUSED, UNFINISHED, Method, MethodRun
from vibroimpact.system import System

SYSTEM = System(**stress_tests.CHAPTER)
BOXES, VELOCITY = ("0.4", "-0.3", "0.5", "0.2"), "0.15"
ENGINE = METHODS[0]


@pytest.mark.parametrize("digits", [2, 14])
def test_grazing_starts_clear_or_hit_the_wall_by_the_given_distance(digits):
    clears = grazing_start(SYSTEM, BOXES, VELOCITY, 1.0, f"1e-{digits}")
    hits = grazing_start(SYSTEM, BOXES, VELOCITY, 1.0, f"-1e-{digits}")
    times = np.linspace(0.4, 0.9, 400)
    run = proven_run(SYSTEM, clears, 1, sample_times=times).run
    gap = 1.0 - (run.samples[:, 0] - run.samples[:, 1])
    assert not (run.events["module"] == 1).any()
    assert gap.min() == pytest.approx(10.0**-digits, abs=1e-6)  # the sampling misses the maximum by up to 1e-7
    first = proven_run(SYSTEM, hits, 1).run.events[0]
    assert (first["module"], first["wall"], first["kind"]) == (1, 1, 0)


def test_a_grazing_start_needs_a_maximum():
    with pytest.raises(ValueError, match="guess"):
        grazing_start(SYSTEM, BOXES, VELOCITY, 3.9, "1e-3")


@pytest.mark.parametrize(
    "test", [one for one in stress_tests.stress_tests() if one.quick], ids=lambda one: f"{one.group}: {one.name}"
)
def test_the_engine_is_right_or_in_grazing_undecided(test):
    (row,) = stress_tests.judge(test, [ENGINE])
    assert row["verdict"] in (stress_tests.RIGHT, stress_tests.UNDECIDABLE)
    if row["verdict"] == stress_tests.RIGHT:
        assert row["error_state"] < 1e-7
    if test.group != "grazing":
        assert row["verdict"] == stress_tests.RIGHT


class Scripted(Method):
    """A method that returns a given result."""

    name, family, knob, settings, careful = "scripted", "test", "none", (0,), 0

    def run(self, system, state, cycles, tau0, setting):
        return self.result


@pytest.mark.parametrize(
    ("result", "verdict"),
    [
        (MethodRun(np.zeros(8), [], 1), stress_tests.RIGHT),
        (MethodRun(np.full(8, 0.02), [], 1), stress_tests.SILENTLY_WRONG),
        (MethodRun(np.full(8, np.nan), [], 1), stress_tests.SILENTLY_WRONG),
        (MethodRun(np.zeros(8), [(1.0, 1, 1, 0.5)], 1), stress_tests.SILENTLY_WRONG),
        (MethodRun(np.full(8, 0.02), [], 1, doubt=lambda: "unsure"), stress_tests.UNDECIDABLE),
        (MethodRun(None, [], 1, outcome=REFUSED, reason="no"), stress_tests.ERROR),
        (MethodRun(None, [], 1, outcome=UNFINISHED, reason="long"), stress_tests.ENDLESS),
    ],
)
def test_the_verdict_follows_from_the_result(result, verdict):
    at_rest = stress_tests.StressTest("test", "rest", SYSTEM.with_(f10_hat=0.0, f20_hat=0.0), stress_tests.REST, 1)
    scripted = Scripted()
    scripted.result = result
    (row,) = stress_tests.judge(at_rest, [scripted])
    assert (row["test"], row["verdict"], row["reason"]) == ("rest", verdict, result.reason or result.doubt())


def test_a_motion_that_has_not_settled_is_refused_as_a_reference():
    moving = stress_tests.StressTest("test", "transient", SYSTEM, stress_tests.REST, 1000, reference_cycles=3)
    with pytest.raises(ArithmeticError, match="still changes"):
        stress_tests.reference_of(moving)
