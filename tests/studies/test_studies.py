"""Exponents, attractors, basins, sections, sweeps and continuation through their public names."""

import doctest
import sys

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.studies.regimes.classification import starts
from vibroimpact.studies.regimes.lyapunov import Spectrum
from vibroimpact.studies.sweeps.observations import OBSERVATIONS
from vibroimpact.system import progress

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
REST = [0.0] * 8
EXAMPLES = ["branches", "sweep", "sections", "attractors", "basins", "largest_lyapunov", "lyapunov_spectrum"]


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_example_of_a_docstring_runs(name):
    function = getattr(vi, name)
    known = {"system": SYSTEM, "np": np, name: function}
    [example] = doctest.DocTestFinder(recurse=False).find(function, name, globs=known)
    assert example.examples
    assert doctest.DocTestRunner().run(example).failed == 0


# Lyapunov exponents


def test_linear_growth_is_not_chaos_within_the_error():
    """With balls at rest, perturbations grow in proportion to time: the exponent is ln(3000 / 1000) / 2000."""
    found = vi.largest_lyapunov(SYSTEM.with_(f10_hat=0.1, f20_hat=0.1), REST)
    assert found == (found.mean, found.error)  # two numbers to unpack
    assert found.mean == pytest.approx(np.log(3) / 2000, rel=0.05)
    assert found.mean < 3 * found.error < 0.005


# Attractors and basins


def test_starts_near_a_stable_orbit_have_its_label():
    """The orbits are the stable asymmetric orbit and its mirror image; shares are those of the labels."""
    pair = [orbit for orbit in vi.orbits(SYSTEM) if orbit.admissible and orbit.stable]
    states = np.array([pair[0].state, pair[1].state, pair[0].state + 1e-3, pair[1].state + 1e-3])
    found = vi.attractors(SYSTEM, states)
    assert found.labels.tolist() == [1, 2, 1, 2]
    assert found.shares == {1: 0.5, 2: 0.5}
    for label, orbit in enumerate(pair, start=1):
        np.testing.assert_allclose(found.attractors[label].states, [orbit.state], atol=1e-9)
        assert found.attractors[label].cycles == 1
        refined = found.attractors[label].orbit
        assert (refined.periods, refined.stability, refined.impacts.tolist()) == (1, "stable", [[1, 1], [1, 1]])
        np.testing.assert_allclose(refined.multipliers, orbit.multipliers, atol=1e-9)


def test_basins_are_the_attractors_of_the_listed_starts():
    W1, X2 = [-0.5, 0.3], [0.1, 0.6, 0.9]
    found = vi.basins(SYSTEM, {"W1": W1, "X2": X2}, state=[0.2, 0, 0, 0, 0, 0, 0, 0.4])
    states = [[0.2, 0.2 - w, x, 0, 0, 0, 0, 0.4] for w in W1 for x in X2]
    listed = vi.attractors(SYSTEM, states)
    assert found.labels.shape == (2, 3)
    assert found.labels.ravel().tolist() == listed.labels.tolist()
    frame = vi.to_frame(found)
    assert frame[["W1", "X2"]].to_numpy().tolist() == [[w, x] for w in W1 for x in X2]
    assert sum(found.shares.values()) == pytest.approx(1.0)


def test_a_start_without_time_to_settle_has_the_label_minus_one():
    short = vi.Observation(cycles=1, rounds=1, blocks=2, block=1, retest=1)
    found = vi.attractors(SYSTEM, starts(3, 2)[1:], short)
    assert found.labels.tolist() == [-1, -1]
    assert found.shares == {-1: 1.0}


# Sections


def test_sections_are_the_states_of_single_runs_at_whole_cycles():
    systems = [SYSTEM, SYSTEM.with_(f20_hat=0.9)]
    found = vi.sections(systems, REST, cycles=12, settle=4)
    for system, states in zip(systems, found, strict=True):
        np.testing.assert_allclose(states, vi.simulate(system, REST, 12).section()[5:], atol=1e-9)


# Sweeps


def test_a_row_of_a_sweep_has_python_types():
    settings = dict(starts=2, cycles=30, settle=20, band={"sigma_e_hat": [0.2]})
    [row] = vi.sweep(SYSTEM, {"f20_hat": np.array([1.0])}, list(OBSERVATIONS), **settings)
    assert row["failed"] == ""
    assert {type(value) for value in row.values()} == {int, float, str}


def test_a_sweep_has_default_cycles():
    [row] = vi.sweep(SYSTEM, {"f20_hat": [1.0]}, ["amplitudes", "regimes", "peaks"], band={"sigma_e_hat": [0.2]})
    assert row["failed"] == ""
    assert all(np.isfinite(row[name]) for name in ("largest_X1", "rms_X2", "peak", "asymmetric"))
    outcomes = vi.ensemble(SYSTEM, starts(5, 0), 1000, settle=800)
    assert row["largest_X1"] == outcomes["largest"][:, 0].max()


