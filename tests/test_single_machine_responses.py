"""Periodic responses of a single machine: against its twin, company it does not feel, closed forms and simulations."""

import io

import numpy as np
import pytest
from scipy.optimize import brentq

import vibroimpact as vi
from vibroimpact.cli.commands import Table
from vibroimpact.exact.orbits.search import half_period_multipliers
from vibroimpact.studies.completeness import orbits as certify
from vibroimpact.studies.completeness import points as completeness_proof
from vibroimpact.studies.regimes.branches import Path, branches
from vibroimpact.studies.regimes.continuation import Lost
from vibroimpact.studies.regimes.families import AsymmetricOrbits, FixedPoints, SymmetricOrbits
from vibroimpact.studies.theory import asymmetric_points
from vibroimpact.theory.criteria import of_fixed_point, of_orbit
from vibroimpact.theory.fixed_points.balance import singular_points
from vibroimpact.theory.fixed_points.symmetric_points import search
from vibroimpact.theory.manifold import rho
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C
from vibroimpact.theory.response import leading_order, mean_power

MACHINE = vi.PhysicalSystem.single(M=1, m=0.05, k=1, c=0.02, F=0.05, L=1, kappa=0.65).dimensionless()
FIRST = vi.System(
    epsilon=0.1, kappa=0.65, alpha12_hat=0, gamma12_hat=0, gamma1_hat=0.3, gamma2_hat=0.7, sigma20_hat=-0.5,
    sigma_e_hat=0.1, f10_hat=1.4, f20_hat=0,
)  # fmt: skip
SECOND = FIRST.with_(gamma2_hat=0.3, sigma20_hat=0.4, sigma_e_hat=0, f10_hat=0, f20_hat=1.2)
"""FIRST and SECOND have asymmetric responses too; the module that takes no part is another one."""
MACHINES = pytest.mark.parametrize("machine", [MACHINE, FIRST, SECOND], ids=["machine", "first", "second"])


def company(machine):
    """The machine beside another one that is driven, too, and that it does not feel."""
    (module,) = machine.modules
    return machine.with_(**{f"f{3 - module}0_hat": 1.7})


def places(responses, module, names):
    """Distinct numbers (n, d) of a module in some responses, sorted."""
    numbers = [np.concatenate([np.ravel(getattr(one, name)[module - 1]) for name in names]) for one in responses]
    return np.unique(np.round(numbers, 9), axis=0)


def same_numbers(alone, together, module, names):
    """The numbers of the module are the same in both lists; those of the other module are NaN in the first."""
    np.testing.assert_allclose(places(alone, module, names), places(together, module, names), rtol=0, atol=2e-9)
    assert np.isnan(places(alone, 3 - module, names)).all()


def holds(many, few):
    """True if each of few complex numbers is among the many, as often."""
    left = list(many)
    for value in few:
        nearest = int(np.argmin(np.abs(np.array(left) - value)))
        if abs(left.pop(nearest) - value) > 1e-7 * (1 + abs(value)):
            return False
    return True


def partner(one, others, module, names=("C",)):
    """The response among others that is the same one in a module."""
    return min(others, key=lambda o: sum(np.abs(getattr(o, n) - getattr(one, n))[module - 1].max() for n in names))


def everything(system):
    """All fixed points, also those with some C below 0."""
    return [point for part in search(system) for point in part]


@MACHINES
def test_fixed_points_are_those_of_the_module_in_company(machine):
    (module,), both = machine.modules, company(machine)
    for point in everything(machine):
        assert holds(partner(point, everything(both), module).slow_eigenvalues, point.slow_eigenvalues)
        assert point.slow_eigenvalues.shape == (2,)
        assert len(singular_points(machine, point, module)) == 0
    same_numbers(everything(machine), everything(both), module, ["C", "B", "psi"])
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
def test_orbits_are_those_of_the_module_in_company(machine):
    (module,), together = machine.modules, vi.orbits(company(machine))
    alone = vi.orbits(machine)
    names = ["C", "impact_phases", "ball_speeds"]
    for symmetric in (True, False):
        one = [orbit for orbit in alone if orbit.symmetric == symmetric]
        two = [orbit for orbit in together if (np.ptp(orbit.ball_speeds[module - 1]) < 1e-7) == symmetric]
        assert bool(one) == bool(two)
        if one:
            same_numbers(one, two, module, names)
        for orbit in one:
            twin = partner(orbit, two, module, names)
            assert holds(twin.multipliers, orbit.multipliers)
            assert orbit.multipliers.shape == (4,)
            assert orbit.residual < 1e-12
    for orbit in (one for one in alone if one.symmetric):
        half = half_period_multipliers(orbit)
        assert holds(half**2, orbit.multipliers)
        assert half.shape == (4,)
    assert any(one.admissible for one in alone)


