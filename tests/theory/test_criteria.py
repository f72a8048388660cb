"""Verdicts of the theory's criteria on fixed points and orbits."""

from types import SimpleNamespace

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from amplitude_rates import jacobian
from chapter import FORCES, PARAMETERS
from vibroimpact.exact.orbits.search import orbits
from vibroimpact.theory import criteria as verdicts
from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.slow_flow import rates

PRINTED, FOLD, BREAKING = 3.3 / 3.65, 1 / (1 + (14 / (33 * np.pi)) ** 2), np.pi**2 / (np.pi**2 - 4)


def case(name):
    return vi.System(**PARAMETERS, f10_hat=FORCES[name][0], f20_hat=FORCES[name][1])


def true_fixed_point(system, point):
    """C and psi, each (2,), of a fixed point with 30 digits: (10.23) as two complex equations, written out."""
    with mp.workdps(30):
        s = {name: mp.mpf(str(value)) for name, value in vars(system).items()}
        r = 2 * (1 - s["kappa"]) / (mp.pi * (1 + s["kappa"]))
        coupling = s["alpha12_hat"] + 1j * s["gamma12_hat"]
        tuning = 2 * s["sigma_e_hat"] - s["alpha12_hat"], 2 * s["sigma_e_hat"] - s["alpha12_hat"] - s["sigma20_hat"]
        damping = s["gamma1_hat"] + s["gamma12_hat"], s["gamma2_hat"] + s["gamma12_hat"]
        force = s["f10_hat"], s["f20_hat"]

        def residual(C1, psi1, C2, psi2):
            C = C1, C2
            B = [mp.sqrt(1 - 2 * c + (1 + r**2) * c**2) for c in C]
            b = [B[0] * mp.exp(-1j * psi1), B[1] * mp.exp(-1j * psi2)]
            found = []
            for i in range(2):
                impacts = 8 / mp.pi**2 * C[i] * ((1 - C[i]) + 1j * r * C[i]) / B[i] ** 2
                value = (tuning[i] - 1j * damping[i] - impacts) * b[i] + coupling * b[1 - i] + force[i]
                found += [value.real, value.imag]
            return found

        C1, psi1, C2, psi2 = mp.findroot(residual, np.column_stack([point.C, point.psi]).ravel().tolist())
        return (C1, C2), (psi1, psi2)


@pytest.mark.parametrize(
    ("C", "printed", "derived"),
    [
        ((1.2, 1.3), "stable", "stable"),
        ((1.2, 1.7), "stable", "unstable"),
        ((0.93, 1.2), "stable", "unstable"),
        ((0.5, 1.2), "unstable", "unstable"),
        ((1.2, PRINTED), "undecided", "unstable"),
        ((1.2, FOLD), "stable", "undecided"),
        ((BREAKING, 0.3), "unstable", "unstable"),
    ],
)
def test_both_modules_must_satisfy_the_limits(C, printed, derived):
    for amplitudes in (C, C[::-1]):
        motion = SimpleNamespace(
            system=case("equal"), impact_phases=np.full((2, 2), [0, 0.5]), C=np.array(amplitudes),
            multipliers=np.zeros(8), residual=0.0,
        )  # fmt: skip
        found = verdicts.of_orbit(motion)
        assert (found["printed_10_26"], found["fast"]) == (printed, derived)


@pytest.mark.parametrize("name", FORCES)
def test_slow_flow_is_the_sign_of_the_jacobian_s_eigenvalues(name):
    system = case(name)
    for point in vi.fixed_points(system):
        growth = np.linalg.eigvals(jacobian(system, point.psi, point.C)).real.max()
        says = verdicts.of_fixed_point(system, point)
        assert says["slow"] == ("stable" if growth < 0 else "unstable")
        assert verdicts.fixed_point_error(system, point) < 1e-11
        expected = "stable" if growth < 0 and min(point.C) > FOLD and max(point.C) < BREAKING else "unstable"
        assert point.stability.theory == says["theory"] == expected


