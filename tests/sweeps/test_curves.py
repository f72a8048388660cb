"""Points of the sweeps that figures draw as curves, against integrators that share nothing with the engine."""

from unittest import mock

import numpy as np
import pytest
import yaml
from scipy.integrate import solve_ivp

import vibroimpact as vi
import vibroimpact.rivals.solve_ivp as general
from pipeline_trees import ROOT
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.exact.engine.ensemble import finals
from vibroimpact.regimes.classification import starts
from vibroimpact.rivals import METHODS
from vibroimpact.sweeps.grid import Grid, axis

CONFIG = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
RIVALS = {method.name: method for method in METHODS}
CYCLES, POINTS = 3, 20
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
CURVES = ["frequency_response", "clearance", "design"]


def points(name):
    """Random systems of a sweep, along its band, too, with one of its starts each; from rest an impact may graze."""
    sweep, rng = CONFIG["sweeps"][name], np.random.default_rng(7)
    grid = Grid(vi.System(**CONFIG["system"], f10_hat=1.0, f20_hat=1.0), [axis(**one) for one in sweep["axes"]])
    band = axis(**sweep["band"]).values if "band" in sweep else None
    for number in rng.choice(len(grid), POINTS, replace=len(grid) < POINTS):
        system = grid.system(int(number))
        system = system.with_(sigma_e_hat=float(rng.choice(band))) if band else system
        yield system, starts(sweep["starts"], sweep["seed"])[rng.integers(1, sweep["starts"])]


def flights(system, start):
    """What DOP853 ends with and meets, and its flights as functions of time."""
    kept = []

    def keeping(*arguments, **options):
        kept.append(solve_ivp(*arguments, dense_output=True, **options))
        return kept[-1]

    with mock.patch.object(general, "solve_ivp", keeping):
        run = RIVALS["DOP853"].run(system, start, CYCLES, 0.0, 1e-11)
    return run, [flight.sol for flight in kept]


def stored(system, s):
    """Energy of boxes, balls and springs, by (10.2)."""
    kinetic = s[4] ** 2 + s[6] ** 2 + system.epsilon * (s[5] ** 2 + s[7] ** 2)
    return 0.5 * (kinetic + s[0] ** 2 + system.stiffness2 * s[2] ** 2 + system.alpha12 * (s[0] - s[2]) ** 2)


def measured(system, start, run, parts):
    """Of the rival, as `vi.ensemble` has it: final state, largest |X_i|, means of X_i^2 and |Y_i'|, energies."""
    integrals, largest = np.zeros((5, 2)), np.abs(start[[0, 2]])
    for sol in parts:
        half = np.diff(sol.ts)[:, None] / 2
        times = sol.ts[:-1, None] + half * (1 + NODES)
        s = sol(times.ravel())
        force = np.sin(system.Omega * times.ravel())
        speeds, between = s[[4, 6]], s[4] - s[6]
        values = [force * speeds, speeds**2, [between**2, 0 * between], s[[0, 2]] ** 2, np.abs(s[[5, 7]])]
        integrals += np.array(values) @ (half * WEIGHTS).ravel()
        largest = np.maximum(largest, [turning(sol, box) for box in (0, 2)])
    work, ground, coupling, squares, path = integrals
    lost = 0.5 * system.epsilon / (1 + system.epsilon) * (1 - system.kappa**2) * run.impacts["speed"] ** 2
    length = CYCLES * system.period
    return {
        "final": run.final,
        "largest": largest,
        "mean_square": squares / length,
        "ball_speed": path / length,
        "work": system.forcing * work,
        "ground": np.array([system.gamma1, system.gamma2]) * ground,
        "coupling": system.gamma12 * coupling[0],
        "impacts": [lost[run.impacts["module"] == module].sum() for module in (1, 2)],
        "stored": stored(system, run.final) - stored(system, start),
    }


def turning(sol, box):
    """The largest |X| of a flight: where the velocity vanishes, or at the end."""
    times = np.linspace(sol.t_min, sol.t_max, 4 * len(sol.ts))
    speeds = sol(times)[4 + box]
    k = np.flatnonzero(speeds[1:] * speeds[:-1] < 0)
    turns = times[k] + (times[k + 1] - times[k]) * speeds[k] / (speeds[k] - speeds[k + 1])
    return np.abs(sol(np.array([*turns, sol.t_max]))[box]).max()


@pytest.mark.parametrize("name", CURVES)
def test_random_points_are_those_of_another_integrator(name):
    """Over a few settled cycles of what the curves observe: where it is chaotic no more can be compared.

    DOP853 may step over an impact, both walls being met within a step; then the reference is asked who is right.
    """
    impacts, repeating, missed = 0, 0, 0
    for system, start in points(name):
        settled = finals(system, start[None], CONFIG["sweeps"][name]["settle"])[0]
        ours, (run, parts) = vi.ensemble(system, settled, CYCLES, energy=True), flights(system, settled)
        if len(run.impacts) != ours["impacts"].sum():
            truth = reference_run(system, settled, CYCLES, 40).final
            np.testing.assert_allclose(ours["final"], truth, rtol=0, atol=1e-10)
            missed += 1
            continue
        theirs = measured(system, settled, run, parts)
        for part, value in theirs.items():
            found = ours["energy"][part] if part in vi.ENERGY.names else ours[part]
            np.testing.assert_allclose(found, value, rtol=1e-6, atol=1e-6, err_msg=f"{part} of {system}")
        impacts += ours["impacts"].sum()
        if np.abs(theirs["final"] - settled).max() < 1e-6:  # then the cycles that the curve observes are all like these
            repeating += 1
            whole = vi.ensemble(system, settled, 50)
            np.testing.assert_allclose(whole["largest"], theirs["largest"], atol=1e-5)
            np.testing.assert_allclose(whole["mean_square"], theirs["mean_square"], atol=1e-5)
    assert impacts > 2 * POINTS
    assert missed < POINTS / 4
    assert repeating > 0


@pytest.mark.skipif(RIVALS["heyoka"].available() is not None, reason="heyoka is not there")
def test_what_impacts_take_in_the_modulated_response_is_that_of_another_integrator():
    """Runs part after 30 to 50 cycles; means over starts agree within four times the standard errors of both."""
    cycles, states, rival = 200, starts(17, 5)[1:], RIVALS["heyoka"]
    for force in (0.4, 0.464):  # of the frequency response, and of the best clearance
        system = vi.System(**CONFIG["system"] | {"sigma_e_hat": 0.0}, f10_hat=force, f20_hat=force)
        settled = finals(system, states, 200)
        ours = vi.ensemble(system, settled, cycles, energy=True)
        runs = [rival.run(system, state, cycles, 0.0, rival.careful) for state in settled]
        lost = 0.5 * system.epsilon / (1 + system.epsilon) * (1 - system.kappa**2)
        taken = np.array(
            [ours["energy"]["impacts"].sum(axis=1), [lost * (r.impacts["speed"] ** 2).sum() for r in runs]]
        )
        means, errors = taken.mean(axis=1), taken.std(axis=1, ddof=1) / np.sqrt(len(states))
        assert abs(means[0] - means[1]) < 4 * np.hypot(*errors)
        assert (errors < 0.03 * means).all()
        assert np.abs(ours["final"] - [run.final for run in runs]).max() > 0.5
