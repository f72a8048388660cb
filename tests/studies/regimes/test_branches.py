"""Special points of branches satisfy their defining equations, evaluated independently of the continuation."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

import vibroimpact as vi
from vibroimpact.exact.orbits.search import half_period_multipliers
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.studies.regimes import families as kinds
from vibroimpact.studies.regimes.branches import Path, branches
from vibroimpact.studies.regimes.families import AsymmetricOrbits, FixedPoints, SymmetricOrbits

INTERVAL, SEEDS = (0.65, 1.3), (0.89, 1.1)


@pytest.fixture(scope="module")
def path(chapter):
    """Return the path of systems along f20_hat."""
    return Path(chapter(), ("f20_hat",))


@pytest.fixture(scope="module")
def found(path):
    """Return the branches of the path by family."""
    families = SymmetricOrbits, AsymmetricOrbits, FixedPoints
    return {family: branches(family, path, INTERVAL, SEEDS, longest=0.1) for family in families}


def special(found, family, kind):
    points = [node for branch in found[family] for node in branch.special if node.kind.startswith(kind)]
    points = [p for p in points if kind != kinds.FOLD or p.kind == kinds.FOLD]
    assert points, f"no {kind} of a {family.name}"
    return points


def orbits_at(path, p, amplitudes):
    """Return exact orbits at p from the complete search, sorted by distance from the amplitudes."""
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


@pytest.mark.parametrize(
    ("family", "search", "offset"), [(SymmetricOrbits, symmetric_solutions, 1e-7), (FixedPoints, vi.fixed_points, 1e-8)]
)
def test_two_roots_of_the_complete_search_meet_at_folds(path, found, family, search, offset):
    for node in special(found, family, kinds.FOLD):
        counts = [len(search(path(node.p + shift))) for shift in (-offset, offset)]
        assert abs(counts[1] - counts[0]) == 2


def test_symmetry_breaks_where_a_multiplier_of_half_a_period_is_minus_one(path, found):
    for node in special(found, SymmetricOrbits, kinds.SYMMETRY_BREAKING):
        system = path(node.p)
        orbit = next(o for o in orbits_at(path, node.p, node.amplitudes) if o.symmetric)
        assert abs(half_period_multipliers(orbit) + 1).min() < 1e-9
        # As an asymmetric motion with equal flights, the orbit is a multiple root; this uses no multipliers.
        times = node.x[:2, None] + [0, system.period / 2]
        x = np.concatenate([times.ravel(), 8 * node.x[2:] / ((1 + system.epsilon) * system.period)])
        residual, jacobian = AsymmetricOrbits.equations(system, x)
        assert abs(residual).max() < 1e-10
        assert np.linalg.svd(jacobian, compute_uv=False)[-1] < 1e-9


@pytest.mark.parametrize(
    ("family", "kind"),
    [
        (SymmetricOrbits, kinds.NEIMARK_SACKER),
        (AsymmetricOrbits, kinds.NEIMARK_SACKER),
        (AsymmetricOrbits, kinds.PERIOD_DOUBLING),
    ],
)
def test_multipliers_are_on_the_unit_circle_at_neimark_sacker_and_period_doubling_points(path, found, family, kind):
    """The multipliers are those of the Jacobian of a simulation, which shares no code with `exact.orbits.floquet`."""
    for node in special(found, family, kind):
        system = path(node.p)
        mu = np.linalg.eigvals(vi.simulate(system, family.member(system, node.x).state, 1).jacobian)
        if kind == kinds.PERIOD_DOUBLING:
            assert abs(mu + 1).min() < 1e-7
        else:
            assert abs(abs(mu[mu.imag > 1e-4]) - 1).min() < 1e-9


def test_at_grazing_points_orbits_cease_to_be_motions(path, found):
    """At a distance of 1e-7 from the point, a simulation repeats the orbit on one side only."""
    for node in special(found, AsymmetricOrbits, kinds.GRAZING):
        repeated = set()
        for p in (node.p - 1e-7, node.p + 1e-7):
            orbit = orbits_at(path, p, node.amplitudes)[0]
            repeated.add(bool(np.abs(vi.simulate(path(p), orbit.state, 1).final - orbit.state).max() < 1e-9))
        assert repeated == {True, False}


def test_branches_end_where_a_ball_speed_vanishes(found):
    for family in (SymmetricOrbits, FixedPoints):
        for node in special(found, family, kinds.SPEED_ZERO):
            assert node.amplitudes.min() == pytest.approx(0, abs=1e-12)


def test_hopf_points_have_a_pair_of_eigenvalues_on_the_imaginary_axis(chapter):
    path = Path(chapter(), ("f10_hat", "f20_hat"))
    found = {FixedPoints: branches(FixedPoints, path, (0.5, 0.8), [0.6], longest=0.1)}
    for node in special(found, FixedPoints, kinds.HOPF):
        point = min(vi.fixed_points(path(node.p)), key=lambda p: np.linalg.norm(p.C - node.amplitudes))
        values = point.slow_eigenvalues
        assert abs(values[values.imag > 0.1].real).min() < 1e-9


def test_a_branch_in_epsilon_stays_at_positive_epsilon(chapter):
    """Steps to negative epsilon are shortened. Last nodes are roots and within 10 epsilon of a fixed point."""
    system = chapter()
    path = Path(system, ("epsilon",))
    found = branches(SymmetricOrbits, path, (0.01, 0.1), [0.1], longest=0.1)
    ends = [node for branch in found for node in (branch.nodes[0], branch.nodes[-1]) if node.p <= 0.01]
    assert ends
    for node in ends:
        assert node.p > 0
        assert abs(SymmetricOrbits.equations(path(node.p), node.x)[0]).max() < 1e-10
        assert min(np.linalg.norm(point.C - node.amplitudes) for point in vi.fixed_points(system)) < 10 * node.p


# Branch points, closed branches, seeds without a solution


def crossings(branch, p):
    """Return the amplitudes at which a branch crosses a value of the parameter, interpolated between nodes."""
    pairs = [(a, b) for a, b in pairwise(branch.nodes) if (a.p < p) != (b.p < p)]
    return [a.amplitudes + (p - a.p) / (b.p - a.p) * (b.amplitudes - a.amplitudes) for a, b in pairs]


def matched(found, roots):
    """Return True if two lists contain the same amplitudes, up to errors of interpolation."""
    if len(found) != len(roots) or not roots:
        return len(found) == len(roots)
    gaps = np.abs(np.array(found)[:, None] - np.array(roots)[None]).max(axis=2)
    return gaps[linear_sum_assignment(gaps)].max() < 0.1


def roots_at(family, system):
    """Return the amplitudes of all members of a family from the complete search, one per pair of mirror images."""
    if family is FixedPoints:
        return [point.C for point in vi.fixed_points(system)]
    symmetric = family is SymmetricOrbits
    orbits = [orbit.C for orbit in vi.orbits(system) if orbit.symmetric == symmetric and min(orbit.C) > 0]
    return orbits if symmetric else orbits[::2]


@pytest.mark.parametrize(
    ("along", "interval"),
    [(("f10_hat", "f20_hat"), (1.15, 1.5)), (("sigma_e_hat",), (0.3, 0.7)), (("kappa",), (0.37, 0.44))],
)
def test_branches_of_identical_machines_pass_branch_points(chapter, along, interval):
    """One fixed point with equal modules becomes three at a branch point, as complete searches on both sides show."""
    path = Path(chapter(sigma20_hat=0.0), along)
    found = vi.branches(path.system, along, interval, of="theory")
    for node in special({FixedPoints: found}, FixedPoints, kinds.BRANCH_POINT):
        assert node.amplitudes[0] == pytest.approx(node.amplitudes[1], abs=1e-7)
        counts = [len(vi.fixed_points(path(node.p + shift))) for shift in (-1e-5, 1e-5)]
        assert abs(counts[1] - counts[0]) == 2
    for p in np.linspace(*interval, 9)[1:-1] + 0.0013:
        assert matched([C for one in found for C in crossings(one, p)], roots_at(FixedPoints, path(p)))


@pytest.mark.parametrize("offset", [0.0, -1e-9])
def test_a_seed_at_a_branch_point_finds_its_branches(chapter, offset):
    """The search merges the roots that meet there and finds them to half the digits. Each branch is listed once."""
    path, interval = Path(chapter(sigma20_hat=0.0), ("kappa",)), (0.37, 0.42)
    known = {FixedPoints: branches(FixedPoints, path, interval, [0.4], 0.01)}
    crossing, *_ = special(known, FixedPoints, kinds.BRANCH_POINT)
    found = branches(FixedPoints, path, interval, [crossing.p + offset], 0.01)
    for p in (0.38, 0.4):
        assert matched([C for one in found for C in crossings(one, p)], roots_at(FixedPoints, path(p)))


def test_the_orbit_with_equal_modules_is_followed_through_its_branch_point(chapter):
    """Between the forces 1.2707 and 1.3012, asymmetric orbits that branch off the symmetric ones are found, too."""
    path = Path(chapter(sigma20_hat=0.0), ("f10_hat", "f20_hat"))
    found = vi.branches(path.system, path.names, (1.25, 1.32), of="exact", seeds=2)
    for p in (1.262, 1.285, 1.295, 1.31):
        for family in (SymmetricOrbits, AsymmetricOrbits):
            known = [C for one in found if one.family is family for C in crossings(one, p)]
            assert matched(known, roots_at(family, path(p)))
    [node] = special({SymmetricOrbits: found[:2]}, SymmetricOrbits, kinds.BRANCH_POINT)[:1]
    counts = [len(symmetric_solutions(path(node.p + shift))) for shift in (-1e-6, 1e-6)]
    assert abs(counts[1] - counts[0]) == 2


def test_a_closed_branch_is_followed_exactly_once():
    parameters = dict(epsilon=0.13, kappa=0.75, alpha12_hat=1.13, gamma1_hat=0.26, gamma2_hat=0.26, gamma12_hat=0.29)
    system = vi.System(**parameters, sigma20_hat=0.0, sigma_e_hat=0.0, f10_hat=0.66, f20_hat=0.46)
    found = vi.branches(system, "sigma_e_hat", (-1.5, 1.5), of="theory")
    [closed] = [branch for branch in found if branch.closed]
    np.testing.assert_allclose(closed.nodes[0].amplitudes, closed.nodes[-1].amplitudes, atol=1e-12)
    assert sum(node.kind == kinds.FOLD for node in closed.special) == 2
    assert vi.to_frame(found).groupby("branch")["closed"].any().sum() == 1
    for p in (-0.9, -0.6, -0.3):
        roots = roots_at(FixedPoints, system.with_(sigma_e_hat=p))
        assert matched([C for one in found for C in crossings(one, p)], roots)


def test_a_seed_at_a_resonance_is_skipped_with_a_warning(chapter):
    """Undamped boxes have no steady motion at their resonance, sigma_e_hat = 0. Other seeds find their branches."""
    system = chapter(sigma20_hat=0.0, gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0)
    message = r"^fixed point: skipped the search at sigma_e_hat = 0: [^\n]*resonance[^\n]*$"
    with pytest.warns(UserWarning, match=message) as caught:
        found = vi.branches(system, "sigma_e_hat", (-0.1, 0.1), of="theory", seeds=3)
    assert len(caught) == 1
    assert caught[0].filename == __file__
    for p in (-0.07, 0.04):
        roots = roots_at(FixedPoints, system.with_(sigma_e_hat=p))
        assert matched([C for one in found for C in crossings(one, p)], roots)


def test_a_branch_may_start_at_the_end_of_the_domain_of_its_parameter(chapter):
    """Damping cannot be negative, so that difference quotients at 0 are one-sided."""
    found = vi.branches(chapter(), "gamma12_hat", (0.0, 0.3), of="theory", seeds=2)
    assert kinds.LOST not in {node.kind for branch in found for node in branch.special}
    assert matched([C for one in found for C in crossings(one, 1e-5)], roots_at(FixedPoints, chapter(gamma12_hat=1e-5)))


def random_path(seed):
    """Return a path through a random system, its interval, and three values. Every third system is nearly symmetric."""
    random = np.random.default_rng(seed)
    low = dict(epsilon=0.02, kappa=0.3, alpha12_hat=0.2, gamma1_hat=0.05, gamma2_hat=0.05, gamma12_hat=0.0)
    low |= dict(sigma20_hat=-1.0, sigma_e_hat=-0.8, f10_hat=0.4, f20_hat=0.4)
    high = dict(epsilon=0.15, kappa=0.85, alpha12_hat=1.6, gamma1_hat=0.4, gamma2_hat=0.4, gamma12_hat=0.4)
    high |= dict(sigma20_hat=1.0, sigma_e_hat=0.8, f10_hat=1.6, f20_hat=1.6)
    values = {name: random.uniform(low[name], high[name]) for name in low}
    if seed % 3 == 0:
        unlike = random.choice([0.0, -1.0, 1.0]) * 10 ** random.uniform(-9, -2)
        values |= dict(gamma2_hat=values["gamma1_hat"], f20_hat=values["f10_hat"], sigma20_hat=unlike)
    along = (("sigma_e_hat",), ("kappa",), ("alpha12_hat",), ("f10_hat", "f20_hat"))[random.integers(4)]
    ends = np.linspace(low[along[0]], high[along[0]], 3)
    interval = ends[:2] if random.integers(2) else ends[1:]
    return Path(vi.System(**values), along), interval, random.uniform(*interval, 3)


def check_random_path(seed, of, families):
    """Check that branches contain all roots of the complete search, except on branches that pass no seed."""
    path, interval, values = random_path(seed)
    found = vi.branches(path.system, path.names, interval, of=of, seeds=3)
    assert kinds.LOST not in {node.kind for branch in found for node in branch.special}, seed
    for family in families:
        for p in values:
            known = [C for one in found if one.family is family for C in crossings(one, p)]
            roots = roots_at(family, path(p))
            if len(known) < len(roots):
                at_seeds = np.linspace(*interval, 3)
                own = branches(family, path, interval, [p], (interval[1] - interval[0]) / 10)
                alone = [one for one in own if not any(crossings(one, seed) for seed in at_seeds)]
                known += [C for one in alone for C in crossings(one, p)]
            assert matched(known, roots), (seed, family.name, p)


def test_branches_of_random_systems_contain_the_fixed_points_at_any_value():
    for seed in range(10):
        check_random_path(seed, "theory", [FixedPoints])


@pytest.mark.thorough
def test_branches_of_more_random_systems_contain_fixed_points_and_orbits_at_any_value():
    for seed in range(200):
        check_random_path(seed, "theory", [FixedPoints])
        check_random_path(seed, "exact", [SymmetricOrbits, AsymmetricOrbits])
