"""Asymmetric fixed points are equilibria of the slow flow with its eigenvalues, and their lists are complete."""

import functools
import itertools

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.studies.completeness import points as completeness_proof
from vibroimpact.studies.theory.asymmetric_points import fixed_points, search
from vibroimpact.studies.theory.branch import ASYMMETRIC, charts
from vibroimpact.theory.slow_flow import impedances

SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}
SYSTEMS |= {
    "strong": SYSTEMS["equal"].with_(f20_hat=1.1),
    "both": SYSTEMS["equal"].with_(f10_hat=1.9, f20_hat=1.6, gamma1_hat=0.1, gamma2_hat=0.1),
}


@functools.cache
def points(case):
    return search(SYSTEMS[case])


def flow(system, point, b):
    """Return D_1 b near a point; each N follows |b| along the chart of its module."""
    known, N = charts(system.kappa), []
    for name, x, size in zip(point.charts, point.x, abs(b), strict=True):
        chart = known[name]
        for _ in range(8):
            B, _, B_x, _ = chart.ball(x)
            x -= (B - size) / B_x
        N.append(chart.n(x) / chart.z(x))
    e, K = impedances(system)
    return (np.array([system.f10_hat, system.f20_hat]) - (e + N) * b - K * (b - b[::-1])) / 2j


@pytest.mark.parametrize("case", ["equal", "both"])
def test_points_are_equilibria_and_eigenvalues_are_those_of_the_flow_in_the_plane_of_b(case):
    system, step = SYSTEMS[case], 1e-6
    for point in points(case):
        b = point.B * np.exp(-1j * point.psi)
        assert abs(flow(system, point, b)).max() < 1e-10
        columns = []
        for change in (1, 0), (1j, 0), (0, 1), (0, 1j):
            ahead, behind = (flow(system, point, b + sign * step * np.array(change)) for sign in (1, -1))
            slope = (ahead - behind) / (2 * step)
            columns.append(np.ravel([slope.real, slope.imag], order="F"))
        # Characteristic polynomials are compared, since their coefficients have an order.
        np.testing.assert_allclose(np.poly(np.transpose(columns)), np.poly(point.slow_eigenvalues).real, atol=1e-5)


@pytest.mark.parametrize("case", SYSTEMS)
def test_lists_of_points_are_proved_complete(case):
    proof = completeness_proof.certify_asymmetric(SYSTEMS[case])
    assert proof.complete
    assert len(proof.isolated) == len(points(case))


def test_a_list_with_a_missing_or_a_repeated_point_is_not_complete(monkeypatch):
    listed = points("equal")
    for spoilt in (listed[1:], [*listed, listed[0]]):
        monkeypatch.setattr(completeness_proof.asymmetric, "search", lambda system, spoilt=spoilt: spoilt)
        assert not completeness_proof.certify_asymmetric(SYSTEMS["equal"]).complete


def test_points_of_uncoupled_modules_are_combinations_of_points_of_single_modules():
    """The points of a single module are roots of |e z + n| = |f beta|, on a symmetric or on the asymmetric chart."""
    system = SYSTEMS["equal"].with_(alpha12_hat=0, gamma12_hat=0, f10_hat=0.6)
    e, forces, known = impedances(system)[0], (system.f10_hat, system.f20_hat), charts(system.kappa)
    roots = {}
    for (module, force), (name, chart) in itertools.product(enumerate(forces), known.items()):
        x = np.linspace(-1, 1, 4001)
        excess = abs(e[module] * chart.z(x) + chart.n(x)) - abs(force * chart.beta(x))
        roots[module, name] = x[:-1][excess[:-1] * excess[1:] < 0]
    for first, second in itertools.product(known, known):
        if ASYMMETRIC in (first, second):
            expected = sorted(itertools.product(roots[0, first], roots[1, second]))
            found = sorted(tuple(p.x) for p in search(system) if p.charts == (first, second))
            np.testing.assert_allclose(np.reshape(found, (-1, 2)), np.reshape(expected, (-1, 2)), atol=6e-4)


def test_unforced_systems_have_no_points_and_other_types_are_rejected():
    assert fixed_points(SYSTEMS["equal"].with_(f10_hat=0.0, f20_hat=0.0)) == []
    with pytest.raises(ValueError, match="system"):
        fixed_points("equal")
