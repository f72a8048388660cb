"""The motion of a fixed point by each model agrees with simulations, with errors of the expected order in epsilon."""

from typing import get_args

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, system_of
from vibroimpact.accuracy.model_choice import CHOICES, MODELS, motion, motions
from vibroimpact.accuracy.window import window
from vibroimpact.theory.fixed_points.table import fixed_point_table, labelled_points
from vibroimpact_pipeline.config import figures


def motions_by(model, system):
    return motions(system, labelled_points(fixed_point_table("", system)), model)


def test_the_config_offers_all_models_and_describes_them():
    sections = figures.FixedPoints, figures.Response, figures.SimulatedMotion
    for notebook, section in zip(("fixed_points", "theoretical_response", "simulation"), sections, strict=True):
        model = section.model_fields["model"]
        assert get_args(model.annotation) == CHOICES[notebook]
        assert all(name in model.description for name in get_args(model.annotation))
    assert {model for models in CHOICES.values() for model in models} == set(MODELS)


@pytest.mark.parametrize("case", FORCES)
def test_the_motion_of_an_exact_orbit_is_that_of_a_run_from_its_state(case):
    """All coordinates over a period and the times of the impacts at W = +1 agree."""
    system = system_of(case)
    tau = np.linspace(0.0, system.period, 50)
    orbits = [orbit for orbit in vi.orbits(system) if orbit.symmetric]
    for found in motions_by("exact_orbit", system):
        orbit = min(orbits, key=lambda orbit: np.abs(orbit.C - found.point.C).max())
        run, shown = vi.simulate(system, orbit.state, 1, sample_times=tau), found.response(tau)
        X, Y = run.samples[:, [0, 2]], run.samples[:, [1, 3]]
        for value, simulated in ((shown.X, X), (shown.Y, Y), (shown.W, X - Y), (shown.U, X + system.epsilon * Y)):
            np.testing.assert_allclose(value, simulated, atol=1e-9)
        for module in (1, 2):
            (at,) = run.events["tau"][(run.events["module"] == module) & (run.events["wall"] == 1)]
            assert found.impacts[module - 1] == pytest.approx(at, abs=1e-9)
        harmonic = 2 * np.mean(shown.U[:-1] * np.exp(1j * system.Omega * tau[:-1, None]), axis=0)
        np.testing.assert_allclose(found.point.B, np.abs(harmonic), atol=1e-5)


@pytest.mark.parametrize("case", FORCES)
def test_the_error_of_the_slow_flow_is_of_order_epsilon_and_with_the_second_term_of_order_epsilon_squared(case):
    errors = {}
    for epsilon in (4e-3, 2e-3):
        system = system_of(case, epsilon=epsilon)
        tau = np.linspace(0.0, system.period, 100)
        exact = [one.response(tau) for one in motions_by("exact_orbit", system)]
        for model in ("slow_flow", "second_term"):
            for found, truth in zip(motions_by(model, system), exact, strict=True):
                shown = found.response(tau)
                error = max(np.abs(getattr(shown, name) - getattr(truth, name)).max() for name in "UXWY")
                errors.setdefault((model, found.point.label), []).append(error)
    for (model, label), (more, less) in errors.items():
        assert np.log2(more / less) == pytest.approx({"slow_flow": 1, "second_term": 2}[model], abs=0.1), label


@pytest.mark.parametrize("model", CHOICES["theoretical_response"])
def test_a_single_machine_has_the_motion_of_an_uncoupled_module(model):
    uncoupled = system_of("equal", alpha12_hat=0.0, gamma12_hat=0.0, f10_hat=1.5, f20_hat=1.4)
    tau = np.linspace(0.0, uncoupled.period, 20)
    (alone,) = motions_by(model, uncoupled.with_(f20_hat=0.0))
    together = min(motions_by(model, uncoupled), key=lambda one: abs(one.point.C[0] - alone.point.C[0]))
    for name in "UXWY":
        shown = getattr(alone.response(tau), name)
        np.testing.assert_allclose(shown[:, 0], getattr(together.response(tau), name)[:, 0], atol=1e-8)
        assert not shown[:, 1].any()
    assert np.isnan([*(getattr(alone.point, name)[1] for name in ("C", "B", "psi")), alone.impacts[1]]).all()


def test_points_without_an_exact_orbit_and_unsupported_models_are_refused_in_one_line():
    """C1 = 9 is further from every orbit than any orbit is from its point."""
    system, settings = system_of("weak"), {"transient_cycles": 0, "window_cycles": 1, "samples_per_cycle": 8}
    table = fixed_point_table("weak", system).assign(C1=9.0)
    assert motion(system, table, "a", "slow_flow").point.C[0] == 9.0
    for label, model, text in (
        ("a", "exact_orbit", r"\Amodel: exact_orbit has no orbit next to fixed point 'a'"),
        ("a", "float64", r"\Amodel: 'float64' should be slow_flow, exact_orbit or second_term\Z"),
        ("z", "exact_orbit", r"\Afixed_point: "),
    ):
        with pytest.raises(ValueError, match=text):
            motion(system, table, label, model)
    with pytest.raises(ValueError, match=r"\Amodel: 'slow_flow' should be float64 or reference\Z"):
        window(system, settings | {"initial_state": [0.0] * 8, "model": "slow_flow"})


def test_the_model_determines_the_arithmetic_and_the_case_its_digits():
    system = system_of("equal")
    settings = {"initial_state": [0.0] * 8, "transient_cycles": 0, "window_cycles": 2, "samples_per_cycle": 8}
    for digits, choice in ((None, {}), (50, {"digits": 50})):
        trusts = [window(system, settings | choice | {"model": model}).trust for model in CHOICES["simulation"]]
        assert [trust["method"] for trust in trusts] == ["float64", "arbitrary precision"]
        assert trusts[1]["digits"] == [digits or 40, 2 * (digits or 40)]
