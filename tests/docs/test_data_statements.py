"""What the data dictionary says of columns, computed anew from other columns of a build."""

import json

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.tables import read

EPSILON, KAPPA = PARAMETERS["epsilon"], PARAMETERS["kappa"]
RHO = 2 * (1 - KAPPA) / (np.pi * (1 + KAPPA))
SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}
OMEGA = 1 + EPSILON * PARAMETERS["sigma_e_hat"]
PERIOD = 2 * np.pi / OMEGA
SIDES = ("1_plus", "1_minus", "2_plus", "2_minus")


@pytest.fixture(scope="module")
def table(built):
    return lambda name: read(built / "results" / name)


def columns(table, name, ends=(1, 2)):
    return table[[f"{name}{end}" for end in ends]].to_numpy(float)


def test_C_of_an_orbit_is_half_of_what_the_saw_tooth_covers(table):
    """On a flight of a part u of the period with speed v the ball goes u T v, and back with the other speed."""
    orbits = table("orbits.csv")
    for module in (1, 2):
        plus, minus = (orbits[f"speed{module}_{side}"] for side in ("plus", "minus"))
        away = PERIOD * (orbits[f"phase{module}_minus"] - orbits[f"phase{module}_plus"]).mod(1.0)
        np.testing.assert_allclose(away * plus, (PERIOD - away) * minus, rtol=1e-8)
        np.testing.assert_allclose(orbits[f"C{module}"], (1 + EPSILON) / 2 * away * plus, rtol=1e-8)
        even = orbits[orbits["symmetric"]]
        speed = even[f"speed{module}_plus"]
        np.testing.assert_allclose(even[f"C{module}"], (1 + EPSILON) * np.pi * speed / (2 * OMEGA), rtol=1e-12)


def test_phases_are_fractions_and_symmetric_orbits_meet_the_other_wall_half_a_period_later(table):
    orbits = table("orbits.csv")
    phases = columns(orbits, "phase", SIDES)
    assert ((phases >= 0) & (phases < 1)).all()
    even = columns(orbits[orbits["symmetric"]], "phase", SIDES)
    np.testing.assert_allclose(np.mod(even[:, 1::2] - even[:, ::2], 1.0), 0.5, atol=1e-12)


def test_an_orbit_is_a_motion_with_the_impacts_and_multipliers_that_its_row_names(table):
    """The motion itself, integrated from the state of the library's orbit in the same place of the list."""
    for case, rows in table("orbits.csv").groupby("case", sort=False):
        for (_, row), orbit in zip(rows.iterrows(), vi.orbits(SYSTEMS[case]), strict=True):
            if not row["admissible"]:
                continue
            run = vi.simulate(SYSTEMS[case], orbit.state, 1)
            assert len(run.events) == 4
            for event in run.events:
                side = f"{event['module']}_{'plus' if event['wall'] > 0 else 'minus'}"
                apart = (event["tau"] / PERIOD - row[f"phase{side}"] + 0.5) % 1.0 - 0.5
                assert abs(apart) < 1e-8
                assert abs(event["state"][3 + 2 * event["module"]]) == pytest.approx(row[f"speed{side}"], rel=1e-8)
            moduli = np.sort(np.abs(np.linalg.eigvals(run.jacobian)))[::-1]
            np.testing.assert_allclose(moduli[:2], columns(row.to_frame().T, "modulus_")[0], rtol=1e-4)


def test_moduli_descend_and_decide(table):
    orbits = table("orbits.csv")
    moduli = columns(orbits, "modulus_", range(1, 9))
    assert (np.diff(moduli, axis=1) <= 0).all()
    assert ((moduli[:, 0] < 1) == (orbits["exact"] == "stable")).all()


def test_fixed_points_lie_on_the_manifold_and_criteria_say_what_their_limits_say(table):
    points = table("fixed_points.csv")
    C, B = columns(points, "C"), columns(points, "B")
    np.testing.assert_allclose(B**2, 1 - 2 * C + (1 + RHO**2) * C**2, rtol=1e-9)
    assert (np.abs(columns(points, "psi")) <= np.pi).all()
    for name in ("fixed_points.csv", "orbits.csv"):
        rows = table(name)
        C = columns(rows, "C")
        printed = (4 / (4 + np.pi * RHO) < C).all(axis=1)
        derived = ((C > 1 / (1 + RHO**2)) & (np.pi**2 / (np.pi**2 - 4) > C)).all(axis=1)
        assert ((rows["printed_10_26"] == "stable") == printed).all()
        assert ((rows["fast"] == "stable") == derived).all()


