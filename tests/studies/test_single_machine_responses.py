"""Responses of a single machine agree with closed forms, proofs, and the same machine next to a second one."""

import numpy as np
import pytest

import vibroimpact as vi
from single_machines import FIRST, MACHINE, MACHINES, SECOND, company, holds, partner, same_numbers
from vibroimpact.exact.orbits.search import half_period_multipliers
from vibroimpact.studies.completeness import orbits as certify
from vibroimpact.studies.completeness import points as completeness_proof
from vibroimpact.studies.regimes.branches import Path, branches, images
from vibroimpact.studies.regimes.continuation import Lost
from vibroimpact.studies.regimes.families import AsymmetricOrbits, FixedPoints, SymmetricOrbits
from vibroimpact.studies.theory import asymmetric_points
from vibroimpact.theory.fixed_points.symmetric_points import search
from vibroimpact.theory.manifold import rho
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C


@MACHINES
def test_asymmetric_points_are_those_of_the_machine_next_to_a_second_one(machine):
    (module,), both = machine.modules, company(machine)
    skewed, all_skewed = asymmetric_points.search(machine), asymmetric_points.search(both)
    all_skewed = [point for point in all_skewed if point.asymmetric[module - 1]]
    assert bool(skewed) == bool(all_skewed)
    if skewed:
        same_numbers(skewed, all_skewed, module, ["C", "B", "psi", "squared", "middle"])
    for point in skewed:
        twin = partner(point, all_skewed, module)
        assert holds(twin.slow_eigenvalues, point.slow_eigenvalues)
        assert holds(twin.fast(machine.kappa), point.fast(machine.kappa))
        assert point.real == bool(point.squared[module - 1] >= 0)


@MACHINES
def test_the_list_of_orbits_is_proved_complete(machine):
    proof = certify.certify(machine)
    assert proof.complete
    symmetric = [orbit for orbit in vi.orbits(machine) if orbit.symmetric]
    assert len(proof.isolated) == len(symmetric)


@MACHINES
def test_lists_of_fixed_points_are_proved_complete(machine):
    (module,) = machine.modules
    proof, skewed = completeness_proof.certify(machine), completeness_proof.certify_asymmetric(machine)
    assert proof.complete
    assert skewed.complete
    listed = sorted(point.C[module - 1] for point in search(machine))
    assert len(proof.isolated) == len(listed)
    assert all(low < C < high for ((low, high),), C in zip(proof.isolated, listed, strict=True))
    assert proof.motions == sum(C > 0 for C in listed)
    assert len(skewed.isolated) == len(asymmetric_points.search(machine))


# Continuation


def loaded(machine, C):
    """Return the force of the fixed point with this C: |q| of the balance (10.23), where q is linear in C."""
    (module,) = machine.modules
    detuning = (module == 2) * machine.sigma20_hat - 2 * machine.sigma_e_hat
    impedance = detuning + 1j * (machine.gamma1_hat, machine.gamma2_hat)[module - 1]
    return abs(impedance * (1 - (1 + 1j * rho(machine.kappa)) * C) + 8 / np.pi**2 * C)


@MACHINES
def test_branches_of_fixed_points_pass_special_points_in_closed_form(machine):
    (module,) = machine.modules
    force = f"f{module}0_hat"
    found = vi.branches(machine, force, (0.3, 2.2), of="theory", seeds=3)
    for node in (node for branch in found for node in branch.nodes):
        assert loaded(machine, node.amplitudes[module - 1]) == pytest.approx(node.p, abs=1e-9)
        assert np.isnan(node.amplitudes[2 - module])
    kinds = {node.kind: node for branch in found for node in branch.special}
    assert kinds[f"symmetry breaking, module {module}"].p == pytest.approx(loaded(machine, SYMMETRY_BREAKING_C))
    fold = kinds[f"fold of the SIM, module {module}"]
    assert fold.p == pytest.approx(loaded(machine, 1 / (1 + rho(machine.kappa) ** 2)))
    assert not any(str(3 - module) in kind for kind in kinds)
    for inner, _ in (piece for branch in found for piece in branch.pieces()):
        there = machine.with_(**{force: inner.p})
        point = partner(FixedPoints.member(there, inner.x), vi.fixed_points(there), module)
        assert inner.stable == (point.stability.theory == "stable")


def test_an_undamped_branch_ends_where_the_ball_speed_vanishes():
    undamped = MACHINE.with_(gamma1_hat=0, gamma2_hat=0, sigma_e_hat=-0.5)
    (branch,) = vi.branches(undamped, "f10_hat", (0.3, 2.0), of="theory", seeds=3)
    (end,) = (node for node in branch.special if node.kind == "speed zero")
    assert end.p == pytest.approx(loaded(undamped, 0.0), abs=1e-9)
    assert abs(end.amplitudes[0]) < 1e-9


def test_a_branch_on_which_the_other_module_is_active_is_skipped_with_a_warning():
    with pytest.warns(
        UserWarning, match=r"fixed point: skipped the branch through f20_hat = 0: only one of the two modules"
    ):
        found = vi.branches(MACHINE, "f20_hat", (0.0, 1.2), of="theory", seeds=2)
    assert all(np.isfinite(node.amplitudes).all() for branch in found for node in branch.nodes)
    assert found


def test_branches_of_orbits_break_their_symmetry_where_the_machine_next_to_a_second_one_does():
    path, interval = Path(SECOND, ("f20_hat",)), (1.07, 1.12)
    families = SymmetricOrbits, AsymmetricOrbits
    found = [one for family in families for one in branches(family, path, interval, [1.1], 0.05)]
    nodes = (node for one in found if one.family is SymmetricOrbits for node in one.special)
    (breaking,) = (node for node in nodes if node.kind == "symmetry breaking")
    system = path(breaking.p)
    orbit = partner(SymmetricOrbits.member(system, breaking.x), vi.orbits(company(system)), 2, ["C", "impact_phases"])
    assert abs(half_period_multipliers(orbit) + 1).min() < 1e-8
    for orbit in (one for one in vi.orbits(path(1.1)) if one.admissible):
        on = [one for one in found if (one.family is SymmetricOrbits) == orbit.symmetric]
        assert min(abs(node.amplitudes[1] - orbit.C[1]) for one in on for node in one.nodes) < 1e-9
    frame = vi.to_frame(found)
    assert frame["C1"].isna().all()
    assert frame["C2"].notna().all()


@pytest.mark.parametrize("family", [FixedPoints, SymmetricOrbits, AsymmetricOrbits])
def test_the_response_of_one_module_is_not_continued_to_systems_with_two_active_modules(family):
    root = family.roots(SECOND)[-1]
    assert np.abs(family.equations(SECOND, root)[0]).max() < 1e-9
    with pytest.raises(Lost, match="only one of the two modules has impacts"):
        family.equations(company(SECOND), root)
    assert all(np.abs(family.equations(SECOND, image)[0]).max() < 1e-9 for image in images(family, SECOND, root, root))


def test_an_undamped_resonance_of_the_idle_module_has_no_effect():
    for stiffness in (1.0, 9.0):
        resonant = FIRST.with_(gamma2_hat=0, sigma20_hat=(stiffness * FIRST.Omega**2 - 1) / FIRST.epsilon)
        same_numbers(asymmetric_points.search(resonant), asymmetric_points.search(FIRST), 1, ["C", "psi"])
        assert completeness_proof.certify(resonant).complete
        assert certify.certify(resonant).complete
