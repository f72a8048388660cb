"""Multipliers against an event-driven map in 40 digits, Liouville's formula and known limits."""

import mpmath as mp
import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.exact.orbits.floquet import contraction, follow, multipliers
from vibroimpact.exact.orbits.search import half_period_multipliers, orbits, search
from vibroimpact.exact.orbits.symmetric import symmetric_solutions

DIGITS = 40
STEP = "1e-14"


class PreciseMap:
    """Free flights by eigenvectors and impacts by Newton's method, in DIGITS digits, written from (10.2)."""

    def __init__(self, system):
        e = mp.mpf(system.epsilon)
        k, c = e * mp.mpf(system.alpha12_hat), e * mp.mpf(system.gamma12_hat)
        c1, c2 = e * mp.mpf(system.gamma1_hat), e * mp.mpf(system.gamma2_hat)
        f1, f2 = e * mp.mpf(system.f10_hat), e * mp.mpf(system.f20_hat)
        w = 1 + e * mp.mpf(system.sigma_e_hat)
        rate = mp.matrix(
            [
                [0, 0, 1, 0, 0, 0],
                [0, 0, 0, 1, 0, 0],
                [-1 - k, k, -c1 - c, c, f1, 0],
                [k, -1 - e * mp.mpf(system.sigma20_hat) - k, c, -c2 - c, f2, 0],
                [0, 0, 0, 0, 0, w],
                [0, 0, 0, 0, -w, 0],
            ]
        )
        self.values, self.vectors = mp.eig(rate)
        self.inverse = mp.inverse(self.vectors)
        self.epsilon, self.kappa, self.omega, self.period = e, mp.mpf(system.kappa), w, 2 * mp.pi / w

    def flight(self, state, tau, t):
        phase = self.omega * tau
        lifted = mp.matrix([*state[0::2], mp.sin(phase), mp.cos(phase)])
        modes = self.inverse * lifted
        moved = self.vectors * mp.matrix([z * mp.exp(v * t) for z, v in zip(modes, self.values, strict=True)])
        boxes = [mp.re(moved[k]) for k in range(4)]
        balls = [state[1] + t * state[5], state[3] + t * state[7], state[5], state[7]]
        return [z for pair in zip(boxes, balls, strict=True) for z in pair]

    def impact(self, state, tau, module, wall, guess):
        """State and time just after the impact next to the time `guess`."""
        x, y, dx, dy = 2 * module - 2, 2 * module - 1, 2 * module + 2, 2 * module + 3
        t = mp.mpf(guess) - tau
        for _ in range(6):
            met = self.flight(state, tau, t)
            t -= (met[x] - met[y] - wall) / (met[dx] - met[dy])
        met = self.flight(state, tau, t)
        assert abs(met[x] - met[y] - wall) < mp.mpf(10) ** (5 - DIGITS)
        change = (1 + self.kappa) / (1 + self.epsilon) * (met[dx] - met[dy])
        met[dx], met[dy] = met[dx] - self.epsilon * change, met[dy] + change
        return met, tau + t

    def __call__(self, state, impacts, end):
        tau = mp.mpf(0)
        for time, module, wall in impacts:
            state, tau = self.impact(state, tau, module, wall, time)
        return self.flight(state, tau, end - tau)

    def jacobian(self, state, impacts, end):
        step = mp.mpf(STEP)
        columns = []
        for k in range(8):
            ends = []
            for side in (1, -1):
                moved = [mp.mpf(float(z)) for z in state]
                moved[k] += side * step
                ends.append(self(moved, impacts, end))
            columns.append([(a - b) / (2 * step) for a, b in zip(*ends, strict=True)])
        return mp.matrix(columns).T


def impacts_of(orbit):
    times = orbit.impact_phases * orbit.system.period
    return sorted((float(times[i, k]), i + 1, (1, -1)[k]) for i in range(2) for k in range(2))


def distinct_kinds(case):
    """One symmetric orbit and, if there is one, one asymmetric orbit: the least unstable of each."""
    listed = [o for o in orbits(case) if o.admissible]
    chosen = []
    for kind in (True, False):
        same = [o for o in listed if o.symmetric is kind]
        chosen += [min(same, key=lambda o: abs(o.multipliers[0]))] if same else []
    return chosen


def test_monodromy_matrix_and_multipliers_in_extended_precision(case):
    with mp.workdps(DIGITS):
        reference = PreciseMap(case)
        for orbit in distinct_kinds(case):
            impacts = impacts_of(orbit)
            expected = reference.jacobian(orbit.state, impacts, reference.period)
            times, modules, _ = zip(*impacts, strict=True)
            jacobian = follow(case, orbit.state, np.array(times), np.array(modules), case.period).jacobian
            error = max(abs(expected[i, k] - jacobian[i, k]) for i in range(8) for k in range(8))
            assert error < 1e-9
            values = mp.eig(expected, left=False, right=False)
            for value in values:
                assert min(abs(value - mu) for mu in orbit.multipliers) < 1e-9
            for mu in orbit.multipliers:
                assert min(abs(value - mu) for value in values) < 1e-9


@pytest.mark.parametrize("module", [1, 2])
@pytest.mark.parametrize("wall", [1, -1])
def test_one_impact_in_extended_precision(chapter, module, wall):
    """A flight, one impact (with damped coupling, in the middle of the forcing cycle), a flight."""
    system = chapter(gamma12_hat=0.7)
    state = np.array([0.2, 0.1, -0.3, -0.2, 0.5, 0.1, -0.4, 0.2])
    state[2 * module + 3] = -wall * 1.9
    with mp.workdps(DIGITS):
        reference = PreciseMap(system)
        exact = [mp.mpf(float(z)) for z in state]
        _, tau = reference.impact(exact, mp.mpf(0), module, wall, 0.5)
        expected = reference.jacobian(state, [(tau, module, wall)], reference.period)
        jacobian = follow(system, state, np.array([float(tau)]), np.array([module]), system.period).jacobian
        assert max(abs(expected[i, k] - jacobian[i, k]) for i in range(8) for k in range(8)) < 1e-12