def test_the_orbit_of_a_fixed_point_is_the_nearest_symmetric_one(table):
    orbits = table("orbits.csv")
    for point in table("fixed_points.csv").itertuples():
        near = orbits[(orbits["case"] == point.case) & orbits["symmetric"]]
        gaps = np.hypot(near["C1"] - point.C1, near["C2"] - point.C2)
        assert near.loc[gaps.idxmin(), ["label", "exact"]].tolist() == [point.orbit, point.floquet]


@pytest.mark.parametrize("run", ["equal/float64", "weak/reference"])
def test_a_simulated_window_is_evenly_spaced_and_its_events_are_at_the_walls(built, table, run):
    folder = f"simulations/{run}"
    samples, strobe, events = (table(f"{folder}/{name}.csv") for name in ("samples", "strobe", "events"))
    summary = json.loads((built / f"results/{folder}/summary.json").read_text(encoding="utf-8"))
    np.testing.assert_allclose(np.diff(samples["tau"]), np.diff(samples["tau"]).mean(), rtol=1e-9)
    np.testing.assert_allclose(strobe["tau"], PERIOD * np.arange(len(strobe)), atol=1e-9)
    assert samples["tau"].iloc[[0, -1]].tolist() == summary["window"]
    assert samples.iloc[-1, 1:].tolist() == summary["final"]
    for event in events.to_dict("records"):
        module = event["module"]
        assert event[f"X{module}"] - event[f"Y{module}"] == pytest.approx(event["wall"], abs=1e-12)
        assert (event[f"dX{module}"] - event[f"dY{module}"]) * event["wall"] < 0  # away from it, after an impact
    assert events["tau"].is_monotonic_increasing
    assert len(events) == sum(count for kinds in summary["events"].values() for count in kinds.values())


def test_velocities_are_rates_of_displacements(table):
    """In free flight, between samples that have no event between them."""
    samples, events = (table(f"simulations/equal/float64/{name}.csv") for name in ("samples", "events"))
    tau = samples["tau"].to_numpy()
    free = np.diff(np.searchsorted(events["tau"], tau)) == 0
    for name in ("X1", "Y1", "X2", "Y2"):
        slope = np.diff(samples[name]) / np.diff(tau)
        middle = (samples[f"d{name}"].to_numpy()[1:] + samples[f"d{name}"].to_numpy()[:-1]) / 2
        np.testing.assert_allclose(slope[free], middle[free], atol=2e-4)


def test_statistics_of_the_modulated_response_are_those_of_its_samples(table):
    statistics, samples = table("figures/fig10_11.statistics.csv"), table("simulations/weak/reference/samples.csv")
    for row in statistics.to_dict("records"):
        cycles = samples[row["displacement"]].to_numpy()[:-1].reshape(-1, 40)
        amplitudes = np.ptp(cycles, axis=1) / 2
        assert row["smallest amplitude"] == pytest.approx(amplitudes.min(), rel=1e-12)
        assert row["largest amplitude"] == pytest.approx(amplitudes.max(), rel=1e-12)
        assert row["amplitude variation"] == pytest.approx(amplitudes.std() / amplitudes.mean(), rel=1e-12)
        assert row["modulation periods"] * row["mean length in cycles"] <= len(amplitudes)


def test_the_model_in_use_meets_its_tolerance_and_the_reference_has_no_error(table):
    models = table("accuracy/models.csv")
    assert (models.groupby("figure")["in_use"].sum() == 1).all()
    assert (models["error"] <= models["tolerance"])[models["in_use"]].all()
    assert not models["error"][models["model"].isin(["exact_orbit", "reference"])].any()


def test_verdicts_on_methods_follow_from_their_numbers(table):
    judged = table("accuracy/stress_tests.csv")
    good = (judged["error_state"] <= 0.01) & (judged["missed"] == 0) & (judged["spurious"] == 0)
    assert good[judged["verdict"] == "right"].all()
    assert not good[judged["verdict"] == "silently wrong"].any()
    failed = judged["verdict"].isin(["refused with an error", "did not finish", "unavailable"])
    assert (judged["error_state"].isna() == failed).all()


def test_errors_of_the_chart_belong_to_runs_with_a_final_state(table):
    chart = table("accuracy/work_precision.csv")
    known = np.isfinite(chart["error_state"])
    assert (known == (chart["outcome"] == "finished")).all()
