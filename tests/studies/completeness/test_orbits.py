"""Test the proof that lists of symmetric orbits are complete: it succeeds for complete lists only."""

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


def test_lists_of_orbits_for_several_forces_are_complete(monkeypatch):
    forces = [*FORCES.values(), (0.0, 0.0), (1.0, 0.72), (-2.0, 0.5), (0.0, 0.01)]
    for (f10, f20), listed in zip(forces, symmetric_solutions_under(build(), forces), strict=True):
        monkeypatch.setattr(module, "symmetric_solutions", lambda _, listed=listed: listed)
        proof = certify(build(dict(f10_hat=f10, f20_hat=f20)))
        assert proof.complete
        assert not proof.undecided
        assert len(proof.isolated) == len(listed)


@pytest.mark.parametrize("left_out", [0, 1])
def test_a_list_with_a_missing_root_is_not_complete(monkeypatch, left_out):
    system = build()
    listed = np.delete(symmetric_solutions(system), left_out, axis=0)
    monkeypatch.setattr(module, "symmetric_solutions", lambda _: listed)
    proof = certify(system)
    assert not proof.undecided
    assert not proof.complete


@pytest.mark.parametrize("seed", range(12))
def test_lists_for_random_systems_are_complete(seed):
    system = random_system(np.random.default_rng([seed, 4]))
    assert certify(system).complete, system


def test_a_double_root_is_undecided():
    """For identical modules, the phase lag 0 is a double root at a kink; boxes around it are undecided."""
    proof = certify(build(dict(sigma20_hat=0)))
    assert not proof.complete
    assert proof.undecided
    for lower, upper in proof.undecided:
        assert min(upper, 1 - lower) < 1e-6


@pytest.mark.parametrize("changes", [{}, UNCOUPLED])
def test_unforced_systems_have_no_orbit(changes):
    system = build(dict(f10_hat=0, f20_hat=0, **changes))
    assert certify(system) == module.Proof([], [], complete=True)
    assert orbits(system) == []


def test_the_proof_succeeds_if_a_box_does_not_move_without_balls():
    """Box 2 is an undamped absorber, tuned so that box 1 does not move without balls."""
    absorber = {"gamma2_hat": 0, "gamma12_hat": 0, "alpha12_hat": 1, "f10_hat": 1.5, "f20_hat": 0}
    # 1 + epsilon (sigma20_hat + alpha12_hat) = Omega^2 with Omega = 1 + epsilon sigma_e_hat, in exact fractions.
    system = build(dict(epsilon=0.25, sigma_e_hat=0.5, sigma20_hat=0.0625, **absorber))
    assert forced_amplitude(system)[0] == 0
    proof = certify(system)
    assert proof.complete
    assert proof.isolated
