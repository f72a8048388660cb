"""All fixed points are found: their numbers and positions agree with exact root counts, closed forms and symmetries."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from chapter import system_of
from systems_of_points import FOLD, IDENTICAL, NEARLY_ELASTIC, UNCOUPLED, UNDAMPED, build, single_module
from vibroimpact.theory import manifold
from vibroimpact.theory.fixed_points.symmetric_points import labels, search, search_radius
from vibroimpact.theory.masri import printed_limit
from vibroimpact.theory.slow_flow import rates

# Found in scans of random parameters; exact arithmetic confirms the counts below.
RESONANT = UNDAMPED | IDENTICAL
FIVE = {"sigma20_hat": 0.01, "f10_hat": 1.25, "f20_hat": 1.25}
SIX = {"kappa": 0.793, "alpha12_hat": 2.622, "gamma1_hat": 0.0127, "gamma2_hat": 0.0765, "gamma12_hat": 0.872}
SIX |= {"sigma20_hat": -1.066, "sigma_e_hat": 0.838, "f10_hat": 1.227, "f20_hat": -0.905}
CASES = {
    "equal": ({}, 3),
    "unequal": ({"f20_hat": 0.89}, 3),
    "weak": ({"f10_hat": 0.5, "f20_hat": 0.5}, 1),
    "five": (FIVE, 5),
    "six": (SIX, 6),
    "identical": (FIVE | IDENTICAL, 5),
    "none, weakly forced": ({"f10_hat": 0.05, "f20_hat": 0.05}, 0),
    "none, unforced": ({"f10_hat": 0.0, "f20_hat": 0.0}, 0),
    "undamped": (UNDAMPED, 3),
    "opposed forces": ({"f20_hat": -1.0}, 3),
    "kappa near 0": ({"kappa": 1e-6}, 1),
    "kappa near 1": ({"kappa": 1 - 1e-6}, 3),
    "weak coupling": ({"alpha12_hat": 1e-6, "gamma12_hat": 1e-7}, 1),
    "strong coupling": ({"alpha12_hat": 1e4}, 3),
    "first box unforced": ({"f10_hat": 0.0}, 1),
    # the forces do work on the resonance of the slow flow, which differs from that of the system by O(epsilon)
    "loaded resonance": (RESONANT | {"sigma_e_hat": 1.0, "f20_hat": -1.0}, 1),
}


def residual(system, point):
    dB, dpsi = rates(system, point.B, point.psi, point.C)
    return np.abs([*dB, *(point.B * dpsi)]).max()


def exact_count(system):
    """Return the number of real (C_1, C_2), by Sturm's theorem for the resultant in exact rational arithmetic.

    The equations are |b_i|^2 = B_i^2, where b solves the 2 x 2 complex linear system. Floats are rational numbers, and
    pi is rounded once.
    """
    x, y = sp.symbols("x y", real=True)
    exact = {name: sp.Rational(getattr(system, name)) for name in vars(system)}
    mu = 8 / sp.Rational(np.pi) ** 2
    r = 2 * (1 - exact["kappa"]) / (sp.Rational(np.pi) * (1 + exact["kappa"]))
    K = exact["alpha12_hat"] + sp.I * exact["gamma12_hat"]
    d = [K - 2 * exact["sigma_e_hat"] + sp.I * exact["gamma1_hat"]]
    d.append(K + exact["sigma20_hat"] - 2 * exact["sigma_e_hat"] + sp.I * exact["gamma2_hat"])
    force = [exact["f10_hat"], exact["f20_hat"]]
    z = [1 - (1 + sp.I * r) * C for C in (x, y)]
    A = [d[0] * z[0] + mu * x, d[1] * z[1] + mu * y]

    def modulus_squared(e):
        re, im = sp.expand(e).as_real_imag()
        return sp.expand(re**2 + im**2)

    delta = modulus_squared(A[0] * A[1] - K**2 * z[0] * z[1])
    first = sp.Poly(delta - modulus_squared(force[0] * A[1] + K * z[1] * force[1]), x, y)
    second = sp.Poly(delta - modulus_squared(force[1] * A[0] + K * z[0] * force[0]), x, y)
    square_free = sp.Poly(sp.resultant(first, second, y), x).sqf_part()
    assert square_free.degree() == 8, "the count needs distinct C_1"
    return square_free.count_roots()


@pytest.mark.parametrize("name", CASES)
def test_fixed_points_have_the_expected_number_and_zero_rates_in_the_slow_flow(name):
    changes, count = CASES[name]
    system = build(changes)
    points = vi.fixed_points(system)
    assert len(points) == count
    assert all(np.all(point.C >= 0) for point in points)
    assert [point.C[0] for point in points] == sorted(point.C[0] for point in points)
    scale = max(1, system.alpha12_hat, abs(system.f10_hat))
    for point in search(system):
        assert not point.multiple
        assert residual(system, point) < 1e-13 * scale * (1 + np.abs(point.C).max())
        assert np.abs(point.B - manifold.B_of_C(point.C, manifold.rho(system.kappa))).max() < 1e-14 * point.B.max()
        assert np.all(np.abs(point.psi) <= np.pi)


COUNTED = "equal", "unequal", "weak", "five", "six", "undamped", "kappa near 0", "opposed forces"
COUNTED = {name: CASES[name][0] for name in COUNTED}
COUNTED |= {name: {"gamma12_hat": 0.0} | changes for name, changes in NEARLY_ELASTIC.items()}


@pytest.mark.parametrize("name", COUNTED)
def test_the_number_of_all_points_is_exact(name):
    """In nearly elastic systems Delta, n_1 and n_2 almost vanish, so that only the phases decide on zeros."""
    system = build(COUNTED[name])
    found = search(system)
    assert not any(point.multiple for point in found)
    assert len(found) == exact_count(system)


ranges = dict(
    kappa=(0.02, 0.99), alpha12_hat=(0.01, 10), gamma1_hat=(0.001, 2), gamma2_hat=(0, 2), gamma12_hat=(0.01, 2),
    sigma20_hat=(-3, 3), sigma_e_hat=(-1, 1), f10_hat=(-3, 3), f20_hat=(-3, 3),
)  # fmt: skip
numbers = {name: st.floats(*ends) for name, ends in ranges.items()}
systems = st.builds(vi.System, epsilon=st.just(0.1), **numbers)


@settings(max_examples=40)
@given(systems)
def test_the_power_balances_and_swapped_modules_have_swapped_points(system):
    """Dampers and balls dissipate the power of the forces; detunings are relative to module 1."""
    points = search(system)
    f = np.array([system.f10_hat, system.f20_hat])
    for point in points:
        assert np.linalg.norm(point.C) <= search_radius(system)
        b = point.B * np.exp(-1j * point.psi)
        dampers = np.array([system.gamma1_hat, system.gamma2_hat]) @ point.B**2
        dampers += system.gamma12_hat * abs(b[0] - b[1]) ** 2
        balls = 8 / np.pi**2 * manifold.rho(system.kappa) * (point.C**2).sum()
        assert (b.conj() @ f).imag == pytest.approx(dampers + balls, rel=1e-6, abs=1e-6)
    swapped = system.with_(
        gamma1_hat=system.gamma2_hat, gamma2_hat=system.gamma1_hat, f10_hat=system.f20_hat, f20_hat=system.f10_hat,
        sigma20_hat=-system.sigma20_hat, sigma_e_hat=system.sigma_e_hat - system.sigma20_hat / 2,
    )  # fmt: skip
    others = search(swapped)
    if not any(point.multiple for point in points + others):
        assert len(points) == len(others)
        for point in points:
            assert min(np.abs(point.C - other.C[::-1]).max() for other in others) < 1e-5


@pytest.mark.parametrize("changes", [{}, IDENTICAL, {"gamma1_hat": 0.0, "f20_hat": 3.0}, {"f10_hat": 0.0}])
def test_points_of_uncoupled_modules_are_pairs_of_single_solutions(changes):
    system = build(UNCOUPLED | changes)
    e = -2 * system.sigma_e_hat + 1j * system.gamma1_hat, -2 * system.sigma_e_hat + 1j * system.gamma2_hat
    first = single_module(e[0], system.f10_hat, system.kappa) if system.f10_hat else [np.nan]
    second = single_module(e[1] + system.sigma20_hat, system.f20_hat, system.kappa)
    expected = [(a, b) for a in first for b in second]
    found = [np.round(point.C, 12).tolist() for point in search(system)]
    found, expected = (sorted(map(tuple, np.nan_to_num(pairs, nan=9).tolist())) for pairs in (found, expected))
    assert np.array(found).reshape(-1, 2) == pytest.approx(np.array(expected).reshape(-1, 2), abs=1e-11)


@pytest.mark.parametrize("loss", [1e-3, 1e-5, 3e-6, 1e-7, 1e-10])
def test_points_with_mirrored_phases_are_distinguished_near_the_conservative_limit(loss):
    """In undamped, almost elastic systems two points differ in C by some 4 loss, but much more in phase."""
    system = build(UNDAMPED | {"kappa": 1 - loss})
    points = vi.fixed_points(system)
    assert len(points) == 5
    for point in points:
        assert not point.multiple
        assert residual(system, point) < 1e-13
    assert np.abs(points[2].C - points[3].C).max() < 5 * loss
    assert points[2].psi == pytest.approx(-points[3].psi, abs=10 * loss)
    assert np.abs(points[2].psi).min() > 0.1


@pytest.mark.parametrize(
    "changes",
    [
        RESONANT | {"sigma_e_hat": 0.0, "f20_hat": -1.0},  # boxes in phase, forces opposed
        RESONANT | {"sigma_e_hat": 1.0},  # boxes opposed, forces in phase
        RESONANT | {"sigma_e_hat": 0.0, "f10_hat": 0.0, "f20_hat": 0.0},
    ],
)
def test_an_undamped_resonance_on_which_the_forces_do_no_work_is_refused(changes):
    with pytest.raises(ValueError, match=r"^sigma_e_hat: .* resonance"):
        vi.fixed_points(build(changes))


def test_merging_points_are_reported_as_multiple():
    """The distance of two points near a fold is proportional to the square root of the distance to the fold."""
    found = {h: vi.fixed_points(build({"f20_hat": FOLD + h})) for h in (-1e-6, 0.0, 1e-6, 1e-4)}
    assert [len(points) for points in found.values()] == [1, 2, 3, 3]
    (merged,) = (point for points in found.values() for point in points if point.multiple)
    assert np.abs(merged.slow_eigenvalues).min() < 1e-3, "one slow eigenvalue passes through zero"
    gaps = [found[h][1].C[0] - found[h][0].C[0] for h in (1e-4, 1e-6)]
    assert gaps[0] / gaps[1] == pytest.approx(10, rel=0.02)


def test_the_chapter_s_sentences_on_figs_10_6_10_7_and_10_9_hold_for_the_labels():
    found = []
    for case in ("equal", "unequal"):
        system = system_of(case)
        points, r = vi.fixed_points(system), manifold.rho(system.kappa)
        named = dict(zip(labels(system, points), points, strict=True))
        assert sorted(named) == ["a", "b", "c"]
        assert named["a"].C[0] < printed_limit(r) < manifold.C_min(r) < named["a"].C[1]
        assert min(named["c"].C) > manifold.C_min(r)
        found.append(named)
    equal, unequal = found
    assert min(equal["b"].C) > printed_limit(r)
    assert min(unequal["b"].C) < manifold.C_min(r)
    assert equal["c"].slow_eigenvalues.real.max() < 0 < equal["b"].slow_eigenvalues.real.max()
    assert (unequal["c"].C < equal["c"].C).all()
    assert (unequal["c"].B < equal["c"].B).all()