def test_verdicts_and_rows_are_those_of_the_twin():
    for machine in (MACHINE, FIRST.with_(gamma2_hat=0.3, sigma20_hat=0)):
        twin = machine.with_(f20_hat=machine.f10_hat)
        for of, verdicts in (
            (vi.fixed_points, lambda s, p: of_fixed_point(s, p)),
            (vi.orbits, lambda s, o: of_orbit(o)),
        ):
            # The proof of an orbit needs impacts in turn, and the twin's are at once.
            diagonal = [one for one in of(twin) if abs(np.diff(one.C)[0]) < 1e-9]
            diagonal = [
                one for one in diagonal if of is vi.fixed_points or np.ptp(one.impact_phases, axis=0).max() < 1e-9
            ]
            alone = of(machine)
            assert len(alone) == len(diagonal) > 0
            for one in alone:
                same = partner(one, diagonal, 1, ["C"] if of is vi.fixed_points else ["C", "impact_phases"])
                assert verdicts(machine, one) == verdicts(twin, same)
                assert one.stability == same.stability
                row, expected = one.row(), same.row()
                assert list(row) == list(expected)
                for name in set(row) - {"residual", "label"}:
                    idle = "2" in name
                    if idle:
                        assert np.isnan(row[name])
                    elif isinstance(row[name], float):
                        assert row[name] == pytest.approx(expected[name], abs=1e-9)
                    else:
                        assert row[name] == expected[name], name
                if of is vi.orbits:
                    assert one.excursion == pytest.approx(same.excursion, abs=1e-9)
            frame = vi.to_frame(alone)
            assert frame["C2"].isna().all()
            assert frame["C1"].tolist() == [one.C[0] for one in alone]


@MACHINES
def test_response_and_power_have_a_module_at_rest(machine):
    (module,), both = machine.modules, company(machine)
    point = vi.fixed_points(machine)[0]
    same = partner(point, vi.fixed_points(both), module)
    tau = np.linspace(0, 20, 41)
    for name in ("U", "X", "W", "Y"):
        mine, theirs = (getattr(leading_order(s, p, tau), name) for s, p in ((machine, point), (both, same)))
        np.testing.assert_allclose(mine[:, module - 1], theirs[:, module - 1], atol=1e-9)
        assert not mine[:, 2 - module].any()
    power = mean_power(machine, point)
    assert power.work.sum() == pytest.approx(power.ground.sum() + power.coupling + power.impacts.sum(), rel=1e-12)


def test_the_example_has_one_orbit_that_is_a_motion():
    (orbit,) = (one for one in vi.orbits(MACHINE) if one.admissible)
    assert (orbit.symmetric, orbit.stability) == (True, "stable")
    assert abs(orbit.multipliers[0]) == pytest.approx(0.882, abs=5e-4)
    assert np.log(abs(orbit.multipliers[0])) == pytest.approx(-0.1253, abs=5e-5)


# A second module that is truly at rest.


@MACHINES
def test_orbits_are_periodic_under_simulation_beside_a_module_at_rest(machine):
    (module,) = machine.modules
    own = np.flatnonzero(np.array([1, 1, 2, 2, 1, 1, 2, 2]) == module)
    rest = np.setdiff1d(np.arange(8), own)
    motions = [orbit for orbit in vi.orbits(machine) if orbit.admissible]
    assert motions
    for orbit in motions:
        assert not orbit.state[rest].any()
        run = vi.simulate(machine, orbit.state, 1)
        np.testing.assert_allclose(run.final, orbit.state, rtol=0, atol=1e-11)
        assert set(run.events["module"]) == {module}
        assert not run.final[rest].any()
        assert holds(np.linalg.eigvals(run.jacobian[np.ix_(own, own)]), orbit.multipliers)


# Masri's two impacts per cycle, in units of F / k and of natural time; d is the whole play.
MU, E, ZETA, D = 0.1, 0.8, 0.01, 20.0
HALF, ETA = np.pi, np.sqrt(1 - ZETA**2)


def free(x, v, t):
    """Unforced box after a time t: position and velocity."""
    c, s = np.exp(-ZETA * t) * np.cos(ETA * t), np.exp(-ZETA * t) * np.sin(ETA * t) / ETA
    return x * (c + ZETA * s) + v * s, v * (c - ZETA * s) - x * s


