"""A single machine has the regimes, exponents, sections and sweeps of a module of its twin.

The twin has the same force on the other module, so that both modules move alike and both are active. Initial values and
parameters of the idle module of a single machine have no effect.
"""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.studies.regimes.lyapunov import contraction
from vibroimpact.system.state import STICK

MACHINE = vi.PhysicalSystem.single(M=1, m=0.05, k=1, c=0.02, F=0.05, L=1, kappa=0.65).dimensionless()
TWIN = MACHINE.with_(f20_hat=MACHINE.f10_hat)
SECOND = MACHINE.with_(f10_hat=0.0, f20_hat=MACHINE.f10_hat)
OTHER = MACHINE.with_(sigma20_hat=7.0, gamma2_hat=0.0)
ALONE = {"first": MACHINE, "second": SECOND, "beside another": OTHER}
MULTIPLIER = 0.882208
"""Modulus of the largest multiplier of the only admissible orbit, from Masri's closed form."""
OF = {1: [0, 1, 4, 5], 2: [2, 3, 6, 7]}


def starts(system, count=6):
    """Return starts in which the active module has the states of module 1 in `vi.starts`; the idle one moves, too."""
    states = vi.starts(count, seed=1)
    return states if system.modules == (1,) else states[:, [2, 3, 0, 1, 6, 7, 4, 5]]


@pytest.fixture(scope="module", params=ALONE)
def machine(request):
    """Return each system of ALONE in turn."""
    return ALONE[request.param]


def test_the_largest_exponent_is_that_of_the_orbit(machine):
    for start in starts(machine, 3):
        found = vi.largest_lyapunov(machine, start)
        assert found.mean == pytest.approx(np.log(MULTIPLIER), abs=found.error)
        assert found.mean < 0
        assert found.error < 1e-3


def test_the_spectrum_has_the_four_exponents_of_the_orbit(machine):
    found = vi.lyapunov_spectrum(machine, starts(machine)[1], cycles=400)
    [orbit] = [one for one in vi.orbits(TWIN) if one.admissible]
    logs = np.sort(np.log(np.abs(orbit.multipliers)))[::-1]
    np.testing.assert_allclose(found.exponents, logs[::2], atol=0.01)  # each exponent is twice in the twin
    assert found.exponents.sum() == pytest.approx(logs.sum() / 2, abs=1e-9)
    assert found.dimension == 0
    assert found.errors(20)[0].shape == (4,)


def test_a_ball_that_sticks_leaves_two_of_four_dimensions():
    machine = MACHINE.with_(epsilon=0.3, kappa=0.1, gamma1_hat=0.3, gamma2_hat=0.3, sigma_e_hat=0.0, f10_hat=9.0)
    state = vi.simulate(machine, np.zeros(8), 200).final
    assert (vi.simulate(machine, state, 1).events["kind"] == STICK).any()
    found = vi.lyapunov_spectrum(machine, state, 60, 0, 0).exponents
    assert np.isneginf(found).tolist() == [False, False, True, True]
    assert vi.largest_lyapunov(machine, np.zeros(8), 400, 200).mean == pytest.approx(found[0], abs=0.02)


def test_exponents_of_chaos_have_the_sum_in_closed_form():
    machine = MACHINE.with_(kappa=0.9, f10_hat=0.2)
    found = vi.lyapunov_spectrum(machine, [0.0, 0.3, 0.0, 0.3, 0.0, 0.5, 0.0, 0.5], 300)
    assert found.exponents[0] > 0.05
    np.testing.assert_allclose(found.growth.sum(axis=1), found.contraction, rtol=0, atol=1e-8)
    assert contraction(machine, 4, 0) == pytest.approx(contraction(machine.with_(f20_hat=0.2), 8, 0) / 2)


def test_all_starts_end_on_the_orbit_of_the_twin(machine):
    found = vi.attractors(machine, starts(machine, 12))
    assert found.shares == {1: 1.0}
    [attractor] = found.attractors.values()
    [orbit], [module] = [one for one in vi.orbits(TWIN) if one.admissible], machine.modules
    assert (attractor.regime, attractor.cycles) == ("symmetric", 1)
    np.testing.assert_allclose(attractor.states[0, OF[module]], orbit.state[OF[1]], atol=1e-9)
    assert not attractor.states[0, OF[3 - module]].any()


def test_basins_do_not_depend_on_the_idle_module(machine):
    [module] = machine.modules
    found = vi.basins(machine, {f"W{module}": [-0.5, 0.2, 0.7], f"dY{3 - module}": [0.0, 0.4]})
    assert found.shares == {1: 1.0}


@pytest.mark.parametrize(
    ("force", "kappa", "name"),
    [
        (0.01, 0.65, "no impacts"),
        (0.01, 0.65, "hopping"),
        (0.2, 0.9, "strongly modulated"),
        (2.0, 0.2, "chaotic"),
        (2.0, 0.3, "other periodic"),
    ],
)
def test_regimes_have_the_names_of_the_twin(machine, force, kappa, name):
    """Both modules of the twin start in the state of the active module."""
    [module] = machine.modules
    alone = machine.with_(kappa=kappa, **{f"f{module}0_hat": force})
    twin = TWIN.with_(kappa=kappa, f10_hat=force, f20_hat=force)
    states = starts(machine, 4)
    both = np.empty_like(states)
    both[:, OF[1]] = both[:, OF[2]] = states[:, OF[module]]
    ours, theirs = vi.attractors(alone, states), vi.attractors(twin, both)
    names = [row["regime"] for row in ours.rows()]
    assert names == [row["regime"] for row in theirs.rows()]
    assert name in names


def test_a_section_is_that_of_the_twin():
    start = vi.starts(2, seed=1)[1]
    ours, theirs = (vi.sections(system, start, 30, settle=20) for system in (MACHINE, TWIN))
    np.testing.assert_allclose(ours[:, OF[1]], theirs[:, OF[1]], atol=1e-9)
    mixed = vi.sections([TWIN, SECOND, MACHINE], start, 30, settle=20)
    moved = [[bool(states[:, OF[module]].any()) for module in (1, 2)] for states in mixed]
    assert moved == [[True, True], [False, True], [True, False]]


def test_a_row_of_a_sweep_is_that_of_the_twin(machine):
    observe, [module] = ["regimes", "amplitudes", "energy", "peaks"], machine.modules
    settings = dict(starts=4, seed=1, cycles=700, settle=600, band={"sigma_e_hat": [0.0, 0.1]})
    [ours], [theirs] = (vi.sweep(system, {"kappa": [0.6]}, observe, **settings) for system in (machine, TWIN))
    assert (ours.pop("failed"), theirs.pop("failed")) == ("", "")
    assert ours.pop("from_rest") == theirs.pop("from_rest") == "symmetric"
    for name, value in ours.items():
        if name.endswith(("X1", "X2", "_1", "_2")):
            expected = theirs[f"{name[:-1]}1"] if name.endswith(str(module)) else 0.0
        else:
            expected = theirs[name]
        assert value == pytest.approx(expected, rel=1e-6, nan_ok=True), name
    assert ours["symmetric"] == 1.0


def test_both_modules_of_an_unforced_machine_are_kept():
    free = MACHINE.with_(f10_hat=0.0)
    start = [0.2, 0.1, 0.4, 0.3, 0.0, 0.5, 0.0, -0.7]
    assert vi.lyapunov_spectrum(free, start, 50).exponents.shape == (8,)
    np.testing.assert_allclose(vi.sections(free, start, 5)[-1], vi.simulate(free, start, 5).final, atol=1e-12)
