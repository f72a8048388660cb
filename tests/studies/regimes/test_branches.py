"""Special points against the zeros that define them, evaluated by other means than continuation uses."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import expm

import vibroimpact as vi
from vibroimpact.exact.orbits.search import half_period_multipliers
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.studies.regimes.branches import Path, branches
from vibroimpact.studies.regimes.families import (
    FOLD,
    GRAZING,
    HOPF,
    NEIMARK_SACKER,
    PERIOD_DOUBLING,
    SPEED_ZERO,
    SYMMETRY_BREAKING,
    AsymmetricOrbits,
    FixedPoints,
    SymmetricOrbits,
)
from vibroimpact.system.matrices import rate_matrix

INTERVAL, SEEDS = (0.65, 1.3), (0.89, 1.1)


@pytest.fixture(scope="module")
def path(chapter):
    return Path(chapter(), ("f20_hat",))


@pytest.fixture(scope="module")
def found(path):
    families = SymmetricOrbits, AsymmetricOrbits, FixedPoints
    return {family: branches(family, path, INTERVAL, SEEDS, longest=0.1) for family in families}


def special(found, family, kind):
    points = [node for branch in found[family] for node in branch.special if node.kind.startswith(kind)]
    points = [p for p in points if kind != FOLD or p.kind == FOLD]
    assert points, f"no {kind} of a {family.name}"
    return points


def engine_multipliers(path, family, node):
    """Multipliers from the variational flow of the simulation, which shares no code with exact.floquet."""
    system = path(node.p)
    return np.linalg.eigvals(vi.simulate(system, family.member(system, node.x).state, 1).jacobian)


def orbits_at(path, p, amplitudes):
    """Exact orbits at p, found by the complete search, nearest to given amplitudes first."""
    system = path(p)
    return sorted(
        (orbit for orbit in vi.orbits(system) if (orbit.ball_speeds > 0).all()),
        key=lambda orbit: np.linalg.norm(orbit.C - amplitudes),
    )


def test_all_motions_at_a_value_lie_on_branches_with_their_stability(path, found):
    p = 1.0
    for family in (SymmetricOrbits, AsymmetricOrbits):
        nodes = [(a, b) for branch in found[family] for a, b in pairwise(branch.nodes) if (a.p - p) * (b.p - p) <= 0]
        expected = [o for o in vi.orbits(path(p)) if o.symmetric == (family is SymmetricOrbits) and o.admissible]
        assert expected
        for orbit in expected:
            near = [a for a, b in nodes if np.linalg.norm(0.5 * (a.amplitudes + b.amplitudes) - orbit.C) < 0.1]
            assert near
            assert {a.stable for a in near if not a.kind} <= {bool(abs(orbit.multipliers[0]) < 1)}


def test_folds_of_symmetric_orbits_are_where_two_roots_of_the_complete_search_meet(path, found):
    for node in special(found, SymmetricOrbits, FOLD):
        counts = [len(symmetric_solutions(path(node.p + shift))) for shift in (-1e-7, 1e-7)]
        assert abs(counts[1] - counts[0]) == 2
        assert abs(engine_multipliers(path, SymmetricOrbits, node) - 1).min() < 1e-6


def test_symmetry_breaks_where_a_multiplier_of_half_a_period_is_minus_one(path, found):
    for node in special(found, SymmetricOrbits, SYMMETRY_BREAKING):
        system = path(node.p)
        orbit = next(o for o in orbits_at(path, node.p, node.amplitudes) if o.symmetric)
        assert abs(half_period_multipliers(orbit) + 1).min() < 1e-9
        # Seen as an asymmetric motion with equal flights it is a multiple root, which no multiplier enters.
        times = node.x[:2, None] + [0, system.period / 2]
        x = np.concatenate([times.ravel(), 8 * node.x[2:] / ((1 + system.epsilon) * system.period)])
        residual, jacobian = AsymmetricOrbits.equations(system, x)
        assert abs(residual).max() < 1e-10
        assert np.linalg.svd(jacobian, compute_uv=False)[-1] < 1e-9


@pytest.mark.parametrize("family", [SymmetricOrbits, AsymmetricOrbits])
def test_neimark_sacker_points_have_a_complex_pair_on_the_unit_circle(path, found, family):
    for node in special(found, family, NEIMARK_SACKER):
        mu = engine_multipliers(path, family, node)
        pair = mu[mu.imag > 1e-4]
        assert abs(abs(pair) - 1).min() < 1e-9


def test_period_doublings_have_a_multiplier_minus_one(path, found):
    for node in special(found, AsymmetricOrbits, PERIOD_DOUBLING):
        assert abs(engine_multipliers(path, AsymmetricOrbits, node) + 1).min() < 1e-7


def test_grazing_points_touch_a_wall_between_impacts(path, found):
    """The motion between impacts, finely sampled with matrix exponentials."""
    for node in special(found, AsymmetricOrbits, GRAZING):
        system = path(node.p)
        orbit = AsymmetricOrbits.member(system, node.x)
        assert largest_excursion_by_sampling(system, orbit) == pytest.approx(1, abs=1e-7)


def largest_excursion_by_sampling(system, orbit, samples=20000):
    """Largest |W| at its sampled maxima inside flights; boxes from their Fourier series would not know the impacts."""
    from vibroimpact.exact.orbits.floquet import follow

    times = np.sort((orbit.impact_phases * system.period).ravel())
    modules = np.array([1, 1, 2, 2])[np.argsort((orbit.impact_phases * system.period).ravel())]
    after = [orbit.state, *follow(system, orbit.state, times, modules, system.period).after]
    largest = 0.0
    for state, start, end in zip(after, [0, *times], [*times, system.period], strict=True):
        step = (end - start) / samples
        flow = expm(rate_matrix(system) * step)
        boxes = np.array([*state[[0, 2, 4, 6]], np.sin(system.Omega * start), np.cos(system.Omega * start)])
        W = np.empty((samples + 1, 2))
        for k in range(samples + 1):
            W[k] = boxes[:2] - state[[1, 3]] - state[[5, 7]] * step * k
            boxes = flow @ boxes
        inner = np.abs(W)
        peaks = (inner[1:-1] > inner[:-2]) & (inner[1:-1] > inner[2:])
        largest = max(largest, inner[1:-1][peaks].max(initial=0.0))
    return largest


def test_branches_end_where_a_ball_speed_vanishes(found):
    for family in (SymmetricOrbits, FixedPoints):
        for node in special(found, family, SPEED_ZERO):
            assert node.amplitudes.min() == pytest.approx(0, abs=1e-12)


def test_folds_of_the_theory_are_where_two_fixed_points_meet(path, found):
    for node in special(found, FixedPoints, FOLD):
        counts = [len(vi.fixed_points(path(node.p + shift))) for shift in (-1e-8, 1e-8)]
        assert abs(counts[1] - counts[0]) == 2


def test_hopf_points_have_a_pair_on_the_imaginary_axis(chapter):
    path = Path(chapter(), ("f10_hat", "f20_hat"))
    found = {FixedPoints: branches(FixedPoints, path, (0.5, 0.8), [0.6], longest=0.1)}
    for node in special(found, FixedPoints, HOPF):
        point = min(vi.fixed_points(path(node.p)), key=lambda p: np.linalg.norm(p.C - node.amplitudes))
        values = point.slow_eigenvalues
        assert abs(values[values.imag > 0.1].real).min() < 1e-9


def test_of_two_mirror_images_one_is_followed(path, found):
    for node in found[AsymmetricOrbits][0].nodes[::10]:
        images = AsymmetricOrbits.images(path(node.p), node.x)
        for image in images:
            assert abs(AsymmetricOrbits.equations(path(node.p), image)[0]).max() < 1e-10
    p = 0.9
    crossings = sum((a.p - p) * (b.p - p) < 0 for branch in found[AsymmetricOrbits] for a, b in pairwise(branch.nodes))
    pairs = [o for o in vi.orbits(path(p)) if not o.symmetric and (o.ball_speeds > 0).all()]
    assert crossings == len(pairs) / 2


def test_any_parameter_may_be_followed_up_to_where_it_ends(chapter):
    """A step towards negative epsilon is shortened; what is reached is a root, and the theory's is 10 epsilon away."""
    system = chapter()
    path = Path(system, ("epsilon",))
    found = branches(SymmetricOrbits, path, (0.01, 0.1), [0.1], longest=0.1)
    ends = [node for branch in found for node in (branch.nodes[0], branch.nodes[-1]) if node.p <= 0.01]
    assert ends
    for node in ends:
        assert node.p > 0
        assert abs(SymmetricOrbits.equations(path(node.p), node.x)[0]).max() < 1e-10
        assert min(np.linalg.norm(point.C - node.amplitudes) for point in vi.fixed_points(system)) < 10 * node.p