def forced(t):
    """Box without impacts at resonance, r = 1, under the force sin t: position and velocity."""
    return -np.cos(t) / (2 * ZETA), np.sin(t) / (2 * ZETA)


def masri():
    """Speed V of the ball and time of the impact at the wall where x - z = d / 2, of the larger V.

    All that the box does is linear in V. It is kicked by -2 mu V there, and its unforced part h returns with opposite
    sign after half a cycle.
    """
    columns = np.transpose([free(*unit, HALF) for unit in np.eye(2)])
    after = np.linalg.solve(np.eye(2) + columns, [0.0, -2 * MU])  # h, h' just after; h' before is 2 mu higher
    # Newton's rule: (1 + e) v = V (1 + 2 mu - e), v before the impact. Way of the ball: 2 (d / 2 - x) = V pi.
    velocity = (1 + 2 * MU - E) / (1 + E) - (after[1] + 2 * MU)
    place = np.polysub([D / 2], [HALF / 2 + after[0], 0.0])
    V = np.roots(np.polyadd(np.polymul(place, place), [velocity**2, 0, 0]) - [0, 0, 1 / (2 * ZETA) ** 2]).max()
    return V, np.arctan2(V * velocity, -np.polyval(place, V)), after * V


def half_cycle(state):
    """The state just after an impact at that wall, x, x', z' and time, mapped to that after the next, mirrored."""
    x, v, u, t0 = state
    at, speed = forced(t0)

    def box(t):
        return np.add(free(x - at, v - speed, t), forced(t0 + t))

    t = brentq(lambda t: box(t)[0] - (x - D / 2 + u * t) + D / 2, 0.7 * HALF, 1.3 * HALF, xtol=1e-15)
    x, v = box(t)
    relative = v - u
    v, u = v - MU * (1 + E) / (1 + MU) * relative, u + (1 + E) / (1 + MU) * relative
    return np.array([-x, -v, -u, t0 + t - HALF])


def test_masris_closed_form_of_one_machine():
    V, time, h = masri()
    start = np.array([*np.add(h, forced(time)), V, time])
    np.testing.assert_allclose(half_cycle(start), start, atol=1e-12)
    times = np.linspace(0, HALF, 4001)
    largest = np.abs(free(*h, times)[0] + forced(time + times)[0]).max()
    steps = 1e-5 * np.eye(4)
    jacobian = np.transpose([(half_cycle(start + step) - half_cycle(start - step)) / 2e-5 for step in steps])
    multiplier = np.abs(np.linalg.eigvals(jacobian)).max() ** 2
    assert (V, largest, multiplier) == pytest.approx((7.696818, 2.538798, 0.905322), abs=6e-7)

    machine = vi.PhysicalSystem.single(M=1, m=MU, k=1, c=2 * ZETA, F=1, L=D / 2, kappa=E).dimensionless()
    (orbit,) = (one for one in vi.orbits(machine) if one.admissible)
    run = vi.simulate(machine, orbit.state, 1, sample_times=np.linspace(0, machine.period, 8001))
    mine = orbit.ball_speeds[0, 0] * D / 2, np.abs(run.samples[:, 0]).max() * D / 2, abs(orbit.multipliers[0])
    assert mine == pytest.approx((V, largest, multiplier), abs=1e-6)
    assert mine[0] == pytest.approx(V, rel=1e-12)


# Proofs.


@MACHINES
def test_orbits_are_proved(machine):
    proof = certify.certify(machine)
    assert proof.complete
    symmetric = [orbit for orbit in vi.orbits(machine) if orbit.symmetric]
    assert len(proof.isolated) == len(symmetric)
    for orbit in vi.orbits(machine):
        proved = vi.prove(orbit)
        assert proved.stability == orbit.stability
        assert proved.motion == ("legal" if orbit.admissible else "not legal")
        assert len(proved.multipliers) == 4
        assert max(proved.error, proved.moduli_error) < 1e-9
        assert orbit.with_proof().proved


def test_without_a_symmetric_orbit_that_is_proved_too():
    weak = FIRST.with_(f10_hat=0.1)
    assert certify.certify(weak) == certify.Proof([], [], True)
    assert vi.orbits(weak) == []


