"""Results as tables, pictures and sections, and public names of proofs."""

import pickle

import numpy as np
import pytest

import vibroimpact as vi
from chapter import system_of
from vibroimpact import frames

SYSTEM = system_of("unequal")
RUN = vi.simulate(SYSTEM, [0.0] * 8, 60, tau0=2.0)


def test_fixed_points_have_the_labels_of_the_figures_and_their_stability():
    """In the order of C_1 the labels are a, c, b; impacts make a unstable, the slow flow b."""
    points = vi.fixed_points(system_of("equal"))
    assert [point.label for point in points] == ["a", "c", "b"]
    assert [point.stability for point in points] == [
        ("unstable", "stable"), ("stable", "stable"), ("stable", "unstable")
    ]  # fmt: skip
    assert [point.stability.theory for point in points] == ["unstable", "stable", "unstable"]
    assert "label=c, stability=stable (fast stable, slow stable)" in repr(points[1])
    frame = vi.to_frame(points)
    assert frame["label"].tolist() == ["a", "c", "b"]
    np.testing.assert_array_equal(frame[["C1", "C2"]], [point.C for point in points])
    assert (frame["slow_growth"] < 0).tolist() == [point.stability.slow == "stable" for point in points]


def test_orbits_state_their_stability_and_whether_it_is_proved():
    found = [orbit for orbit in vi.orbits(SYSTEM) if orbit.symmetric]
    for orbit in found:
        proved = orbit.with_proof()
        stable = np.abs(np.linalg.eigvals(orbit.passage.jacobian)).max() < 1
        assert orbit.stable == proved.stable == stable
        assert (orbit.proved, proved.proved) == (False, True)
        assert f"stable={stable} (computed)" in repr(orbit)
        assert f"stable={stable} (proved)" in repr(proved)
    np.testing.assert_array_equal(vi.to_frame(found)["phase2_minus"], [one.impact_phases[1, 1] for one in found])
    with pytest.raises(ValueError, match=r"^orbit: .* is not an Orbit$"):
        vi.prove(SYSTEM)


def test_tables_of_runs_and_ensembles_contain_their_values():
    frame = RUN.to_frame()
    assert frame.equals(vi.to_frame(RUN))
    assert set(frame["kind"]) == {"impact"}
    np.testing.assert_array_equal(frame["dY2"], RUN.events["state"][:, 7])
    relative = frame["X1"] - frame["Y1"]
    np.testing.assert_allclose(relative[frame["module"] == 1], frame["wall"][frame["module"] == 1], atol=1e-12)
    outcome = vi.ensemble(SYSTEM, np.zeros((3, 8)), 20, settle=10, energy=True)
    frame = vi.to_frame(outcome)
    np.testing.assert_array_equal(frame["largest2"], outcome["largest"][:, 1])
    np.testing.assert_array_equal(frame["dY1"], outcome["final"][:, 5])
    np.testing.assert_array_equal(frame["energy_work1"], outcome["energy"]["work"][:, 0])
    for other in (3.0, [SYSTEM], np.zeros(3)):
        with pytest.raises(ValueError, match=r"^result: unsupported type"):
            vi.to_frame(other)


def test_a_section_has_the_states_at_the_start_and_after_each_cycle():
    expected = vi.simulate(SYSTEM, RUN.start, RUN.cycles, RUN.begin, RUN.tau0 + np.arange(RUN.cycles) * SYSTEM.period)
    np.testing.assert_allclose(RUN.section(), [*expected.samples, RUN.final], rtol=0, atol=1e-11)


@pytest.mark.parametrize(("sigma", "before"), [(0.3, 9_999_999), (-0.17, 123_457), (-2.3, 1)])
def test_a_section_does_not_change_if_the_run_starts_whole_periods_later(sigma, before):
    system = SYSTEM.with_(sigma_e_hat=sigma)
    start, cycles = [0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, -0.5], 3
    expected = vi.simulate(system, start, cycles).section()
    end = vi.simulate(system, start, 0).end.later(before, system.Omega)
    np.testing.assert_array_equal(vi.simulate(system, start, cycles, tau0=end).section(), expected)
    rounded = vi.simulate(system, start, cycles, tau0=before * system.period).section()
    np.testing.assert_allclose(rounded, expected, rtol=0, atol=1e-6)


def test_a_picture_of_a_run_shows_boxes_and_balls_between_the_walls():
    times = RUN.tau0 + np.linspace(0.0, RUN.cycles * SYSTEM.period, 64 * RUN.cycles + 1)
    samples = vi.simulate(SYSTEM, RUN.start, RUN.cycles, RUN.begin, times).samples
    figure = RUN.plot()
    for i, axes in enumerate(figure.axes):
        W, X = (line.get_ydata() for line in axes.get_lines())
        np.testing.assert_allclose(W, samples[:, 2 * i] - samples[:, 2 * i + 1], rtol=0, atol=1e-12)
        np.testing.assert_allclose(X, samples[:, 2 * i], rtol=0, atol=1e-12)
        assert np.abs(W).max() <= 1 + 1e-9


@pytest.mark.parametrize("call", [vi.fixed_points, vi.orbits])
def test_an_empty_table_has_the_same_columns(call):
    """With so much damping no motion has two impacts per cycle."""
    found, empty = call(SYSTEM), call(SYSTEM.with_(gamma1_hat=100.0, gamma2_hat=100.0))
    assert len(found) > 0 == len(empty)
    for one in (empty, pickle.loads(pickle.dumps(empty))):
        assert vi.to_frame(one).columns.tolist() == vi.to_frame(found).columns.tolist()


def test_the_error_for_a_physical_system_names_the_method_that_converts_it():
    plant = vi.PhysicalSystem.single(M=120.0, m=12.0, k=2e5, c=90.0, F=100.0, L=0.005)
    with pytest.raises(ValueError, match=r"^system: a PhysicalSystem is not a System; call \.dimensionless\(\)$"):
        vi.fixed_points(plant)


@pytest.mark.parametrize(
    ("call", "package"), [(lambda: vi.to_frame([]), "pandas"), (lambda: frames.plot(None, None, None), "matplotlib")]
)
def test_an_error_without_pandas_or_matplotlib_names_the_extra(monkeypatch, call, package):
    monkeypatch.setattr("vibroimpact.system.extras.find_spec", lambda name: None)
    with pytest.raises(ModuleNotFoundError, match=rf"needs {package}: pip install '\.\[figures\]'$"):
        call()


def test_parameters_that_move_together_share_a_dimension():
    places = [(f, k) for f in (1.0, 2.0) for k in (0.3, 0.5)]
    rows = [{"f10_hat": f, "f20_hat": f / 2, "kappa": k, "peak": 10 * f + k} for f, k in places]
    data = vi.to_dataset(rows, [("f10_hat", "f20_hat"), "kappa"])
    assert data["f20_hat"].dims == ("f10_hat",)
    assert data["f20_hat"].values.tolist() == [0.5, 1.0]
    assert data["peak"].sel(f10_hat=2.0, kappa=0.3) == 20.3
    with pytest.raises(ValueError, match=r"^along: 'mass' is not one of the columns"):
        vi.to_dataset(rows, ["mass"])
    with pytest.raises(ValueError, match=r"^rows: expected one row per point"):
        vi.to_dataset(rows, ["kappa"])
