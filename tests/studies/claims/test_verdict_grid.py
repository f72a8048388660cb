"""The grid of verdicts: its orbits are those that continue the fixed points, its truth is that of the simulation."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.accuracy.verdict_table import partners
from vibroimpact.exact.orbits.search import symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.studies.claims.verdict_grid import by_epsilon, compute

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)


@pytest.fixture(scope="module")
def grid():
    """Centres (1.0, 1.2) x (0.72, 1.12): at (1, 0.72) three fixed points and one orbit."""
    return compute(SYSTEM, (0.9, 1.3), (0.52, 1.32), points=2, epsilon=[0.1, 0.01])


def followed(system, point, epsilons):
    """C of the orbit that is reached from a fixed point through growing epsilon, or None where it is lost."""
    trail = [point.C]
    for epsilon in epsilons:
        guess = 2 * trail[-1] - trail[-2] if len(trail) > 1 else trail[-1]
        listed = symmetric_solutions(system.with_(epsilon=epsilon))[:, 2:]
        gaps = np.linalg.norm(listed - guess, axis=1)
        if gaps.min() > 0.03:
            return None
        trail.append(listed[gaps.argmin()])
    return trail[-1]


@pytest.mark.parametrize("forces", [(1.0, 0.72), (1.433, 0.833)])
def test_partners_are_the_orbits_that_continue_the_fixed_points(forces):
    system = SYSTEM.with_(f10_hat=forces[0], f20_hat=forces[1])
    points, orbits = vi.fixed_points(system), symmetric_solutions(system)[:, 2:]
    for point, partner in zip(points, partners([p.C for p in points], orbits), strict=True):
        reached = followed(system, point, np.linspace(0.005, 0.1, 20))
        assert (partner is None) == (reached is None)
        if partner is not None:
            np.testing.assert_allclose(orbits[partner], reached, atol=1e-9)


def test_by_epsilon_the_multiplier_is_that_of_the_nearest_orbit():
    """Of vi.orbits, which searches anew; point c passes 1 at an epsilon below 0.0022."""
    table = by_epsilon(SYSTEM, [0.1, 0.01, 0.002])
    for epsilon, rows in table.groupby("epsilon"):
        exact = [orbit for orbit in vi.orbits(SYSTEM.with_(epsilon=epsilon)) if orbit.symmetric]
        for row in rows.itertuples():
            nearest = min(exact, key=lambda orbit, row=row: np.hypot(*(orbit.C - (row.C1, row.C2))))
            assert row.multiplier == pytest.approx(abs(nearest.multipliers).max(), rel=1e-9)
            assert row.exact == ("stable" if row.multiplier < 1 else "unstable")
    assert table[table["label"] == "c"]["exact"].tolist() == ["unstable", "unstable", "stable"]


def test_verdicts_are_those_of_the_simulation_s_multipliers(grid):
    """The Jacobian of the engine, which shares no code with exact.floquet; at (1, 0.72) two points have no orbit."""
    there = grid[(grid["f10_hat"] == 1.0) & np.isclose(grid["f20_hat"], 0.72) & (grid["epsilon"] == 0.1)]
    assert sorted(there["exact"] == "no orbit") == [False, True, True]
    for _, row in grid[grid["admissible"]].iterrows():
        system = SYSTEM.with_(epsilon=row["epsilon"], f10_hat=row["f10_hat"], f20_hat=row["f20_hat"])
        orbits = [symmetric_orbit(system, root) for root in symmetric_solutions(system)]
        orbit = min(orbits, key=lambda o: np.linalg.norm(o.C - [row["C1"], row["C2"]]))
        largest = np.abs(np.linalg.eigvals(vi.simulate(system, orbit.state, 1).jacobian)).max()
        assert row["exact"] == ("stable" if largest < 1 else "unstable")
