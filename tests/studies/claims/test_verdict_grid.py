"""Test the grid of verdicts: orbits continue fixed points in epsilon, and verdicts agree with simulations."""

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
    """Return a grid of forces (1.0, 1.2) x (0.72, 1.12); at (1, 0.72) there are three fixed points and one orbit."""
    return compute(SYSTEM, (0.9, 1.3), (0.52, 1.32), points=2, epsilon=[0.1, 0.01])


def continued_C(system, point, epsilons):
    """Return C of the orbit that continues a fixed point to the last epsilon, or None if the orbit is lost."""
    path = [point.C]
    for epsilon in epsilons:
        guess = 2 * path[-1] - path[-2] if len(path) > 1 else path[-1]
        listed = symmetric_solutions(system.with_(epsilon=epsilon))[:, 2:]
        distances = np.linalg.norm(listed - guess, axis=1)
        if distances.min() > 0.03:
            return None
        path.append(listed[distances.argmin()])
    return path[-1]


@pytest.mark.parametrize("forces", [(1.0, 0.72), (1.433, 0.833)])
def test_partners_of_fixed_points_are_the_orbits_that_continue_them(forces):
    system = SYSTEM.with_(f10_hat=forces[0], f20_hat=forces[1])
    points, orbits = vi.fixed_points(system), symmetric_solutions(system)[:, 2:]
    for point, partner in zip(points, partners([p.C for p in points], orbits), strict=True):
        reached = continued_C(system, point, np.linspace(0.005, 0.1, 20))
        assert (partner is None) == (reached is None)
        if partner is not None:
            np.testing.assert_allclose(orbits[partner], reached, atol=1e-9)


def test_multipliers_by_epsilon_are_those_of_the_nearest_orbit():
    """`vi.orbits` finds the orbits independently. Point c becomes stable at an epsilon between 0.002 and 0.01."""
    table = by_epsilon(SYSTEM, [0.1, 0.01, 0.002])
    for epsilon, rows in table.groupby("epsilon"):
        exact = [orbit for orbit in vi.orbits(SYSTEM.with_(epsilon=epsilon)) if orbit.symmetric]
        for row in rows.itertuples():
            nearest = min(exact, key=lambda orbit, row=row: np.hypot(*(orbit.C - (row.C1, row.C2))))
            assert row.multiplier == pytest.approx(abs(nearest.multipliers).max(), rel=1e-9)
            assert row.exact == ("stable" if row.multiplier < 1 else "unstable")
    assert table[table["label"] == "c"]["exact"].tolist() == ["unstable", "unstable", "stable"]


def test_verdicts_agree_with_multipliers_from_simulations(grid):
    """The Jacobian of the engine shares no code with `exact.orbits.floquet`. At (1, 0.72), two points have no orbit."""
    there = grid[(grid["f10_hat"] == 1.0) & np.isclose(grid["f20_hat"], 0.72) & (grid["epsilon"] == 0.1)]
    assert sorted(there["exact"] == "no orbit") == [False, True, True]
    for _, row in grid[grid["admissible"]].iterrows():
        system = SYSTEM.with_(epsilon=row["epsilon"], f10_hat=row["f10_hat"], f20_hat=row["f20_hat"])
        orbits = [symmetric_orbit(system, root) for root in symmetric_solutions(system)]
        orbit = min(orbits, key=lambda o: np.linalg.norm(o.C - [row["C1"], row["C2"]]))
        largest = np.abs(np.linalg.eigvals(vi.simulate(system, orbit.state, 1).jacobian)).max()
        assert row["exact"] == ("stable" if largest < 1 else "unstable")
