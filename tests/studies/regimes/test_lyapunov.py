"""Lyapunov exponents, their sum and their errors agree with linear systems, stable orbits and neighbouring motions."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.studies.regimes import lyapunov, spectra
from vibroimpact.studies.regimes.lyapunov import Spectrum, contraction, kaplan_yorke
from vibroimpact.system.state import RELEASE, STICK

BEFORE = [-0.144663794484, -0.352074667389, -0.177170751185, -0.527844451091]
BEFORE += [-0.047789502435, -0.680079806625, 0.019940921831, -0.827355527541]
DOUBLE = 20
"""BEFORE is a state of the strongly modulated response; in cycle DOUBLE after it, both balls stick at once."""


def stable_orbit(system):
    return next(orbit for orbit in vi.orbits(system) if orbit.admissible and abs(orbit.multipliers[0]) < 1)


@pytest.mark.parametrize(("f10", "f20"), [(1.0, 1.0), (1.0, 1.2), (1.3, 1.25)])
def test_the_largest_exponent_of_a_stable_orbit_is_the_log_of_its_largest_multiplier(chapter, f10, f20):
    system = chapter(f10, f20)
    orbit = stable_orbit(system)
    blocks, cycles = 400, 10
    found = vi.largest_lyapunov(system, orbit.state, blocks * cycles, 0, blocks).mean
    # A complex pair rotates the perturbation, so that its length oscillates by a bounded factor.
    assert found == pytest.approx(np.log(abs(orbit.multipliers[0])), abs=3 / (blocks * cycles))


def test_neighbouring_chaotic_motions_separate_at_the_rate_of_the_jacobian(chapter):
    """Two simulated motions are set to a distance of 1e-8 before each cycle; no derivatives are used."""
    system = chapter(0.5, 0.5)
    state = vi.simulate(system, [0, 0, 0, 0, 0, 0.5, 0, 0.4], 300).final
    discarded, cycles = 10, 400
    expected = vi.largest_lyapunov(system, state, cycles, 0, cycles, discarded).mean
    direction, growth = np.full(8, 8**-0.5), []
    for _ in range(discarded + cycles):
        step = 1e-8 * direction
        for i in (0, 2):  # the neighbour must not start beyond a wall
            step = -step if abs(state[i] + step[i] - state[i + 1] - step[i + 1]) > 1 else step
        after, other = vi.simulate(system, state, 1).final, vi.simulate(system, state + step, 1).final
        difference = other - after
        growth.append(np.log(np.linalg.norm(difference) / 1e-8))
        direction, state = difference / np.linalg.norm(difference), after
    assert np.mean(growth[discarded:]) == pytest.approx(expected, abs=0.03)
    assert expected > 0.5


def test_the_error_is_the_scatter_over_starts(chapter):
    """Exponents from twelve starts scatter by about the error of each exponent."""
    system = chapter(0.5, 0.5)
    found = [vi.largest_lyapunov(system, [0, 0, 0, 0, 0, 0.5, 0, 0.3 + 0.01 * k], 200, 300) for k in range(12)]
    scatter = np.std([exponent.mean for exponent in found], ddof=1)
    error = np.mean([exponent.error for exponent in found])
    assert 0.5 < scatter / error < 2.0


@pytest.fixture(scope="module")
def spectrum_and_runs(chapter):
    """Return the spectrum of the strongly modulated response, simulated cycle by cycle, and the run of each cycle."""
    system = chapter(0.5, 0.5)
    state = vi.simulate(system, [0, 0, 0, 0, 0, 0.5, 0, 0.4], 300).final
    with pytest.MonkeyPatch.context() as patch:  # runs of many cycles round differently and soon differ
        patch.setattr(lyapunov, "CYCLES_PER_RUN", 1)
        found, runs = vi.lyapunov_spectrum(system, state, 600, 0, 0), []
    for _ in range(600):
        runs.append(vi.simulate(system, state, 1))
        state = runs[-1].final
    return found, runs


def test_volumes_shrink_by_the_closed_form_of_damping_and_impacts(spectrum_and_runs):
    """The tolerance is the rounding error of a Jacobian: ten times the machine epsilon times its condition number."""
    found, runs = spectrum_and_runs
    free = np.isfinite(found.contraction)
    condition = np.array([np.linalg.cond(run.jacobian) for run in runs])
    off = np.abs(found.growth[free].sum(axis=1) - found.contraction[free])
    assert (off < 10 * np.finfo(float).eps * condition[free]).all()
    assert np.median(off) < 1e-13
    determinants = [np.linalg.slogdet(run.jacobian)[1] for run in np.array(runs, dtype=object)[free]]
    np.testing.assert_allclose(determinants, found.contraction[free], rtol=0, atol=1e-6)


def test_a_ball_that_sticks_removes_two_dimensions(spectrum_and_runs):
    found, runs = spectrum_and_runs
    stuck = [k for k, run in enumerate(runs) if (run.events["kind"] == STICK).any()]
    assert stuck
    assert np.isneginf(found.contraction[stuck]).all()
    for k in stuck:
        values = np.linalg.svd(runs[k].jacobian, compute_uv=False)
        lost = np.isneginf(found.growth[k]).sum()
        assert lost in (2, 4)
        assert values[-lost] < 1e-13 * values[0]
    assert np.isneginf(found.exponents).sum() >= 2
    assert np.isnan(found.errors(10)[0]).sum() == np.isneginf(found.exponents).sum()


def test_spectra_do_not_depend_on_the_number_of_cycles_per_run(chapter, monkeypatch):
    """In some of the 30 cycles, a run ends during a flight or while a ball sticks."""
    system, found = chapter(0.5, 0.5), []
    for at_once in (1, 7, 1000):
        monkeypatch.setattr(lyapunov, "CYCLES_PER_RUN", at_once)
        found.append(vi.lyapunov_spectrum(system, BEFORE, 30, 0, 0))
    for other in found[1:]:
        assert (other.stuck == found[0].stuck).all()
        np.testing.assert_allclose(other.contraction, found[0].contraction, rtol=1e-14)
        np.testing.assert_allclose(other.growth[:DOUBLE], found[0].growth[:DOUBLE], rtol=0, atol=1e-4)
        np.testing.assert_allclose(other.growth[DOUBLE:, :4], found[0].growth[DOUBLE:, :4], rtol=0, atol=1e-4)


def test_both_balls_sticking_at_once_leave_four_dimensions(chapter):
    """The rank is that of the Jacobian, and that of difference quotients of neighbouring runs."""
    system, h = chapter(0.5, 0.5), 1e-6
    start = vi.simulate(system, BEFORE, DOUBLE).final
    run = vi.simulate(system, start, 1)
    kept = run.events[np.isin(run.events["kind"], (STICK, RELEASE))]
    assert kept["kind"].tolist()[:3] == [STICK, STICK, RELEASE]
    ahead, behind = ([vi.simulate(system, start + step, 1).final for step in s * h * np.eye(8)] for s in (1, -1))
    for matrix, lost in ((run.jacobian, 1e-13), (np.subtract(ahead, behind) / (2 * h), 1e-3)):
        values = np.linalg.svd(matrix, compute_uv=False)
        assert values[3] > 0.5
        assert values[4] < lost
    found = vi.lyapunov_spectrum(system, start, 1, 0, 0)
    assert found.double_sticks == 1
    assert np.isneginf(found.growth).sum() == 4


def test_the_dimension_without_double_sticks_is_that_of_a_run_that_has_none(chapter, monkeypatch):
    """The reference is the same motion from the cycle after the double stick on, with new perturbation vectors."""
    monkeypatch.setattr(lyapunov, "CYCLES_PER_RUN", 1)
    system, cycles = chapter(0.5, 0.5), 800
    found = vi.lyapunov_spectrum(system, BEFORE, cycles, 0, 0)
    assert found.double_sticks == 1
    assert found.dimension == 4
    assert np.isneginf(found.exponents).sum() == 4
    state = BEFORE
    for _ in range(DOUBLE + 1):
        state = vi.simulate(system, state, 1).final
    expected = vi.lyapunov_spectrum(system, state, cycles - DOUBLE - 1, 0, 0)
    assert expected.double_sticks == 0
    conditioned = found.without_double_sticks()
    assert len(conditioned.growth) == cycles - 1
    # the runs differ by 20 cycles, and by transients of the perturbation vectors
    np.testing.assert_allclose(conditioned.exponents[:6], expected.exponents[:6], atol=0.03)
    assert conditioned.dimension == pytest.approx(expected.dimension, abs=0.03)
    assert expected.dimension > 5.4


def test_a_table_of_spectra_counts_double_sticks_and_excludes_them_from_the_dimension(chapter):
    system, cycles = chapter(0.5, 0.5), 500
    behind = vi.simulate(system, BEFORE, DOUBLE + 1).final
    found = [spectra.spectra_of(system, [state], cycles, 1) for state in (BEFORE, behind)]
    with_one, without = ({row["quantity"]: row for row in spectra.rows({}, part)} for part in found)
    for rows, met in ((with_one, 1), (without, 0)):
        assert rows[spectra.DOUBLE]["mean"] == pytest.approx(1e6 * met / cycles)
        assert rows[spectra.DOUBLE]["uncertainty"] == pytest.approx(1e6 / cycles)
    dimension = without[spectra.DIMENSION]
    assert with_one[spectra.DIMENSION]["mean"] == pytest.approx(dimension["mean"], abs=4 * dimension["bootstrap"])
    assert with_one["exponent 6"]["mean"] == pytest.approx(without["exponent 6"]["mean"], abs=0.2)


@pytest.mark.thorough
def test_both_balls_stick_at_once_about_five_times_in_a_million_cycles(chapter):
    """The expected 4.9 in a million cycles were counted in the events of twenty million cycles from another start."""
    system, cycles, met = chapter(0.5, 0.5), 5_000_000, 0
    state = vi.simulate(system, [0, 0, 0, 0, 0, 0.5, 0, 0.3], 300).final
    for _ in range(cycles // 100_000):
        run = vi.simulate(system, state, 100_000)
        holds, state = [False, False], run.final
        for event in run.events[np.isin(run.events["kind"], (STICK, RELEASE))]:
            holds[event["module"] - 1] = event["kind"] == STICK
            met += all(holds)
    assert met == pytest.approx(4.9e-6 * cycles, abs=5 * np.sqrt(4.9e-6 * cycles))


def test_exponents_without_impacts_are_real_parts_of_eigenvalues(chapter):
    """The eigenvalues are those of the damped boxes. Perturbations of drifting balls grow linearly: exponent 0."""
    system, cycles = chapter(0.02, 0.02), 400
    found = vi.lyapunov_spectrum(system, np.zeros(8), cycles, 0).exponents
    e, a = system.epsilon, system.epsilon * system.alpha12_hat
    damping = e * np.array([[0.2 + 0.2, -0.2], [-0.2, 0.2 + 0.2]])
    stiffness = np.array([[1 + a, -a], [-a, 1 + e * system.sigma20_hat + a]])
    rate = np.block([[np.zeros((2, 2)), np.eye(2)], [-stiffness, -damping]])
    growth = np.sort(np.linalg.eigvals(rate).real)[::-1] * system.period
    np.testing.assert_allclose(found[4:], growth, atol=3 / cycles)
    np.testing.assert_allclose(found[:4], 0, atol=np.log(system.period * 500) / cycles)
    assert found.sum() == pytest.approx(-np.trace(damping) * system.period, abs=1e-12)


def test_exponents_of_a_stable_orbit_are_the_logs_of_its_multipliers(chapter):
    system = chapter(1.0, 1.0)
    orbit, cycles = stable_orbit(system), 300
    found = vi.lyapunov_spectrum(system, orbit.state, cycles, 0)
    expected = np.sort(np.log(np.abs(orbit.multipliers)))[::-1]
    np.testing.assert_allclose(found.exponents, expected, atol=3 / cycles)
    assert found.exponents.sum() == pytest.approx(expected.sum(), abs=1e-8)
    assert found.dimension == 0
    assert contraction(system, 4, 0) == pytest.approx(expected.sum(), abs=1e-8)


@pytest.mark.parametrize(
    ("exponents", "dimension"),
    [
        ([0.419, -1.623], 1 + 0.419 / 1.623),  # Hénon's map
        ([0.906, 0.0, -14.572], 2 + 0.906 / 14.572),  # the Lorenz system
        ([-0.1, -0.2], 0),
        ([0.3, -np.inf], 1),
        ([0.3, -0.1], 2),
    ],
)
def test_the_kaplan_yorke_dimensions_of_known_spectra(exponents, dimension):
    assert kaplan_yorke(exponents) == pytest.approx(dimension)


def test_bootstrap_errors_include_the_correlation_between_cycles():
    """Growth is an autoregressive process. The closed-form error of its mean is three times that of white noise."""
    cycles, memory = 20_000, 0.8
    noise = np.random.default_rng(5).normal(size=(cycles, 8))
    growth = np.zeros_like(noise)
    for n in range(1, cycles):
        growth[n] = memory * growth[n - 1] + noise[n]
    centres = np.array([4.0, 1.0, 0.0, -1.0, -2.0, -6.0, -7.0, -8.0])
    errors, of_dimension = Spectrum(growth + centres, np.zeros(cycles), np.zeros(cycles)).errors(100)
    expected = 1 / (1 - memory) / np.sqrt(cycles)
    np.testing.assert_allclose(errors, expected, rtol=0.2)
    # D = 5 + (lambda_1 + ... + lambda_5) / 6 = 5 + 1/3; lambda_6 = -6 contributes 1/3 of its error, over 6.
    assert of_dimension == pytest.approx(expected * np.sqrt(5 + 1 / 9) / 6, rel=0.2)
