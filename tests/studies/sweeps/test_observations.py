"""Rows of a sweep agree with direct calls of the library."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.studies.absorbers.peaks import peak
from vibroimpact.studies.regimes.classification import REGIMES
from vibroimpact.studies.regimes.classification import starts as spread_starts
from vibroimpact.studies.regimes.settling import Observation, settle
from vibroimpact.studies.sweeps import observations
from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.studies.sweeps.observations import OBSERVATIONS, observed
from vibroimpact.studies.sweeps.rows import rows
from vibroimpact.studies.sweeps.spec import Spec

BASE = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
GRID = Grid(BASE, [axis(["f20_hat"], listed=[0.89, 1.0])])
OBSERVED = {"cycles": 100, "rounds": 2, "window": 12, "nearness": 0.02, "blocks": 2, "block": 10, "retest": 50}
BAND = {"along": ["sigma_e_hat"], "range": [-0.5, 1.0], "values": 4}
SPEC_KEYS = Spec(tuple(OBSERVATIONS), starts=3, seed=1, cycles=30, settle=20, band=BAND, observation=OBSERVED)
AMPLITUDES = Spec(("amplitudes",), starts=3, seed=1, cycles=30, settle=20)


@pytest.fixture(scope="module")
def found():
    """Return the rows of GRID with all observations."""
    return list(rows(GRID, SPEC_KEYS, [0, 1]))


def test_amplitudes_are_those_of_samples_of_single_runs(found):
    system = BASE.with_(f20_hat=0.89)
    times = np.linspace(20, 30, 8001) * system.period
    runs = [vi.simulate(system, start, 30, sample_times=times).samples for start in spread_starts(3, 1)]
    for i in (1, 2):
        X = np.array([samples[:, 2 * i - 2] for samples in runs])
        assert found[0][f"largest_X{i}"] == pytest.approx(np.abs(X).max(), rel=1e-4)
        assert found[0][f"rms_X{i}"] == pytest.approx(np.sqrt(np.mean(X**2)), rel=1e-3)
        speed = np.mean([np.abs(samples[:, 2 * i + 3]) for samples in runs])
        assert found[0][f"ball_speed_{i}"] == pytest.approx(speed, rel=1e-2)


def test_a_peak_is_that_of_the_systems_along_its_band(found):
    """absorbers/test_peaks.py compares `peak` with samples of single runs."""
    places = [-0.5, 0.0, 0.5, 1.0]
    systems = [BASE.with_(sigma_e_hat=value) for value in places]
    peaks, along = (
        [of(one) for one in systems]
        for of in (lambda one: peak([one], spread_starts(3, 1), 30, 20)[0], lambda one: observed(one, AMPLITUDES))
    )
    assert (found[1]["peak"], found[1]["peak_at"]) == (max(peaks), places[int(np.argmax(peaks))])
    assert found[1]["peak"] < max(row[f"largest_X{i}"] for row in along for i in (1, 2))
    assert found[1]["peak_rms"] > max(row[f"rms_X{i}"] for row in along for i in (1, 2))  # of one start, not of all
    assert found[1]["peak_unfinished"] == 0


def test_the_share_of_impacts_is_that_of_single_runs_with_impacts():
    """At this detuning, the run from rest has no impacts. The row counts it and excludes it from the share."""
    system = BASE.with_(sigma_e_hat=-2.0)
    row = observed(system, Spec(("energy",), starts=3, seed=1, cycles=120, settle=60))
    runs = [vi.simulate(system, start, 120) for start in spread_starts(3, 1)]
    hits = [any(run.events["tau"] > 60 * system.period) for run in runs]
    assert hits == [False, True, True]
    cycles = [run.energy.per_cycle[60:] for run, hit in zip(runs, hits, strict=True) if hit]
    work, impacts = (sum(energy[name].sum() for energy in cycles) for name in ("work", "impacts"))
    assert row["impact_share"] == pytest.approx(impacts / work, rel=1e-9)
    assert row["starts_without_impacts"] == 1
    from_rest = observed(system, Spec(("energy",), starts=1, seed=1, cycles=120, settle=60))
    assert np.isnan(from_rest["impact_share"])
    assert from_rest["starts_without_impacts"] == 1


def test_regimes_and_fixed_points_are_those_of_direct_calls(found):
    system = BASE.with_(f20_hat=0.89)
    names = [regime.name for regime in settle(system, spread_starts(3, 1), Observation(**OBSERVED))]
    assert {name: found[0][name] for name in REGIMES} == {name: names.count(name) / 3 for name in REGIMES}
    assert found[0]["from_rest"] == names[0]
    assert found[0]["fixed_points"] == len(vi.fixed_points(system))


def test_a_failed_point_has_a_reason_and_does_not_affect_other_points(monkeypatch):
    def fail(system, states, spec):
        if system.f20_hat == 1.0:
            raise ArithmeticError("no\nroots")
        return 2, 1

    monkeypatch.setitem(OBSERVATIONS, "fixed_points", (OBSERVATIONS["fixed_points"][0], fail))
    first, second = rows(GRID, Spec(("fixed_points",)), [0, 1])
    assert (first["fixed_points"], first["failed"]) == (2, "")
    assert second == {"point": 1, "f20_hat": 1.0, "failed": "no roots"}


def test_unfinished_runs_are_counted_and_excluded(monkeypatch):
    outcomes = vi.ensemble(BASE, spread_starts(3, 1), 4)
    broken = outcomes.copy()
    broken["status"][1], broken["largest"][1] = 1, np.nan
    monkeypatch.setattr(observations, "ensemble", lambda *arguments, **options: broken)
    row = observed(BASE, AMPLITUDES)
    assert row["unfinished"] == 1
    assert row["largest_X1"] == outcomes["largest"][[0, 2], 0].max()
    states = np.vstack([spread_starts(3, 1), np.full(8, np.nan)])
    kept, peaks = (OBSERVATIONS["peaks"][1](BASE, some, SPEC_KEYS) for some in (states[:3], states))
    assert (kept[-1], peaks) == (0, (*kept[:-1], 4))