@MACHINES
def test_lists_of_fixed_points_are_proved_complete(machine):
    (module,) = machine.modules
    proof, skewed = completeness_proof.certify(machine), completeness_proof.certify_asymmetric(machine)
    assert proof.complete
    assert skewed.complete
    listed = sorted(point.C[module - 1] for point in everything(machine))
    assert len(proof.isolated) == len(listed)
    assert all(low < C < high for ((low, high),), C in zip(proof.isolated, listed, strict=True))
    assert proof.motions == sum(C > 0 for C in listed)
    assert len(skewed.isolated) == len(asymmetric_points.search(machine))


# Continuation.


def loaded(machine, C):
    """Force of the fixed point with a C: |q| of the balance (10.23), which is linear in C."""
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


def test_an_undamped_branch_ends_where_the_ball_has_no_speed_in_phase_with_the_force():
    undamped = MACHINE.with_(gamma1_hat=0, gamma2_hat=0, sigma_e_hat=-0.5)
    (branch,) = vi.branches(undamped, "f10_hat", (0.3, 2.0), of="theory", seeds=3)
    (end,) = (node for node in branch.special if node.kind == "speed zero")
    assert end.p == pytest.approx(loaded(undamped, 0.0), abs=1e-9)
    assert abs(end.amplitudes[0]) < 1e-9


def test_a_path_on_which_the_other_module_takes_part_says_so():
    with pytest.warns(UserWarning, match=r"fixed point at f20_hat = 0 not followed: both modules take part"):
        found = vi.branches(MACHINE, "f20_hat", (0.0, 1.2), of="theory", seeds=2)
    assert all(np.isfinite(node.amplitudes).all() for branch in found for node in branch.nodes)
    assert found


def test_branches_of_orbits_break_their_symmetry_where_the_module_in_company_does():
    path, interval = Path(SECOND, ("f20_hat",)), (1.07, 1.12)
    found = [
        one for family in (SymmetricOrbits, AsymmetricOrbits) for one in branches(family, path, interval, [1.1], 0.05)
    ]
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


def test_a_curve_of_symmetry_breaking_in_closed_form():
    plane = [(0.5, 1.5), (-0.3, 0.3)]
    (curve,) = vi.bifurcation_curves(SECOND, ("f20_hat", "sigma_e_hat"), plane, seeds=1)
    assert curve.kind == "symmetry breaking, module 2"
    for force, detuning in curve.points:
        expected = loaded(SECOND.with_(sigma_e_hat=detuning), SYMMETRY_BREAKING_C)
        assert force == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("family", [FixedPoints, SymmetricOrbits, AsymmetricOrbits])
def test_the_response_of_one_module_is_not_followed_where_both_take_part(family):
    root = family.roots(SECOND)[-1]
    assert np.abs(family.equations(SECOND, root)[0]).max() < 1e-9
    with pytest.raises(Lost, match="both modules take part"):
        family.equations(company(SECOND), root)
    assert all(np.abs(family.equations(SECOND, image)[0]).max() < 1e-9 for image in family.images(SECOND, root))


# What takes no part does not matter.


def test_an_undamped_resonance_of_the_module_at_rest_is_no_obstacle():
    """Its box would resonate with the force, and with the third harmonic of the impacts."""
    for stiffness in (1.0, 9.0):
        resonant = FIRST.with_(gamma2_hat=0, sigma20_hat=(stiffness * FIRST.Omega**2 - 1) / FIRST.epsilon)
        assert resonant.modules == (1,)
        for of, names in ((vi.fixed_points, ["C", "psi"]), (vi.orbits, ["C", "impact_phases", "ball_speeds"])):
            same_numbers(of(resonant), of(FIRST), 1, names)
        same_numbers(asymmetric_points.search(resonant), asymmetric_points.search(FIRST), 1, ["C", "psi"])
        assert completeness_proof.certify(resonant).complete
        assert certify.certify(resonant).complete
        assert vi.prove(vi.orbits(resonant)[0]).stability == "unstable"
    resonant = SECOND.with_(gamma1_hat=0)  # Omega = 1 is the natural frequency of box 1
    same_numbers(vi.fixed_points(resonant), vi.fixed_points(SECOND), 2, ["C", "psi"])
    same_numbers(vi.orbits(resonant), vi.orbits(SECOND), 2, ["C", "impact_phases", "ball_speeds"])


def test_a_table_has_empty_fields_for_the_module_at_rest():
    orbit = vi.orbits(SECOND)[-1]
    row, file = orbit.row(), io.StringIO()
    Table(("C1", "C2"), [(row["C1"], row["C2"])]).write(file)
    assert file.getvalue() == f"C1,C2\n,{orbit.C[1]!r}\n".replace("np.float64(", "").replace(")", "")
