"""Compute every table and number of docs/stability.md. All digits on the page are compared."""

import re
from functools import cache

import numpy as np
import pytest
from scipy.optimize import brentq

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from pipeline_trees import ROOT
from verdict_tables import verdicts_of
from vibroimpact.exact.orbits.search import half_period_multipliers, symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.theory.manifold import largest_C
from vibroimpact.theory.masri import impact_multipliers

PAGE = (ROOT / "docs/stability.md").read_text(encoding="utf-8")
TEXT = " ".join(PAGE.split())
SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}
SYMMETRY_BREAKING = np.pi**2 / (np.pi**2 - 4)
UNCOUPLED = {**PARAMETERS, "alpha12_hat": 0, "gamma12_hat": 0, "sigma20_hat": 0}


def cells(heading):
    """Return the rows of the table whose first row begins with a heading, including this row."""
    text = PAGE[PAGE.index(f"| {heading} |") :].split("\n\n")[0]
    rows = [[cell.strip() for cell in line.strip("| ").split("|")] for line in text.splitlines()]
    return [row for row in rows if not set("".join(row)) <= set("-")]


def stated(pattern):
    """Return the number that the first group of a pattern matches on the page, for comparison by all its digits."""
    ((whole, *_),) = {found if isinstance(found, tuple) else (found,) for found in re.findall(pattern, TEXT)}
    return number(whole)


def number(text):
    """Return a number for comparison, with half a unit of its last digit as tolerance."""
    text = text.replace("−", "-").strip("*")
    return pytest.approx(float(text), abs=0.5001 * 10.0 ** -len(text.partition(".")[2]))


@cache
def tables():
    return verdicts_of(SYSTEMS)


def nearest_orbit(system, C):
    roots = symmetric_solutions(system)
    return symmetric_orbit(system, roots[np.abs(roots[:, 2:] - C).max(axis=1).argmin()])


def test_multipliers_of_the_table_of_limits():
    """Sum and product of the multipliers are compared, since these are accurate even for a double multiplier."""
    for C, _, mu in cells("$C$")[1:]:
        printed = [float(value.replace("−", "-")) for value in mu.split(", ")]
        expected = impact_multipliers(float(C), 0.65)
        assert sum(printed) == pytest.approx(expected.sum().real, abs=1.1e-3), C
        assert np.prod(printed) == pytest.approx(0.65**2, abs=2e-3), C


def test_largest_C_without_penetration():
    kappas, C = cells("$\\kappa$")
    for kappa, value in zip(kappas[1:], C[1:], strict=True):
        # At 0.0867, a rounded value, the multiplier is the one of symmetry breaking.
        assert largest_C(float(kappa)) == pytest.approx(float(value), abs=4e-4 if kappa == "0.0867" else 5.1e-5)
    assert largest_C(1 - 1e-9) == stated(r"1 at \$\\kappa\\to0\$ to ([\d.]+) at")
    largest = max(point.C.max() for system in SYSTEMS.values() for point in vi.fixed_points(system))
    assert largest == stated(r"the largest \$C\$ is ([\d.]+)\)")
    assert largest < largest_C(0.65) == stated(r"holds for \$0\\le C\\le ([\d.]+)\$")


def test_shift_of_the_symmetry_breaking_limit_with_epsilon():
    assert SYMMETRY_BREAKING - float(cells("$\\varepsilon$")[1][1]) == stated(r"limit has moved by ([\d.]+)\. Within")