@pytest.mark.parametrize("changes", [{}, {"kappa": 0.3}, {"gamma12_hat": 2.0}, {"epsilon": 0.7, "gamma1_hat": 0.0}])
def test_liouville(chapter, changes):
    """The logarithm of |det| against the integrated divergence and four impacts, each with two factors kappa."""
    system = chapter(**changes)
    damping = system.gamma1 + system.gamma2 + 2 * system.gamma12
    expected = np.exp(-damping * system.period) * system.kappa**8
    found = orbits(system)
    assert found
    for orbit in found:
        scale = np.prod(np.maximum(abs(orbit.multipliers), 1))
        assert np.prod(orbit.multipliers) == pytest.approx(expected, rel=1e-11 * scale / expected)
    assert contraction(system, 4) == pytest.approx(expected, rel=1e-14)


def test_uncoupled_modules_have_multipliers_of_their_own(chapter):
    """Without coupling the multipliers of one module do not notice the other: exchange partners and compare."""
    alone = {"alpha12_hat": 0, "gamma12_hat": 0}
    first, second, crossed = (
        max(orbits(chapter(*f, **alone)), key=lambda o: o.ball_speeds.min()).multipliers
        for f in [(1, 1), (0.8, 0.9), (1, 0.9)]
    )
    pool = np.concatenate([first, second])
    for mu in crossed:
        assert abs(pool - mu).min() < 1e-10
    twins = max(orbits(chapter(1, 1, **alone, sigma20_hat=0)), key=lambda o: o.ball_speeds.min()).multipliers
    for mu in twins:
        assert np.sort(abs(twins - mu))[1] < 1e-7  # every multiplier twice, up to the root of rounding


def test_a_multiplier_is_one_at_a_fold(chapter):
    """Four symmetric solutions become two as the forcing falls: those that meet share a multiplier +1."""

    def solutions(f):
        return symmetric_solutions(chapter(f, f))

    low, high = 0.5, 1.0
    assert (len(solutions(low)), len(solutions(high))) == (2, 4)
    while high - low > 1e-12:
        middle = (low + high) / 2
        low, high = (low, middle) if len(solutions(middle)) == 4 else (middle, high)
    found = [orbit for orbit in orbits(chapter(high, high)) if orbit.symmetric]
    gaps = {(a, b): abs(found[a].state - found[b].state).max() for a in range(4) for b in range(a)}
    meeting = min(gaps, key=gaps.get)
    assert gaps[meeting] < 1e-4
    for k in meeting:
        assert abs(half_period_multipliers(found[k]) - 1).min() < 1e-3


def test_symmetry_breaks_where_a_half_period_multiplier_is_minus_one(chapter):
    """A pair of asymmetric orbits leaves the symmetric one there, as the root of the distance in the parameter."""

    def lowest(f):
        symmetric = [o for o in search(chapter(f, f), starts=1).orbits if o.symmetric and o.admissible]
        return half_period_multipliers(max(symmetric, key=lambda o: o.C[0])).real.min()

    def inequality(f):
        """Distance of the flight fractions from one half, for the most nearly symmetric asymmetric pair."""
        found = [o for o in orbits(chapter(f, f)) if not o.symmetric and o.admissible]
        fractions = [np.mod(o.impact_phases[:, 1] - o.impact_phases[:, 0], 1) for o in found]
        return min(abs(u - 0.5).max() for u in fractions)

    low, high = 1.2, 1.25
    assert lowest(low) > -1 > lowest(high)
    for _ in range(25):
        middle = (low + high) / 2
        low, high = (middle, high) if lowest(middle) > -1 else (low, middle)
    near, far = inequality(low - 1e-5), inequality(low - 4e-5)
    assert near < 0.01
    assert far / near == pytest.approx(2, rel=0.01)


def test_half_period_multipliers_square_to_the_multipliers(case):
    for orbit in orbits(case):
        if orbit.symmetric:
            squares = half_period_multipliers(orbit) ** 2
            for mu in orbit.multipliers:
                assert abs(squares - mu).min() < 1e-9 * max(1.0, abs(mu))
        else:
            with pytest.raises(ValueError, match="not symmetric"):
                half_period_multipliers(orbit)


def test_order_of_multipliers():
    matrix = np.diag([0.1, -3.0, 1.0, 0.5, 0.2, 0.3, 0.0, 0.0])
    matrix[6:, 6:] = [[0.0, -2.0], [2.0, 0.0]]
    np.testing.assert_allclose(multipliers(matrix), [-3, 2j, -2j, 1, 0.5, 0.3, 0.2, 0.1], atol=1e-15)


def test_perturbed_motion_is_carried_by_the_monodromy_matrix(case):
    """The event-driven engine moves a small perturbation as the matrix says."""
    orbit = distinct_kinds(case)[0]
    times, modules, _ = zip(*impacts_of(orbit), strict=True)
    jacobian = follow(case, orbit.state, np.array(times), np.array(modules), case.period).jacobian
    push = 1e-6 * np.random.default_rng(1).normal(size=8)
    ends = [vi.simulate(case, orbit.state + side * push, 1).final for side in (1, -1)]
    np.testing.assert_allclose((ends[0] - ends[1]) / 2, jacobian @ push, rtol=0, atol=1e-11 * abs(jacobian).max())
