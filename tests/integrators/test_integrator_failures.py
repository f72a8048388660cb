"""Methods that fail return a reason; a limit on the number of steps stops endless runs."""

import numpy as np
import pytest

from vibroimpact.accuracy.stress_tests import ENDLESS, RIGHT, SILENTLY_WRONG, judge, stress_tests
from vibroimpact.integrators import moreau_jean
from vibroimpact.integrators.leading_order import LeadingOrder
from vibroimpact.integrators.protocol import REFUSED, UNFINISHED
from vibroimpact.integrators.right_hand_side import coefficients


@pytest.mark.parametrize("name", ["heyoka", "RK45", "LSODA", "Moreau-Jean", "penalty", "Ivanov", "Ivanov, events"])
def test_the_number_of_steps_is_limited(name, method, motion, monkeypatch):
    system, state, _, _ = motion("periodic")
    rival = method(name)
    monkeypatch.setattr(rival, "limit", 20)
    run = rival.run(system, state, 50, 0.0, rival.settings[0])
    assert run.final is None
    assert run.outcome == UNFINISHED
    assert run.steps < 1000  # the limit is tested after each flight or cycle
    assert run.reason


def test_the_leading_order_is_refused_without_a_stable_response(motion):
    system, state, cycles, _ = motion("chatter")
    run = LeadingOrder().run(system, state, cycles, 0.0, 0)
    assert run.outcome == REFUSED
    assert "fixed point" in run.reason


def test_ivanov_s_method_with_events_does_not_finish_a_chatter(method, motion):
    system, state, cycles, reference = motion("chatter")
    run = method("Ivanov, events").run(system, state, cycles, 0.0, 10)
    assert run.outcome == UNFINISHED
    end = run.impacts["tau"][-1]
    rest = reference.events["tau"][reference.events["kind"] == 1][0]
    assert end == pytest.approx(rest, abs=1e-4)
    assert f"at tau = {rest:.3g}" in run.reason[:40]


@pytest.mark.parametrize(
    ("name", "verdicts"),
    [
        ("hits by 1e-6", {"penalty": SILENTLY_WRONG, "Hunt-Crossley": SILENTLY_WRONG, "Ivanov, events": RIGHT}),
        ("stick and release", {"power law": SILENTLY_WRONG, "Hertz": RIGHT, "Ivanov, events": ENDLESS}),
        ("kappa = 1e-3", {"Ivanov": SILENTLY_WRONG, "power law": RIGHT}),
    ],
)
def test_verdicts_show_the_limits_of_each_model_of_an_impact(name, verdicts, method):
    problem = next(one for one in stress_tests() if one.name == name)
    found = judge(problem, [method(one) for one in verdicts])
    assert {row["method"]: row["verdict"] for row in found} == verdicts


def test_impacts_of_both_modules_in_one_step_of_moreau_and_jean_obey_newton_s_rule(motion):
    """The step is long and the damper between the boxes is strong."""
    system = motion("periodic")[0].with_(gamma12_hat=50.0)
    before = np.array([0.95, 0.0, -0.95, 0.0, 1.0, -1.0, -0.5, 1.5])
    after = moreau_jean._march(coefficients(system), before, 0.0, 0.2, 1)[0]
    np.testing.assert_allclose(after[[4, 6]] - after[[5, 7]], -system.kappa * np.array([2.0, -2.0]), rtol=1e-12)