def test_table_of_variants_of_the_printed_limit():
    """A variant reproduces the captions if it lies between the smaller C of point b and the fold."""

    def kappa(rho):
        return (2 - np.pi * rho) / (2 + np.pi * rho)

    rho = 2 * 0.35 / (np.pi * 1.65)
    fold = 1 / (1 + rho**2)
    # The limits are below the fold 1 / (1 + rho^2) where 4 rho^2 < pi^p rho^q; rho falls from 2 / pi to 0 with kappa.
    exponents = {"printed": (1, 1, "all $\\kappa$"), "\\pi^2": (2, 2, "all $\\kappa$")}
    exponents["4+\\rho"] = 0, 1, f"$\\kappa > {kappa(1 / 4):.3f}$"
    exponents["\\pi^3"] = 3, 3, f"$\\kappa < {kappa(4 / np.pi**3):.3f}$"
    second = sorted(point.C.min() for point in vi.fixed_points(SYSTEMS["unequal"]))[1]
    assert second == stated(r"limit between ([\d.]+) \(the smaller")
    assert fold == stated(r"C_\{\\min\} = ([\d.]+)\$\. But")
    for row, (key, (p, q, border)) in zip(cells("limit")[1:], exponents.items(), strict=True):
        name, value, fits, multiplier, below = row
        limit = 4 / (4 + np.pi**p * rho**q)
        assert key in name
        assert limit == number(value)
        assert fits.startswith("yes" if second < limit < fold else "no")
        assert impact_multipliers(limit, 0.65).max() == number(multiplier)
        if "by" in fits:
            assert second - limit == number(fits.rpartition(" ")[2])
        assert below == border


@pytest.mark.parametrize("column", range(5))
def test_C_of_symmetry_breaking_of_a_single_module(column):
    """The force is raised until a half-period multiplier of the upper orbit is -1."""
    epsilons, C = (row[1:] for row in cells("$\\varepsilon$"))
    epsilon = float(epsilons[column])

    def upper_orbit(f):
        system = vi.System(**UNCOUPLED | {"epsilon": epsilon}, f10_hat=f, f20_hat=f)
        roots = symmetric_solutions(system)
        return symmetric_orbit(system, roots[roots[:, 2:].min(axis=1).argmax()])

    breaking = brentq(lambda f: half_period_multipliers(upper_orbit(f)).real.min() + 1, 1.45, 1.72, xtol=1e-10)
    np.testing.assert_allclose(upper_orbit(breaking).C, float(C[column]), atol=5.1e-5)
    assert (upper_orbit(breaking).C < SYMMETRY_BREAKING).all()


def test_point_c_of_the_equal_case():
    """Compare distance from the limit, multiplier of the exact orbit, and largest epsilon for a stable orbit."""
    system = SYSTEMS["equal"]
    C = min(vi.fixed_points(system), key=lambda point: abs(point.C[1] - 1.6771)).C

    def lowest_multiplier(epsilon):
        return half_period_multipliers(nearest_orbit(system.with_(epsilon=epsilon), C)).real.min()

    assert SYMMETRY_BREAKING - C[1] == stated(r"lies ([\d.]+) below the limit")
    assert lowest_multiplier(0.1) == stated(r"half-period multiplier \$(-[\d.]+)\$")
    assert brentq(lambda epsilon: lowest_multiplier(epsilon) + 1, 1e-3, 5e-3, xtol=1e-9) == stated(
        r"only for \$\\varepsilon < ([\d.]+)\$"
    )
    assert nearest_orbit(system, C).C[1] == stated(r"its exact orbit has \$C_2 = ([\d.]+)\$")


@pytest.mark.parametrize("case", ["equal", "unequal"])
def test_the_stable_orbits_are_a_pair_of_asymmetric_ones(case):
    _, orbits = tables()
    stable = orbits[(orbits["case"] == case) & (orbits["exact"] == "stable")]
    assert len(stable) == 2
    assert not stable["symmetric"].any()
    C1, C2, modulus = re.search(rf"in\s+the {case} case \(\$C = ([\d.]+), ([\d.]+)\$[^)]*?([\d.]+)\)", PAGE).groups()
    for _, orbit in stable.iterrows():
        assert [orbit["C1"], orbit["C2"], orbit["modulus_1"]] == [number(C1), number(C2), number(modulus)]
        assert orbit["fast"] == "stable"


def test_no_symmetric_orbit_is_stable_and_number_of_correct_verdicts_of_the_criteria():
    points, orbits = tables()
    assert not (orbits["symmetric"] & (orbits["exact"] == "stable")).any()
    both = (points["fast"] == "stable") & (points["slow"] == "stable")
    assert (points["printed_10_26"] == points["exact"]).sum() == 3
    assert (both == (points["exact"] == "stable")).sum() == 6
    assert len(points) == 7
