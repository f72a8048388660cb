"""The model hierarchy from leading order to the exact orbit."""

import numpy as np
import pytest
from scipy.optimize import brentq, fsolve

import vibroimpact as vi
from vibroimpact.exact.orbits.impulse_response import HarmonicResponse
from vibroimpact.exact.orbits.search import half_period_multipliers, symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.studies.regimes import two_terms
from vibroimpact.studies.regimes.epsilon_limit import compare, first_order, order
from vibroimpact.studies.regimes.hierarchy import EXACT, LEADING, TWO_TERMS, error, levels
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C, SYMMETRY_BREAKING_SLOPE


@pytest.fixture(scope="module")
def chapter_system():
    hatted = {"alpha12_hat": 1.0, "gamma1_hat": 0.2, "gamma2_hat": 0.2, "gamma12_hat": 0.2}
    detuned = {"sigma20_hat": 0.5, "sigma_e_hat": 0.2}
    return vi.System(epsilon=0.1, kappa=0.65, **hatted, **detuned, f10_hat=1.0, f20_hat=1.0)


@pytest.fixture(scope="module")
def hierarchy(chapter_system):
    return levels(chapter_system, [1, 3])


def amplitudes(system, response=None):
    """C of all motions, ascending in C_1."""
    C = symmetric_solutions(system, response)[:, 2:]
    C = C[(C > 0).all(axis=1)]
    return C[np.argsort(C[:, 0])]


def test_many_harmonics_lead_to_the_exact_orbit(chapter_system):
    """With error 1/N; that of the force's harmonics to leading order by the tail 1/(pi Omega N) of the own motion."""
    system, exact = chapter_system, amplitudes(chapter_system)
    N = np.array([33, 65, 129])
    for free_mass in (False, True):
        errors = [np.abs(amplitudes(system, HarmonicResponse(system, n, free_mass)) - exact).max() for n in N]
        assert order(N + 1.0, errors)[0] == pytest.approx(-1, abs=0.02)
    for n in N:
        own = [HarmonicResponse(system, n, free_mass) for free_mass in (False, True)]
        x = [response.between(np.zeros((1, 2)), np.arange(2))[0][0, 0, 0] for response in own]
        assert x[0] - x[1] == pytest.approx(1 / (np.pi * system.Omega * (n + 1)), rel=1e-3)


def test_one_harmonic_is_the_describing_function(chapter_system):
    """A single module by hand: the box answers to the first harmonic of the force of a ball that flies freely."""
    system = chapter_system.with_(alpha12_hat=0.0, gamma12_hat=0.0, sigma20_hat=0.0, f10_hat=1.4, f20_hat=1.4)
    w, eps, kappa = system.Omega, system.epsilon, system.kappa
    receptance = 1 / (1 - w**2 + 1j * w * eps * system.gamma1_hat)

    def conditions(unknowns):
        C, theta = unknowns
        speed = 2 * C * w / (np.pi * (1 + eps))  # 2 C / (1 + eps) in half a period
        kick = -2 * eps * speed
        first = kick * 2 * w / np.pi  # amplitude of the first harmonic, in phase with the impact
        X = receptance * (eps * system.f10_hat * np.exp(1j * (theta - np.pi / 2)) + first)
        position, mean_velocity = X.real, (1j * w * X).real
        before = mean_velocity - kick / 2 + speed
        after = mean_velocity + kick / 2 - speed
        return position + C / (1 + eps) - 1, after + kappa * before

    C = amplitudes(system, HarmonicResponse(system, 1)).max()
    starts = [(1.2, theta) for theta in np.linspace(0, 2 * np.pi, 8, endpoint=False)]
    found = [
        solution for solution, _, flag, _ in (fsolve(conditions, s, full_output=True) for s in starts) if flag == 1
    ]
    assert min(abs(solution[0] - C) for solution in found) < 1e-8


def test_two_terms_are_right_to_second_order(chapter_system):
    point = vi.fixed_points(chapter_system)[-1]
    C = first_order(chapter_system, point, two_terms.STEP)
    epsilon = np.geomspace(1e-2, 1e-3, 3)
    found = [compare(chapter_system.with_(epsilon=e), point) for e in epsilon]
    assert order(epsilon, [np.linalg.norm(c.offset - c.epsilon * C) for c in found])[0] == pytest.approx(2, abs=0.03)


@pytest.mark.parametrize("kappa", [0.3, 0.9])
def test_how_symmetry_breaking_moves_with_epsilon(chapter_system, kappa):
    """The slope in closed form against exact orbits of an uncoupled module whose half-period multiplier is -1."""
    alone = chapter_system.with_(kappa=kappa, alpha12_hat=0.0, gamma12_hat=0.0, sigma20_hat=0.0)

    def place(epsilon):
        def orbit(f20):
            system = alone.with_(epsilon=epsilon, f20_hat=f20)
            return symmetric_orbit(system, max(symmetric_solutions(system), key=lambda root: root[2:].min()))

        f20 = brentq(lambda f: np.prod(1 + half_period_multipliers(orbit(f))).real, 1.5, 1.9, xtol=1e-12)
        return (orbit(f20).C[1] - SYMMETRY_BREAKING_C) / epsilon

    near = place(2e-3)
    assert 2 * near - place(4e-3) == pytest.approx(SYMMETRY_BREAKING_SLOPE, abs=1e-4)
    assert two_terms.symmetry_breaking(2e-3) == pytest.approx(SYMMETRY_BREAKING_C + 2e-3 * near, abs=2e-5)


def test_point_c_gets_its_right_verdict(chapter_system, hierarchy):
    """Stable by leading order, unstable by two terms and exactly; they say where it loses its stability."""
    verdicts = {name: hierarchy[name].verdicts for name in (LEADING, TWO_TERMS)}
    assert verdicts == {LEADING: ["unstable", "stable", "unstable"], TWO_TERMS: ["unstable"] * 3}
    assert hierarchy[EXACT].verdicts == ["unstable"] * 3
    point = vi.fixed_points(chapter_system)[1]
    slope = first_order(chapter_system, point, two_terms.STEP)[1]
    onset = (SYMMETRY_BREAKING_C - point.C[1]) / (slope - SYMMETRY_BREAKING_SLOPE)
    assert onset == pytest.approx(0.00218, abs=1e-5)


def test_every_level_is_nearer(hierarchy):
    errors = [error(level.C, hierarchy[EXACT].C) for level in hierarchy.values()]
    assert errors == sorted(errors, reverse=True)
    assert errors[0] > 0.05
    assert errors[1] < 0.005
    assert np.isnan(error(hierarchy[EXACT].C[1:], hierarchy[EXACT].C))


def test_the_fold_to_the_next_order(chapter_system):
    found = two_terms.fold(chapter_system, "f20_hat", (0.6, 0.89))
    leading, two = (abs(found[name] - found["exact"]) for name in ("leading order", "two terms"))
    assert (leading, two) == (pytest.approx(0.0345, abs=1e-4), pytest.approx(0.0014, abs=1e-4))
    assert np.isnan(two_terms.fold(chapter_system, "f20_hat", (0.8, 0.89))["exact"])
