"""The interval proof of completeness, and that it does not prove too much."""

import numpy as np
import pytest

flint = pytest.importorskip("flint", reason="python-flint belongs to the optional extra `reference`")

from attacks import random_system  # noqa: E402
from chapter import FORCES  # noqa: E402
from systems_of_points import UNCOUPLED, build  # noqa: E402
from vibroimpact.exact.orbits.impulse_response import forced_amplitude  # noqa: E402
from vibroimpact.exact.orbits.search import orbits  # noqa: E402
from vibroimpact.exact.orbits.symmetric import symmetric_solutions, symmetric_solutions_under  # noqa: E402
from vibroimpact.studies.completeness import orbits as module  # noqa: E402
from vibroimpact.studies.completeness.orbits import certify  # noqa: E402


def test_the_lists_of_the_chapter_s_cases_and_of_many_forces_at_once_are_complete(monkeypatch):
    forces = [*FORCES.values(), (0.0, 0.0), (1.0, 0.72), (-2.0, 0.5), (0.0, 0.01)]
    for (f10, f20), listed in zip(forces, symmetric_solutions_under(build(), forces), strict=True):
        monkeypatch.setattr(module, "symmetric_solutions", lambda _, listed=listed: listed)
        proof = certify(build(dict(f10_hat=f10, f20_hat=f20)))
        assert proof.complete
        assert not proof.undecided
        assert len(proof.isolated) == len(listed)


@pytest.mark.parametrize("left_out", [0, 1])
def test_a_missing_root_is_noticed(monkeypatch, left_out):
    system = build()
    listed = np.delete(symmetric_solutions(system), left_out, axis=0)
    monkeypatch.setattr(module, "symmetric_solutions", lambda _: listed)
    proof = certify(system)
    assert not proof.undecided
    assert not proof.complete


@pytest.mark.parametrize("seed", range(12))
def test_random_systems_are_complete(seed):
    system = random_system(np.random.default_rng([seed, 4]))
    assert certify(system).complete, system


def test_a_double_root_is_reported_as_undecided():
    """Identical modules in step: the lag 0 is a double root at a kink, so nothing is claimed there."""
    proof = certify(build(dict(sigma20_hat=0)))
    assert not proof.complete
    assert proof.undecided
    for lower, upper in proof.undecided:
        assert min(upper, 1 - lower) < 1e-6


@pytest.mark.parametrize("changes", [{}, UNCOUPLED])
def test_what_nothing_drives_has_no_response(changes):
    system = build(dict(f10_hat=0, f20_hat=0, **changes))
    assert certify(system) == module.Proof([], [], complete=True)
    assert orbits(system) == []


def test_a_box_held_still_by_the_other_one():
    """Box 2 tuned as an undamped absorber of the force on box 1, which then does not move without balls."""
    absorber = {"gamma2_hat": 0, "gamma12_hat": 0, "alpha12_hat": 1, "f10_hat": 1.5, "f20_hat": 0}
    # 1 + epsilon (sigma20_hat + alpha12_hat) = Omega^2 with Omega = 1 + epsilon sigma_e_hat, in exact fractions.
    system = build(dict(epsilon=0.25, sigma_e_hat=0.5, sigma20_hat=0.0625, **absorber))
    assert forced_amplitude(system)[0] == 0
    proof = certify(system)
    assert proof.complete
    assert proof.isolated
