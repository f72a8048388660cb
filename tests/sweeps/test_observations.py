"""Rows of a sweep against direct calls of the library."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.regimes.classification import REGIMES
from vibroimpact.regimes.classification import starts as spread_starts
from vibroimpact.regimes.regime_map import cell
from vibroimpact.regimes.settling import Observation
from vibroimpact.sweeps import observations
from vibroimpact.sweeps.grid import Grid, axis
from vibroimpact.sweeps.observations import AMPLITUDES, COLUMNS, OBSERVATIONS, Asked
from vibroimpact.sweeps.rows import columns, rows

BASE = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
GRID = Grid(BASE, [axis(["f20_hat"], listed=[0.89, 1.0])])
OBSERVED = {"cycles": 100, "rounds": 2, "window": 12, "nearness": 0.02, "blocks": 2, "block": 10, "retest": 50}
ASKED = Asked(tuple(OBSERVATIONS), starts=3, seed=1, cycles=30, settle=20, observation=OBSERVED)


@pytest.fixture(scope="module")
def found():
    return list(rows(GRID, ASKED, [0, 1]))


def test_a_row_has_every_column_in_order(found):
    assert [list(row) for row in found] == [columns(GRID, ASKED)] * 2
    assert [row["f20_hat"] for row in found] == [0.89, 1.0]
    assert {row["failed"] for row in found} == {""}


def test_amplitudes_are_those_of_runs_that_were_sampled(found):
    """The ensemble observes without samples; here are samples of `simulate`, close together."""
    system = BASE.with_(f20_hat=0.89)
    times = np.linspace(20, 30, 8001) * system.period
    runs = [vi.simulate(system, start, 30, sample_times=times).samples for start in spread_starts(3, 1)]
    for i in (1, 2):
        X = np.array([samples[:, 2 * i - 2] for samples in runs])
        assert found[0][f"largest_X{i}"] == pytest.approx(np.abs(X).max(), rel=1e-4)
        assert found[0][f"rms_X{i}"] == pytest.approx(np.sqrt(np.mean(X**2)), rel=1e-3)
        speed = np.mean([np.abs(samples[:, 2 * i + 3]) for samples in runs])
        assert found[0][f"ball_speed_{i}"] == pytest.approx(speed, rel=1e-2)


def test_regimes_and_fixed_points_are_those_of_a_cell_of_the_map(found):
    one = cell(BASE.with_(f20_hat=0.89), spread_starts(3, 1), Observation(**OBSERVED))
    assert {name: found[0][name] for name in REGIMES} == one.shares
    assert found[0]["from_rest"] == one.from_rest
    assert (found[0]["fixed_points"], found[0]["stable_points"]) == (one.fixed_points, one.stable_points)


def test_orbits_are_motions_of_the_system(found):
    motions = [orbit for orbit in vi.orbits(BASE) if orbit.admissible]
    assert found[1]["orbits"] == len(motions) > 0
    assert found[1]["stable_orbits"] == sum(abs(orbit.multipliers[0]) < 1 for orbit in motions)


def test_a_point_that_cannot_be_observed_says_why_and_costs_no_other(monkeypatch):
    def fail(system, states, asked):
        if system.f20_hat == 1.0:
            raise ArithmeticError("no\nroots")
        return 2, 1

    monkeypatch.setitem(observations.OBSERVATIONS, "fixed_points", fail)
    first, second = rows(GRID, Asked(("fixed_points",)), [0, 1])
    assert (first["fixed_points"], first["failed"]) == (2, "")
    assert second == {"point": 1, "f20_hat": 1.0, "failed": "no roots"}


def test_runs_that_do_not_finish_are_counted_and_left_out(monkeypatch):
    outcomes = vi.ensemble(BASE, spread_starts(3, 1), 4)
    broken = outcomes.copy()
    broken["status"][1], broken["largest"][1] = 1, np.nan
    monkeypatch.setattr(observations, "ensemble", lambda *given, **more: broken)
    row = dict(zip(COLUMNS[AMPLITUDES], OBSERVATIONS[AMPLITUDES](BASE, None, ASKED), strict=True))
    assert row["unfinished"] == 1
    assert row["largest_X1"] == outcomes["largest"][[0, 2], 0].max()
    broken["status"] = 1
    row = dict(zip(COLUMNS[AMPLITUDES], OBSERVATIONS[AMPLITUDES](BASE, None, ASKED), strict=True))
    assert row["unfinished"] == 3
    assert np.isnan(row["rms_X2"])
