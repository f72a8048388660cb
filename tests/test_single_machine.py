"""A single machine: one module takes part, and every answer is its own."""

import numpy as np
import pytest
from scipy.linalg import expm

import vibroimpact as vi
from vibroimpact.claims.verdict_table import fixed_point_rows, orbit_rows
from vibroimpact.exact.orbits.search import half_period_multipliers
from vibroimpact.theory.asymmetric import asymmetric_points
from vibroimpact.theory.criteria import of_fixed_point, of_orbit

EXAMPLE = vi.PhysicalSystem.single(M=1, m=0.05, k=1, c=0.02, F=0.05, L=1, kappa=0.65).dimensionless()
STRONG = EXAMPLE.with_(f10_hat=1.6)
"""With asymmetric orbits and fixed points."""
SYSTEMS = [EXAMPLE, STRONG, EXAMPLE.with_(sigma20_hat=3.0, gamma2_hat=0.0), STRONG.with_(f10_hat=-1.6, kappa=0.3)]


def twin_of(system):
    """Two machines alike: the second has all parameters of the first."""
    return system.with_(sigma20_hat=0.0, gamma2_hat=system.gamma1_hat, f20_hat=system.f10_hat)


def mirrored(system):
    """The machine as module 2, beside a module 1 without force."""
    return system.with_(
        sigma20_hat=0.0, gamma1_hat=0.7, gamma2_hat=system.gamma1_hat, f10_hat=0.0, f20_hat=system.f10_hat
    )


def alike(twin_members, of):
    """Those of the twin in which both modules do the same, by what they are."""
    return [one for one in twin_members if np.allclose(of(one)[0], of(one)[1], atol=1e-7)]


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("module", [1, 2])
def test_fixed_points_are_those_of_the_twin(system, module):
    twins = alike(vi.fixed_points(twin_of(system)), lambda point: np.column_stack([point.C, point.psi]))
    machine = system if module == 1 else mirrored(system)
    points = vi.fixed_points(machine)
    assert len(points) == len(twins) > 0
    for point, twin in zip(points, twins, strict=True):
        for name in ("C", "B", "psi"):
            assert getattr(point, name)[module - 1] == pytest.approx(getattr(twin, name)[0], abs=1e-9)
            assert np.isnan(getattr(point, name)[2 - module])
        found = np.sort_complex(np.repeat(point.slow_eigenvalues, 2))
        np.testing.assert_allclose(found, np.sort_complex(twin.slow_eigenvalues), atol=1e-7)
        assert of_fixed_point(machine, point) == of_fixed_point(twin_of(system), twin)


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("module", [1, 2])
def test_orbits_are_those_of_the_twin(system, module):
    def numbers(orbit):
        return np.hstack([orbit.impact_phases, orbit.ball_speeds])

    twins = alike(vi.orbits(twin_of(system)), numbers)
    machine = system if module == 1 else mirrored(system)
    orbits = vi.orbits(machine)
    assert len(orbits) == len(twins) > 0
    for orbit in orbits:
        own = numbers(orbit)[module - 1]
        twin = min(twins, key=lambda one: np.abs(numbers(one)[0] - own).max())
        np.testing.assert_allclose(own, numbers(twin)[0], atol=1e-9)
        assert np.isnan(numbers(orbit)[2 - module]).all()
        np.testing.assert_allclose(np.abs(np.repeat(orbit.multipliers, 2)), np.abs(twin.multipliers), rtol=1e-6)
        same = "symmetric", "admissible", "stability"
        assert [getattr(orbit, name) for name in same] == [getattr(twin, name) for name in same]
        assert orbit.excursion == pytest.approx(twin.excursion, abs=1e-9)
        assert orbit.residual < 1e-11
        assert of_orbit(orbit) == of_orbit(twin)
        if orbit.symmetric:
            np.testing.assert_allclose(
                np.sort(np.abs(half_period_multipliers(orbit)) ** 2), np.sort(np.abs(orbit.multipliers)), rtol=1e-6
            )


@pytest.mark.parametrize("machine", [EXAMPLE, STRONG, mirrored(STRONG)])
def test_an_orbit_is_the_motion_beside_a_module_at_rest(machine):
    """The state repeats under the simulation, whose Jacobian has the multipliers in the rows of the module."""
    (module,) = machine.modules
    own = [2 * module - 2, 2 * module - 1, 2 * module + 2, 2 * module + 3]
    moving = [orbit for orbit in vi.orbits(machine) if orbit.admissible]
    assert moving
    for orbit in moving:
        run = vi.simulate(machine, orbit.state, 1)
        np.testing.assert_allclose(run.final, orbit.state, atol=1e-12)
        assert not np.delete(orbit.state, own).any()
        values = np.linalg.eigvals(run.jacobian[np.ix_(own, own)])
        np.testing.assert_allclose(np.sort(np.abs(values)), np.sort(np.abs(orbit.multipliers)), rtol=1e-8)