AXES = {"f20_hat": [1.0]}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"observe": ["peaks"]}, "band"), ({"observe": ["peaks"], "band": {"mass": [1.0]}}, "mass"),
        ({"observe": ["peaks"], "band": AXES}, "band"), ({"observe": ["amplitudes"], "cycles": 0}, "cycles"),
        ({"observe": ["amplitudes"], "cycles": 10, "settle": 10}, "settle"), ({"observe": []}, "observe"),
        ({"observe": ["regimes"], "observation": {"cycles": 5}}, "observation"), ({"observe": "all"}, "observe"),
        ({"observe": ["fixed_points"], "starts": 0}, "starts"), ({"observe": ["fixed_points"], "axes": {}}, "axes"),
        ({"observe": ["fixed_points"], "axes": {"kappa": []}}, r"axes\['kappa'\]"),
        ({"observe": ["fixed_points"], "axes": {"kappa": ["a"]}}, r"axes\['kappa'\]"),
        ({"observe": ["fixed_points"], "axes": {"kappa": [0.5, 1.5]}}, "at kappa = 1.5"),
        ({"observe": ["fixed_points"], "axes": {"mass": [1]}}, "mass"), ({"observe": ["points"]}, "observe"),
    ],
)  # fmt: skip
def test_a_wrong_argument_of_a_sweep_is_named_in_one_line(arguments, message):
    with pytest.raises(ValueError, match=rf"^{message}: [^\n]+$"):
        vi.sweep(SYSTEM, **{"axes": AXES} | arguments)


PLANT = vi.PhysicalSystem.single(M=120.0, m=12.0, k=2e5, c=90.0, F=100.0, L=0.005)
SPECTRUM, SINGLE_CYCLE = (Spectrum(np.zeros((n, 8)), np.zeros(n), np.zeros(n)) for n in (10, 1))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: vi.largest_lyapunov(SYSTEM, [0.0] * 7), "state"), (lambda: vi.lyapunov_spectrum(1, REST), "system"),
        (lambda: vi.largest_lyapunov(SYSTEM, REST, 1), "cycles"),
        (lambda: vi.largest_lyapunov(SYSTEM, REST, blocks=1), "blocks"),
        (lambda: vi.largest_lyapunov(SYSTEM, REST, 39), "cycles"), (lambda: SPECTRUM.errors(0), "block"),
        (lambda: SPECTRUM.errors(6), "block"), (lambda: SINGLE_CYCLE.errors(1), "growth"),
        (lambda: vi.starts(0, 1), "count"), (lambda: vi.starts(2, -1), "seed"),
        (lambda: vi.starts(2, 1, np.nan), "reach"), (lambda: vi.basins(SYSTEM, {"Y1": []}), r"axes\['Y1'\]"),
        (lambda: vi.basins(SYSTEM, {"Y1": [0.0, 0.5], "W1": [0.2]}), "axes"),
        (lambda: vi.attractors(SYSTEM, REST), "states"),
        (lambda: vi.attractors(SYSTEM, [[2.0, *REST[1:]]]), "initial state 0"),
        (lambda: vi.basins(SYSTEM, {"Z": [1]}), "axes"), (lambda: vi.basins(SYSTEM, {}), "axes"),
        (lambda: vi.basins(SYSTEM, {"W1": [1.5]}), "initial state 0"), (lambda: vi.Observation(blocks=1), "blocks"),
        (lambda: vi.sections(SYSTEM, REST, 5, settle=5), "settle"), (lambda: vi.sections(SYSTEM, [1.0], 5), "states"),
        (lambda: vi.branches(SYSTEM, "f20", (0.8, 0.9)), "f20"),
        (lambda: vi.branches(SYSTEM, "f20_hat", 0.9), "between"),
        (lambda: vi.branches(SYSTEM, "f20_hat", (0.9, 0.8)), "between"),
        (lambda: vi.branches(SYSTEM, "kappa", (0.5, 1.5)), "between"),
        (lambda: vi.branches(SYSTEM, "kappa", (0.5, 0.6), "all"), "of"),
    ],
)  # fmt: skip
def test_a_wrong_argument_is_named_in_one_line(call, message):
    with pytest.raises(ValueError, match=rf"^{message}: [^\n]+$"):
        call()


def test_progress_is_printed_on_a_terminal_only(monkeypatch, capsys):
    few = {"states": vi.starts(2, seed=1), "observation": vi.Observation(cycles=10, rounds=2, retest=20)}

    def printed(terminal, **options):
        monkeypatch.setattr(sys.stderr, "isatty", lambda: terminal)
        assert list(progress.track([3, 4], "things", **options)) == [3, 4]
        vi.branches(SYSTEM, "f20_hat", (0.99, 1.01), of="theory", seeds=1, **options)
        vi.attractors(SYSTEM, **few, **options)
        return capsys.readouterr().err

    assert printed(False) == printed(True, progress=False) == ""
    assert all(
        words in printed(True) for words in ("things 2/2\n", "branches: family 1/1\n", "initial states, round 1: 2/2\n")
    )
