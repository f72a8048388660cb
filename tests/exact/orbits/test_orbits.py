"""Exact 1:1 orbits are reproduced by runs, found completely, and symmetric as the equations are."""

import functools

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.exact.orbits import asymmetric, impulse_response
from vibroimpact.exact.orbits.newton import newton
from vibroimpact.exact.orbits.search import orbits, search
from vibroimpact.exact.orbits.symmetric import SymmetricConditions, distinct, symmetric_solutions, wrapped

known = functools.cache(orbits)


@pytest.fixture(params=["equal", "unequal", "weak", "undamped", "heavy", "soft", "hard", "one_forced"])
def scene(request, chapter):
    """Return systems of different kinds in turn."""
    undamped = {"gamma1_hat": 0, "gamma2_hat": 0, "gamma12_hat": 0}
    return {
        "equal": chapter(),
        "unequal": chapter(1, 0.89),
        "weak": chapter(0.5, 0.5),
        "undamped": chapter(**undamped),
        "heavy": chapter(epsilon=1.0),
        "soft": chapter(kappa=0.01),
        "hard": chapter(kappa=0.999, f20_hat=-1),
        "one_forced": chapter(1, 0),
    }[request.param]


def events_of(orbit):
    """Return (time, module, wall) of the four impacts in order of time."""
    times = orbit.impact_phases * orbit.system.period
    return sorted((times[i, k], i + 1, (1, -1)[k]) for i in range(2) for k in range(2))


def same(a, b, atol=1e-9):
    gap = abs(a.impact_phases - b.impact_phases)
    return np.minimum(gap, 1 - gap).max() < atol and abs(a.ball_speeds - b.ball_speeds).max() < atol


def test_runs_reproduce_admissible_orbits_only(scene):
    for orbit in known(scene):
        times, modules, walls = zip(*events_of(orbit), strict=True)
        try:
            run = vi.simulate(scene, orbit.state, 1, sample_times=[scene.period / 2])
        except ValueError:  # a ball beyond a wall
            assert not orbit.admissible
            continue
        rounding = 1e-13 * max(1.0, np.linalg.norm(orbit.passage.jacobian))
        there = run.events[["module", "wall", "kind"]].tolist() == [*zip(modules, walls, [0] * 4, strict=True)]
        assert orbit.admissible == (there and np.abs(run.events["tau"] - times).max() < 1e-6)
        if orbit.admissible:
            assert orbit.residual < 2e-12
            np.testing.assert_allclose(run.events["tau"], times, rtol=0, atol=rounding)
            np.testing.assert_allclose(run.final, orbit.state, rtol=0, atol=rounding)
            if orbit.symmetric:
                np.testing.assert_allclose(run.samples[0], -orbit.state, rtol=0, atol=rounding)


def test_only_one_of_two_uncoupled_modules_may_be_asymmetric(chapter):
    """The force on module 1 is below that of the symmetry breaking, the force on module 2 above it."""
    found = vi.orbits(chapter(1.0, 1.9, alpha12_hat=0, gamma12_hat=0, sigma20_hat=0))
    unequal = np.array([abs(np.diff(orbit.ball_speeds)[:, 0]) > 1e-6 for orbit in found])
    assert (unequal == [False, True]).all(axis=1).any()
    assert [orbit.symmetric for orbit in found] == [*(~unequal.any(axis=1))]


def test_brute_force_finds_no_other_symmetric_orbit(scene):
    found = symmetric_solutions(scene)
    rng = np.random.default_rng(5)
    starts = np.concatenate([rng.uniform(0, scene.period, (1500, 2)), rng.uniform(-6, 6, (1500, 2))], axis=1)
    forced = newton(SymmetricConditions(scene), starts)
    forced[:, :2] = wrapped(forced[:, :2], scene.period)
    assert len(forced) > 100
    assert len(distinct(np.concatenate([found, forced]), scene.period, 2)[0]) == len(found)


def test_eight_times_the_starts_find_no_other_asymmetric_orbit(case, monkeypatch):
    usual = search(case)
    monkeypatch.setattr(asymmetric, "STARTS", 8 * asymmetric.STARTS)
    thorough = search(case)
    assert len(usual.orbits) == len(thorough.orbits)
    assert all(same(a, b) for a, b in zip(usual.orbits, thorough.orbits, strict=True))
    assert thorough.fewest_hits >= usual.fewest_hits


def test_asymmetric_orbits_are_listed_in_mirrored_pairs(scene):
    asymmetric = [orbit for orbit in known(scene) if not orbit.symmetric]
    assert len(asymmetric) % 2 == 0
    for one, other in zip(asymmetric[0::2], asymmetric[1::2], strict=True):
        np.testing.assert_allclose(one.ball_speeds, other.ball_speeds[:, ::-1], rtol=0, atol=1e-8)
        np.testing.assert_allclose(abs(one.multipliers), abs(other.multipliers), rtol=1e-7, atol=1e-8)
        if one.admissible:
            half = vi.simulate(scene, one.state, 1, sample_times=[scene.period / 2]).samples[0]
            np.testing.assert_allclose(half, -other.state, rtol=0, atol=1e-8)


def test_C_is_the_amplitude_of_the_saw_tooth_in_a_simulation(case):
    """C is half the range of sampled Z = W - U, and 1 - U at the wall in a symmetric orbit, (10.12)."""
    instants = np.linspace(0, case.period, 4001)
    for orbit in (o for o in known(case) if o.admissible):
        X, Y = (vi.simulate(case, orbit.state, 1, sample_times=instants).samples[:, k:4:2] for k in (0, 1))
        Z = X - Y - (X + case.epsilon * Y)
        np.testing.assert_allclose(np.ptp(Z, axis=0) / 2, orbit.C, rtol=2e-3)
        for module, at in enumerate(orbit.impact_phases[:, 0] * case.period if orbit.symmetric else ()):
            x, y = vi.simulate(case, orbit.state, 1, sample_times=[at]).samples[0, 2 * module : 2 * module + 2]
            assert 1 - (x + case.epsilon * y) == pytest.approx(orbit.C[module], abs=1e-10)


@pytest.mark.parametrize("mistuning", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
def test_almost_identical_modules_have_the_solutions_of_identical_modules(chapter, mistuning):
    """Identical modules have a line of solutions at lag 0; both solutions at its ends are found near it."""
    limit = symmetric_solutions(chapter(sigma20_hat=0))
    near = symmetric_solutions(chapter(sigma20_hat=mistuning))
    assert len(near) == len(limit) == 2
    order = np.argsort(near[:, 2])
    np.testing.assert_allclose(near[order], limit[np.argsort(limit[:, 2])], rtol=0, atol=20 * mistuning + 1e-12)


def test_orbits_do_not_depend_on_the_size_of_pieces_of_a_flight(chapter, monkeypatch):
    """The sizes that limit the memory are so small here that the chapter's period is divided."""
    whole = orbits(chapter())
    impulse_response._kept.cache_clear()
    monkeypatch.setattr(impulse_response, "_FINE_NODES", 7)
    monkeypatch.setattr("vibroimpact.exact.orbits.symmetric._PIECES_AT_ONCE", 2)
    monkeypatch.setattr("vibroimpact.exact.orbits.search._SAMPLES", 7)
    cut = orbits(chapter())
    impulse_response._kept.cache_clear()
    assert [a.admissible for a in cut] == [b.admissible for b in whole]
    assert len(cut) == len(whole)
    assert all(same(a, b, 1e-11) for a, b in zip(cut, whole, strict=True))
