"""Runs agree with flights by matrix exponentials and another integrator, and satisfy symmetries and contact laws."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import vibroimpact as vi
from by_hand import FlightsByHand
from vibroimpact.system.state import IMPACT, RELEASE, STICK

START = np.array([0.1, 0.0, 0.2, 0.0, 0.0, 0.3, 0.0, -0.2])


def audit(run, tolerance=2e-12, grid=40):
    """Check each flight and event of a run with matrix exponentials of the equations written out.

    In flights the gaps are open and contact forces push. Events happen at a wall: impacts obey restitution and conserve
    momentum, velocities are equal after a stick, and a release happens where the force vanishes or at an impact of the
    other module, without a jump. Flights from the last listed impact of a chatter to the stick are not checked.
    """
    epsilon, kappa, flights = run.system.epsilon, run.system.kappa, FlightsByHand(run.system)
    end = np.zeros(1, run.events.dtype)
    end["tau"], end["state"] = run.tau0 + run.cycles * run.system.period, run.final
    walls, state, tau = [0, 0], run.start, run.tau0
    for event in np.concatenate([run.events, end]):
        i, kind, wall, after = int(event["module"]) - 1, event["kind"], event["wall"], event["state"]
        t = event["tau"] - tau
        assert t >= -1e-12
        rate, lifted = flights.rate([w != 0 for w in walls]), flights.lifted(state, tau)
        step = expm(rate * t / grid)
        for n in range(grid + 1 if t > 1e-9 else 0):
            pushes = (rate @ lifted)[2:4]
            for k in range(2):
                gap = lifted[k] - state[2 * k + 1] - n * t / grid * state[2 * k + 5]
                assert abs(gap) < 1 + tolerance or walls[k] or (k == i and kind == STICK)
                assert walls[k] * pushes[k] > -1e-9
            lifted = step @ lifted
        before = flights.flow(state, walls, tau, t)
        if i >= 0:
            x, y, v, u = 2 * i + np.array([0, 1, 4, 5])
            assert abs(after[x] - after[y] - wall) < tolerance
            if kind == IMPACT:
                assert walls[i] == 0
                assert (before[v] - before[u]) * wall > -tolerance, "an impact from inside"
                kept = [after[v] - after[u], after[v] + epsilon * after[u]]
                expected = [kappa * (before[u] - before[v]), before[v] + epsilon * before[u]]
                np.testing.assert_allclose(kept, expected, rtol=0, atol=tolerance)
                before[[v, u]] = after[[v, u]]
            elif kind == STICK:
                assert after[v] == after[u]
                walls[i], before = int(wall), after
            else:
                assert walls[i] == wall
                assert t < 1e-9 or abs(pushes[i]) < 1e-11
                walls[i] = 0
        np.testing.assert_allclose(after, before, rtol=0, atol=tolerance)
        state, tau = after, event["tau"]


def test_balls_stay_between_the_walls_in_a_long_run_with_every_kind_of_event(chapter):
    system = chapter(0.5, 0.5)
    run = vi.simulate(system, START, 20_000, sample_times=np.linspace(0, 20_000 * system.period, 100_003))
    assert np.abs(run.samples[:, [0, 2]] - run.samples[:, [1, 3]]).max() <= 1 + 1e-13
    assert set(run.events["kind"]) == {IMPACT, STICK, RELEASE}
    assert (np.diff(run.events["tau"]) >= 0).all()


def test_runs_agree_with_dimensional_equations_integrated_by_scipy():
    """(10.1) in physical units, by DOP853 with events; results are scaled."""
    p = vi.PhysicalSystem(
        M=2.0, m=0.2, k1=50.0, k2=52.5, k12=5.0, c1=0.2, c2=0.25, c12=0.3, F10=0.4, F20=0.35, omega1=5.1, omega2=5.1,
        L=0.08, kappa=0.65,
    )  # fmt: skip
    scale, cycles, hits = np.repeat([p.L, p.L * p.omega10], 4), 6, []

    def rates(t, z):
        x1, _, x2, _, u1, v1, u2, v2 = z
        link = p.k12 * (x2 - x1) + p.c12 * (u2 - u1)
        a1 = (p.F10 * np.sin(p.omega1 * t) - p.c1 * u1 - p.k1 * x1 + link) / p.M
        a2 = (p.F20 * np.sin(p.omega2 * t) - p.c2 * u2 - p.k2 * x2 - link) / p.M
        return [u1, v1, u2, v2, a1, 0.0, a2, 0.0]

    def room(i):
        def event(t, z):
            return p.L - abs(z[2 * i] - z[2 * i + 1])

        event.terminal, event.direction = True, -1
        return event

    t, end, z = 0.0, cycles * 2 * np.pi / p.omega1, START * scale
    while t < end:
        flight = solve_ivp(
            rates, (t, end), z, method="DOP853", rtol=1e-12, atol=1e-14, max_step=0.02, events=[room(0), room(1)]
        )
        t, z = flight.t[-1], flight.y[:, -1]
        for i in (i for i in range(2) if len(flight.t_events[i])):
            u, v = z[4 + 2 * i], z[5 + 2 * i]
            common, apart = (p.M * u + p.m * v) / (p.M + p.m), p.kappa * (v - u) / (p.M + p.m)
            z[4 + 2 * i], z[5 + 2 * i] = common + p.m * apart, common - p.M * apart
            z[2 * i + 1] = z[2 * i] - np.sign(u - v) * p.L * (1 - 1e-13)
            hits.append(t * p.omega10)
    run = vi.simulate(p.dimensionless(), START, cycles)
    assert len(run.events) == len(hits) > 15
    np.testing.assert_allclose(run.events["tau"], hits, atol=1e-9)
    np.testing.assert_allclose(run.final, z / scale, atol=1e-8)


def test_mirror_symmetry(case):
    """The run from minus the state half a forcing period later is minus the run."""
    run = vi.simulate(case, START, 12)
    mirrored = vi.simulate(case, -START, 12, tau0=case.period / 2)
    np.testing.assert_allclose(mirrored.final, -run.final, atol=1e-11)
    np.testing.assert_array_equal(mirrored.events["wall"], -run.events["wall"])


RANGES = dict(
    epsilon=(0.005, 1), kappa=(0.05, 0.95), alpha12_hat=(0, 3), gamma1_hat=(0.01, 1), gamma2_hat=(0.01, 1),
    gamma12_hat=(0.01, 1), sigma20_hat=(-0.9, 2), sigma_e_hat=(-0.5, 2), f10_hat=(-2, 2), f20_hat=(-2, 2),
)  # fmt: skip
systems = st.builds(vi.System, **{name: st.floats(*ends) for name, ends in RANGES.items()})


@settings(max_examples=60)
@given(system=systems, start=st.tuples(*[st.floats(-0.9, 0.9)] * 8))
def test_random_systems_pass_the_audit(system, start):
    state = np.array(start)
    state[[1, 3]] = state[[0, 2]] - state[[1, 3]]  # |W| <= 0.9
    audit(vi.simulate(system, state, 8, tau0=0.3), tolerance=5e-12)
