"""Test that columns of built tables have the meaning that the data dictionary states."""

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
    """Return a function that reads a table of the results by name."""
    return lambda name: read(built / "results" / name)


def columns(table, name, ends=(1, 2)):
    """Return the columns of a table whose names are a common name followed by one of the ends, as an array."""
    return table[[f"{name}{end}" for end in ends]].to_numpy(float)


def test_C_of_an_orbit_is_half_the_range_of_its_sawtooth(table):
    """Both flights of a ball cover the same distance, duration times speed; the range is 1 + epsilon times as large."""
    orbits = table("orbits.csv")
    for module in (1, 2):
        plus, minus = (orbits[f"speed{module}_{side}"] for side in ("plus", "minus"))
        duration = PERIOD * (orbits[f"phase{module}_minus"] - orbits[f"phase{module}_plus"]).mod(1.0)
        np.testing.assert_allclose(duration * plus, (PERIOD - duration) * minus, rtol=1e-8)
        np.testing.assert_allclose(orbits[f"C{module}"], (1 + EPSILON) / 2 * duration * plus, rtol=1e-8)
        symmetric = orbits[orbits["symmetric"]]
        C = (1 + EPSILON) * np.pi * symmetric[f"speed{module}_plus"] / (2 * OMEGA)
        np.testing.assert_allclose(symmetric[f"C{module}"], C, rtol=1e-12)


def test_phases_are_fractions_of_a_period_and_flights_of_symmetric_orbits_last_half_a_period(table):
    orbits = table("orbits.csv")
    phases, moduli = columns(orbits, "phase", SIDES), columns(orbits, "modulus_", range(1, 9))
    assert ((phases >= 0) & (phases < 1)).all()
    assert (np.diff(moduli, axis=1) <= 0).all()
    flights = np.mod(phases[:, 1::2] - phases[:, ::2], 1.0)
    np.testing.assert_allclose(flights[orbits["symmetric"]], 0.5, atol=1e-12)


def test_a_simulated_orbit_has_the_impacts_and_multipliers_of_its_row(table):
    """The simulation starts from the state of the orbit with the same index in `vi.orbits`."""
    for case, rows in table("orbits.csv").groupby("case", sort=False):
        for (_, row), orbit in zip(rows.iterrows(), vi.orbits(SYSTEMS[case]), strict=True):
            if not row["admissible"]:
                continue
            run = vi.simulate(SYSTEMS[case], orbit.state, 1)
            assert len(run.events) == 4
            for event in run.events:
                side = f"{event['module']}_{'plus' if event['wall'] > 0 else 'minus'}"
                phase_error = (event["tau"] / PERIOD - row[f"phase{side}"] + 0.5) % 1.0 - 0.5
                assert abs(phase_error) < 1e-8
                assert abs(event["state"][3 + 2 * event["module"]]) == pytest.approx(row[f"speed{side}"], rel=1e-8)
            moduli = np.sort(np.abs(np.linalg.eigvals(run.jacobian)))[::-1]
            np.testing.assert_allclose(moduli[:2], columns(row.to_frame().T, "modulus_")[0], rtol=1e-4)


def test_fixed_points_lie_on_the_manifold_and_verdicts_of_criteria_follow_from_their_limits(table):
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


@pytest.mark.parametrize("run", ["equal/float64", "weak/reference"])
def test_samples_of_a_window_are_evenly_spaced_and_events_are_at_the_walls(built, table, run):
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
        assert (event[f"dX{module}"] - event[f"dY{module}"]) * event["wall"] < 0  # the ball moves away from the wall
    assert events["tau"].is_monotonic_increasing
    assert len(events) == sum(count for kinds in summary["events"].values() for count in kinds.values())