def test_the_example_of_a_machine_has_one_stable_symmetric_motion():
    (orbit,) = [orbit for orbit in vi.orbits(EXAMPLE) if orbit.admissible]
    assert (orbit.symmetric, orbit.stable) == (True, True)
    assert abs(orbit.multipliers[0]) == pytest.approx(0.882, abs=5e-4)
    assert np.log(abs(orbit.multipliers[0])) == pytest.approx(-0.1253, abs=5e-5)


def test_the_motion_with_two_impacts_is_that_of_masri_in_closed_form():
    """mu = 0.1, e = 0.8, zeta = 0.01, r = 1, the play d = 20 F/k (Masri and Caughey 1966).

    Between impacts the box moves as R sin(t + phi) + V h(t). The ball crosses the play in half a period, so that the
    velocity V of the ball and the box just before and after an impact follow from the impact law; h from the symmetry
    x(t + pi) = -x(t); the square of both amplitudes of the forced part is a quadratic for V.
    """
    mu, e, zeta, L = 0.1, 0.8, 0.01, 10.0
    before = (1 + 2 * mu - e) / (1 + e)  # velocity of the box over V
    half = expm(np.array([[0.0, 1.0], [-1.0, -2 * zeta]]) * np.pi)
    h = -np.linalg.solve(half + np.eye(2), [0.0, 2 * mu])
    sine, cosine = np.pi / 2 + h[0], before - 2 * mu - h[1]
    forced = 1 / (2 * zeta)  # at resonance
    V = max(np.roots([sine**2 + cosine**2, -2 * L * sine, L**2 - forced**2]))
    assert abs(V - 7.696818) < 5e-7

    machine = vi.PhysicalSystem.single(M=1, m=mu, k=1, c=2 * zeta, F=1, L=L, kappa=e).dimensionless()
    (orbit,) = [orbit for orbit in vi.orbits(machine) if orbit.admissible]
    np.testing.assert_allclose(orbit.ball_speeds[0] * L, V, rtol=1e-12)
    t = np.linspace(0.0, np.pi, 4001)
    phase = np.arctan2(L - V * sine, V * cosine)
    motion = [forced * np.sin(s + phase) + V * (expm(np.array([[0, 1], [-1, -2 * zeta]]) * s) @ h)[0] for s in t]
    run = vi.simulate(machine, orbit.state, 1, sample_times=np.linspace(0, 1, 8001) * machine.period)
    assert np.abs(motion).max() == pytest.approx(2.538798, abs=5e-7)
    assert np.abs(run.samples[:, 0]).max() * L == pytest.approx(2.538798, abs=1e-6)
    assert abs(orbit.multipliers[0]) == pytest.approx(0.905322, abs=5e-7)


@pytest.mark.parametrize("machine", [EXAMPLE, STRONG, mirrored(STRONG)])
def test_lists_are_proved_complete_and_orbits_proved(machine):
    pytest.importorskip("flint")
    from vibroimpact.exact.orbits.certify import certify as certify_orbits
    from vibroimpact.theory.completeness_proof import certify, certify_asymmetric

    points, asymmetric, orbits = certify(machine), certify_asymmetric(machine), certify_orbits(machine)
    assert (points.complete, asymmetric.complete, orbits.complete) == (True, True, True)
    assert len(asymmetric.isolated) == len(asymmetric_points.search(machine)) == (machine != EXAMPLE)
    assert len(orbits.isolated) == 2
    for orbit in vi.orbits(machine):
        assert orbit.with_proof().proof.stability == orbit.stability


def test_tables_have_blanks_for_the_module_at_rest():
    points, orbits = vi.to_frame(vi.fixed_points(EXAMPLE)), vi.to_frame(vi.orbits(EXAMPLE))
    assert points[["C2", "B2", "psi2"]].isna().all(axis=None)
    assert orbits[["C2", "phase2_plus", "speed2_minus"]].isna().all(axis=None)
    assert not orbits[["C1", "largest_multiplier"]].isna().any(axis=None)
    table = orbit_rows("machine", vi.orbits(EXAMPLE))
    verdicts = fixed_point_rows("machine", EXAMPLE, [("a", *vi.fixed_points(EXAMPLE))], table)
    assert verdicts["orbit"].tolist() == table.loc[table["admissible"], "label"].tolist()
    assert verdicts["exact"].tolist() == ["stable"]


def test_without_any_force_there_is_nothing():
    idle = EXAMPLE.with_(f10_hat=0.0)
    assert vi.fixed_points(idle) == vi.orbits(idle) == asymmetric_points.search(idle) == []