@settings(max_examples=30)
@given(st.sampled_from(list(FORCES)), st.integers(0, 2), st.integers(0, 2**32 - 1))
def test_eigenvalues_stay_within_their_error(name, k, seed):
    """psi and C shifted at random by at most the error."""
    system = case(name)
    listed = vi.fixed_points(system)
    point, error = listed[k % len(listed)], 1e-7
    shift = np.random.default_rng(seed).uniform(-error, error, (2, 2))
    for C in (point.C, np.array([FOLD + 3e-4, 1.2])):  # next to the fold the slope of the manifold is what is uncertain
        values, errors = verdicts._eigenvalues(system, point.psi, C, error)
        shifted = np.linalg.eigvals(jacobian(system, point.psi + shift[0], C + shift[1]))
        for value, bound in zip(values, errors, strict=True):
            assert np.abs(shifted - value).min() <= 1.001 * bound


def test_error_of_a_fixed_point_covers_its_distance_from_the_exact_one():
    """A point moved off by hand: the estimate finds how far."""
    system = case("equal")
    point = vi.fixed_points(system)[1]
    away = {"C": point.C + np.array([3e-8, 0]), "psi": point.psi - np.array([0, 2e-8])}
    moved = type(point)(**{**vars(point), **away})
    assert 3e-8 <= 1.01 * verdicts.fixed_point_error(system, moved) < 3e-7


def test_error_of_a_fixed_point_covers_the_rounding_that_its_residual_does_not_show():
    """Against the same point with 40 digits, over random forces."""
    random, beyond_the_step = np.random.default_rng(5), 0
    for f10, f20 in random.uniform(0.3, 1.5, (12, 2)):
        system = vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20)
        for point in vi.fixed_points(system):
            C, psi = true_fixed_point(system, point)
            turns = 2 * np.pi * np.round((np.array(psi, float) - point.psi) / (2 * np.pi))
            away = [abs(float(c - x)) for c, x in zip(C, point.C, strict=True)]
            away += [abs(float(p - t - x)) for p, t, x in zip(psi, turns, point.psi, strict=True)]
            assert max(away) <= verdicts.fixed_point_error(system, point)
            residual, J = verdicts.equations(system, point.psi, point.C)
            beyond_the_step += max(away) > np.abs(np.linalg.inv(J) @ residual).max()
    assert beyond_the_step  # where Newton's step alone would be too small


def test_nothing_is_decided_where_fixed_points_coincide():
    system = case("equal")
    point = vi.fixed_points(system)[0]
    double = type(point)(**{**vars(point), "multiple": True})
    assert set(verdicts.of_fixed_point(system, double).values()) == {"undecided"}


def test_close_to_a_fold_the_slow_flow_is_undecided_and_beyond_not():
    """Two fixed points merge as f20 falls; where they last exist, an eigenvalue vanishes to within its error."""
    low, high = 0.65, 0.75
    base = case("equal")
    while low < (middle := (low + high) / 2) < high:
        low, high = (low, middle) if len(vi.fixed_points(base.with_(f20_hat=middle))) == 3 else (middle, high)
    near = base.with_(f20_hat=high)
    assert "undecided" in [verdicts.of_fixed_point(near, point)["slow"] for point in vi.fixed_points(near)]
    clear = base.with_(f20_hat=high + 1e-4)
    assert "undecided" not in [verdicts.of_fixed_point(clear, point)["slow"] for point in vi.fixed_points(clear)]


def test_psi_of_an_orbit_solves_the_slow_flow_to_leading_order():
    """The rates of (10.22) at the orbit's phases are O(epsilon)."""
    rest = []
    for epsilon in (2e-4, 1e-4):
        system = case("equal").with_(epsilon=epsilon)
        orbit = min((o for o in orbits(system) if o.symmetric), key=lambda o: np.abs(o.C - [1.191, 1.119]).max())
        psi, C = verdicts.slow_variables(orbit)
        rest.append(np.abs(np.concatenate(rates(system, B_of_C(C, rho(0.65)), psi, C))).max())
    assert rest[1] < 1e-3
    assert rest[0] / rest[1] == pytest.approx(2, rel=0.02)
