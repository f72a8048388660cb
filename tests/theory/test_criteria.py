"""Verdicts of the theory on fixed points and orbits, and the errors that leave verdicts undecided."""

from dataclasses import replace
from types import SimpleNamespace

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from amplitude_rates import jacobian
from chapter import FORCES, system_of
from vibroimpact.exact.orbits.search import orbits
from vibroimpact.theory import criteria
from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.slow_flow import rates

PRINTED, FOLD, BREAKING = 3.3 / 3.65, 1 / (1 + (14 / (33 * np.pi)) ** 2), np.pi**2 / (np.pi**2 - 4)


def true_fixed_point(system, point):
    """Return C and psi, each (2,), of a fixed point in 30 digits, by (10.23) written as two complex equations."""
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
            system=system_of("equal"), impact_phases=np.full((2, 2), [0, 0.5]), C=np.array(amplitudes),
            multipliers=np.zeros(8), residual=0.0,
        )  # fmt: skip
        found = criteria.of_orbit(motion)
        assert (found["printed_10_26"], found["fast"]) == (printed, derived)


@pytest.mark.parametrize("name", FORCES)
def test_the_verdict_of_the_slow_flow_is_the_sign_of_the_jacobian_s_eigenvalues(name):
    system = system_of(name)
    for point in vi.fixed_points(system):
        growth = np.linalg.eigvals(jacobian(system, point.psi, point.C)).real.max()
        verdicts = criteria.of_fixed_point(system, point)
        assert verdicts["slow"] == ("stable" if growth < 0 else "unstable")
        assert criteria.fixed_point_error(system, point) < 1e-11
        expected = "stable" if growth < 0 and min(point.C) > FOLD and max(point.C) < BREAKING else "unstable"
        assert point.stability.theory == verdicts["theory"] == expected


@settings(max_examples=30)
@given(st.sampled_from(list(FORCES)), st.integers(0, 2), st.integers(0, 2**32 - 1))
def test_eigenvalues_stay_within_their_error_if_the_point_does(name, k, seed):
    """psi and C are shifted at random by at most the error of the point."""
    system = system_of(name)
    listed = vi.fixed_points(system)
    point, error = listed[k % len(listed)], 1e-7
    shift = np.random.default_rng(seed).uniform(-error, error, (2, 2))
    for C in (point.C, np.array([FOLD + 3e-4, 1.2])):  # next to the fold the slope of the manifold is uncertain
        values, errors = criteria._eigenvalues(system, point.psi, C, error)
        shifted = np.linalg.eigvals(jacobian(system, point.psi + shift[0], C + shift[1]))
        for value, bound in zip(values, errors, strict=True):
            assert np.abs(shifted - value).min() <= 1.001 * bound


def test_the_error_of_a_displaced_fixed_point_covers_the_displacement():
    system = system_of("equal")
    point = vi.fixed_points(system)[1]
    moved = replace(point, C=point.C + np.array([3e-8, 0]), psi=point.psi - np.array([0, 2e-8]))
    assert 3e-8 <= 1.01 * criteria.fixed_point_error(system, moved) < 3e-7


def test_the_error_of_a_fixed_point_covers_rounding_errors():
    """For random forces, compared with 30 digits; the Newton step alone would be too small an estimate."""
    random, beyond_the_step = np.random.default_rng(5), 0
    for f10, f20 in random.uniform(0.3, 1.5, (12, 2)):
        system = system_of("equal", f10_hat=f10, f20_hat=f20)
        for point in vi.fixed_points(system):
            C, psi = true_fixed_point(system, point)
            turns = 2 * np.pi * np.round((np.array(psi, float) - point.psi) / (2 * np.pi))
            error = np.abs(np.array([C - point.C, psi - turns - point.psi], dtype=float)).max()
            assert error <= criteria.fixed_point_error(system, point)
            residual, J = criteria.equations(system, point.psi, point.C)
            beyond_the_step += error > np.abs(np.linalg.inv(J) @ residual).max()
    assert beyond_the_step


def test_all_verdicts_on_coinciding_fixed_points_are_undecided():
    system = system_of("equal")
    double = replace(vi.fixed_points(system)[0], multiple=True)
    assert set(criteria.of_fixed_point(system, double).values()) == {"undecided"}


def test_the_slow_flow_is_undecided_only_next_to_a_fold():
    """Two fixed points merge as f20 decreases; bisection finds where they last exist."""
    low, high = 0.65, 0.75
    base = system_of("equal")
    while low < (middle := (low + high) / 2) < high:
        low, high = (low, middle) if len(vi.fixed_points(base.with_(f20_hat=middle))) == 3 else (middle, high)
    near = base.with_(f20_hat=high)
    assert "undecided" in [criteria.of_fixed_point(near, point)["slow"] for point in vi.fixed_points(near)]
    clear = base.with_(f20_hat=high + 1e-4)
    assert "undecided" not in [criteria.of_fixed_point(clear, point)["slow"] for point in vi.fixed_points(clear)]


def test_slow_variables_of_an_orbit_solve_the_slow_flow_to_leading_order():
    """The rates of (10.22) are O(epsilon)."""
    residuals = []
    for epsilon in (2e-4, 1e-4):
        system = system_of("equal", epsilon=epsilon)
        orbit = min((o for o in orbits(system) if o.symmetric), key=lambda o: np.abs(o.C - [1.191, 1.119]).max())
        psi, C = criteria.slow_variables(orbit)
        residuals.append(np.abs(np.concatenate(rates(system, B_of_C(C, rho(0.65)), psi, C))).max())
    assert residuals[1] < 1e-3
    assert residuals[0] / residuals[1] == pytest.approx(2, rel=0.02)
