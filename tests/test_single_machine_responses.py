"""Periodic responses of a single machine agree with those of an uncoupled module, closed forms and runs."""

import numpy as np
import pytest
from scipy.optimize import brentq

import vibroimpact as vi
from mean_power import mean_power
from single_machines import FIRST, MACHINE, MACHINES, SECOND, company, holds, partner, same_numbers
from vibroimpact.exact.orbits.search import half_period_multipliers
from vibroimpact.theory.criteria import of_fixed_point
from vibroimpact.theory.fixed_points.balance import singular_points
from vibroimpact.theory.fixed_points.symmetric_points import search


@MACHINES
def test_fixed_points_are_those_of_a_module_next_to_another_machine(machine):
    (module,), both = machine.modules, company(machine)
    for point in search(machine):
        assert holds(partner(point, search(both), module).slow_eigenvalues, point.slow_eigenvalues)
        assert point.slow_eigenvalues.shape == (2,)
        assert len(singular_points(machine, point, module)) == 0
    same_numbers(search(machine), search(both), module, ["C", "B", "psi"])


@MACHINES
def test_orbits_are_those_of_a_module_next_to_another_machine(machine):
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


@pytest.mark.parametrize("machine", [MACHINE, FIRST.with_(gamma2_hat=0.3, sigma20_hat=0)])
@pytest.mark.parametrize("of", [vi.fixed_points, vi.orbits])
def test_verdicts_and_rows_are_those_of_two_equal_machines(machine, of):
    twin = machine.with_(f20_hat=machine.f10_hat)
    names = ["C"] if of is vi.fixed_points else ["C", "impact_phases"]
    diagonal = [one for one in of(twin) if all(np.ptp(getattr(one, name), axis=0).max() < 1e-9 for name in names)]
    alone = of(machine)
    assert len(alone) == len(diagonal) > 0
    for one in alone:
        same = partner(one, diagonal, 1, names)
        row, expected = one.row(), same.row()
        if of is vi.fixed_points:
            row, expected = row | of_fixed_point(machine, one), expected | of_fixed_point(twin, same)
        else:
            assert one.excursion == pytest.approx(same.excursion, abs=1e-9)
        assert one.stability == same.stability
        assert list(row) == list(expected)
        # two machines have the moduli of both modules
        differ = "residual", "label", *(f"modulus_{k}" for k in range(2, 9))
        shown = [name for name in row if "2" not in name and name not in differ]
        assert {name: row[name] for name in shown} == pytest.approx({name: expected[name] for name in shown}, abs=1e-9)
        assert all(np.isnan(row[name]) for name in row if name.startswith(("C2", "B2", "psi2", "phase2", "speed2")))


@MACHINES
def test_the_power_balances(machine):
    power = mean_power(machine, vi.fixed_points(machine)[0])
    assert power.work.sum() == pytest.approx(power.ground.sum() + power.coupling + power.impacts.sum(), rel=1e-12)


@MACHINES
def test_runs_from_orbits_are_periodic_and_leave_the_other_module_at_rest(machine):
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


# Masri's motion with two impacts per cycle, in units of F / k and of natural time; D is the total play.
MU, E, ZETA, D = 0.1, 0.8, 0.01, 20.0
HALF, ETA = np.pi, np.sqrt(1 - ZETA**2)


def free(x, v, t):
    """Return position and velocity of the unforced box after a time t."""
    c, s = np.exp(-ZETA * t) * np.cos(ETA * t), np.exp(-ZETA * t) * np.sin(ETA * t) / ETA
    return x * (c + ZETA * s) + v * s, v * (c - ZETA * s) - x * s


def forced(t):
    """Return position and velocity of the box without impacts at resonance, r = 1, under the force sin t."""
    return -np.cos(t) / (2 * ZETA), np.sin(t) / (2 * ZETA)


def masri():
    """Return the larger speed V of the ball, the time of the impact at the wall x - z = D / 2, and the free motion h.

    The motion of the box is linear in V: its velocity jumps by -2 mu V, and its unforced part h changes its sign in
    half a cycle.
    """
    columns = np.transpose([free(*unit, HALF) for unit in np.eye(2)])
    after = np.linalg.solve(np.eye(2) + columns, [0.0, -2 * MU])  # h and h' after the impact; h' before is 2 mu larger
    # Newton's rule: (1 + e) v = V (1 + 2 mu - e), v before the impact. Distance of the ball: 2 (D / 2 - x) = V pi.
    velocity = (1 + 2 * MU - E) / (1 + E) - (after[1] + 2 * MU)
    place = np.polysub([D / 2], [HALF / 2 + after[0], 0.0])
    V = np.roots(np.polyadd(np.polymul(place, place), [velocity**2, 0, 0]) - [0, 0, 1 / (2 * ZETA) ** 2]).max()
    return V, np.arctan2(V * velocity, -np.polyval(place, V)), after * V


def half_cycle(state):
    """Map the state after an impact at that wall, x, x', z' and time, to the mirrored state after the next impact."""
    x, v, u, t0 = state
    at, speed = forced(t0)

    def box(t):
        return np.add(free(x - at, v - speed, t), forced(t0 + t))

    t = brentq(lambda t: box(t)[0] - (x - D / 2 + u * t) + D / 2, 0.7 * HALF, 1.3 * HALF, xtol=1e-15)
    x, v = box(t)
    relative = v - u
    v, u = v - MU * (1 + E) / (1 + MU) * relative, u + (1 + E) / (1 + MU) * relative
    return np.array([-x, -v, -u, t0 + t - HALF])


def test_orbit_and_multiplier_of_a_machine_are_those_of_masri_s_closed_form():
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
    found = orbit.ball_speeds[0, 0] * D / 2, np.abs(run.samples[:, 0]).max() * D / 2, abs(orbit.multipliers[0])
    assert found == pytest.approx((V, largest, multiplier), abs=1e-6)
    assert found[0] == pytest.approx(V, rel=1e-12)


@MACHINES
def test_orbits_are_proved(machine):
    for orbit in vi.orbits(machine):
        proved = vi.prove(orbit)
        assert proved.stability == orbit.stability
        assert proved.motion == ("legal" if orbit.admissible else "not legal")
        assert len(proved.multipliers) == 4
        assert max(proved.error, proved.moduli_error) < 1e-9
        assert orbit.with_proof().proved


def test_an_undamped_resonance_of_the_module_at_rest_has_no_effect():
    """The resonance is with the force, or with the third harmonic of the impacts."""
    for stiffness in (1.0, 9.0):
        resonant = FIRST.with_(gamma2_hat=0, sigma20_hat=(stiffness * FIRST.Omega**2 - 1) / FIRST.epsilon)
        assert resonant.modules == (1,)
        for of, names in ((vi.fixed_points, ["C", "psi"]), (vi.orbits, ["C", "impact_phases", "ball_speeds"])):
            same_numbers(of(resonant), of(FIRST), 1, names)
        assert vi.prove(vi.orbits(resonant)[0]).stability == "unstable"
    resonant = SECOND.with_(gamma1_hat=0)  # Omega = 1 is the natural frequency of box 1
    same_numbers(vi.fixed_points(resonant), vi.fixed_points(SECOND), 2, ["C", "psi"])
    same_numbers(vi.orbits(resonant), vi.orbits(SECOND), 2, ["C", "impact_phases", "ball_speeds"])
