"""The interval proof of completeness, and that it does not prove too much."""

import numpy as np
import pytest

flint = pytest.importorskip("flint", reason="python-flint belongs to the optional extra `reference`")

from attacks import random_system  # noqa: E402
from vibroimpact.exact.orbits.impulse_response import forced_amplitude  # noqa: E402
from vibroimpact.exact.orbits.search import orbits  # noqa: E402
from vibroimpact.exact.orbits.symmetric import symmetric_solutions, symmetric_solutions_under  # noqa: E402
from vibroimpact.studies.completeness import orbits as module  # noqa: E402
from vibroimpact.studies.completeness.orbits import certify  # noqa: E402


def test_the_cases_of_the_chapter_are_complete(case):
    proof = certify(case)
    assert proof.complete
    assert not proof.undecided
    assert len(proof.isolated) == len(symmetric_solutions(case))


FORCES = [(1.0, 1.0), (0.0, 0.0), (1.0, 0.72), (-2.0, 0.5), (0.0, 0.01)]


def test_lists_under_many_forces_at_once_are_complete(chapter, monkeypatch):
    for forces, listed in zip(FORCES, symmetric_solutions_under(chapter(), FORCES), strict=True):
        monkeypatch.setattr(module, "symmetric_solutions", lambda _, listed=listed: listed)
        assert certify(chapter(*forces)).complete


@pytest.mark.parametrize("left_out", [0, 1])
def test_a_missing_root_is_noticed(chapter, monkeypatch, left_out):
    system = chapter()
    listed = np.delete(symmetric_solutions(system), left_out, axis=0)
    monkeypatch.setattr(module, "symmetric_solutions", lambda _: listed)
    proof = certify(system)
    assert not proof.undecided
    assert not proof.complete


@pytest.mark.parametrize("seed", range(12))
def test_random_systems_are_complete(seed):
    system = random_system(np.random.default_rng([seed, 4]))
    assert certify(system).complete, system


def test_a_double_root_is_reported_as_undecided(chapter):
    """Identical modules in step: the lag 0 is a double root at a kink, so nothing is claimed there."""
    proof = certify(chapter(sigma20_hat=0))
    assert not proof.complete
    assert proof.undecided
    for lower, upper in proof.undecided:
        assert min(upper, 1 - lower) < 1e-6


@pytest.mark.parametrize(
    "changes",
    [
        {"f10_hat": 0, "f20_hat": 0},
        {"f10_hat": 0, "f20_hat": 0, "alpha12_hat": 0, "gamma12_hat": 0},
    ],
)
def test_what_nothing_drives_has_no_response(chapter, changes):
    system = chapter(**changes)
    assert certify(system) == module.Proof([], [], complete=True)
    assert orbits(system) == []


def test_a_box_held_still_by_the_other_one(chapter):
    """Box 2 tuned as an undamped absorber of the force on box 1, which then does not move without balls."""
    absorber = {"gamma2_hat": 0, "gamma12_hat": 0, "alpha12_hat": 1, "f10_hat": 1.5, "f20_hat": 0}
    # 1 + epsilon (sigma20_hat + alpha12_hat) = Omega^2 with Omega = 1 + epsilon sigma_e_hat, in exact fractions.
    system = chapter(epsilon=0.25, sigma_e_hat=0.5, sigma20_hat=0.0625, **absorber)
    assert forced_amplitude(system)[0] == 0
    proof = certify(system)
    assert proof.complete
    assert proof.isolated
