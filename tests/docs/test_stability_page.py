"""Every table and number of docs/stability.md, computed anew and compared to as many digits as the page has."""

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

PAGE = (ROOT / "docs/stability.md").read_text(encoding="utf-8")
TEXT = " ".join(PAGE.split())
SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}
BREAKING = np.pi**2 / (np.pi**2 - 4)


def cells(heading):
    """Rows of the table whose first row begins with a heading, that row first."""
    text = PAGE[PAGE.index(f"| {heading} |") :].split("\n\n")[0]
    rows = [[cell.strip() for cell in line.strip("| ").split("|")] for line in text.splitlines()]
    return [row for row in rows if not set("".join(row)) <= set("-")]


def said(text):
    """The one number that the page has at the group of a pattern, and half a unit of its last digit."""
    ((whole, *_),) = {found if isinstance(found, tuple) else (found,) for found in re.findall(text, TEXT)}
    return number(whole)


def number(text):
    text = text.replace("−", "-").strip("*")
    return pytest.approx(float(text), abs=0.5001 * 10.0 ** -len(text.partition(".")[2]))


@cache
def tables():
    return verdicts_of(SYSTEMS)


def nearest_orbit(system, C):
    roots = symmetric_solutions(system)
    return symmetric_orbit(system, roots[np.abs(roots[:, 2:] - C).max(axis=1).argmin()])


def point_c():
    return min(vi.fixed_points(SYSTEMS["equal"]), key=lambda point: abs(point.C[1] - 1.6771)).C


def test_the_force_at_which_point_b_passes_a_limit():
    limit = 4 / (4 + 2 * 0.35 / (np.pi * 1.65))

    def above(f20):
        return sorted(point.C.min() for point in vi.fixed_points(SYSTEMS["unequal"].with_(f20_hat=f20)))[1] - limit

    assert brentq(above, 0.89, 0.9) == said(r"third at \$\\hat f_\{20\} = ([\d.]+)\$")


def test_point_c_of_the_equal_case():
    """Its distance from the limit, the multiplier of its exact orbit, and the epsilon up to which that is stable."""
    system, C = SYSTEMS["equal"], point_c()

    def lowest(epsilon):
        return half_period_multipliers(nearest_orbit(system.with_(epsilon=epsilon), C)).real.min()

    assert BREAKING - C[1] == said(r"lies ([\d.]+) below the limit")
    assert lowest(0.1) == said(r"half-period multiplier \$(-[\d.]+)\$")
    assert brentq(lambda epsilon: lowest(epsilon) + 1, 1e-3, 5e-3, xtol=1e-9) == said(
        r"only for \$\\varepsilon < ([\d.]+)\$"
    )
    assert nearest_orbit(system, C).C[1] == said(r"its exact orbit has \$C_2 = ([\d.]+)\$")


@pytest.mark.parametrize("case", ["equal", "unequal"])
def test_the_asymmetric_pair(case):
    _, orbits = tables()
    stable = orbits[(orbits["case"] == case) & (orbits["exact"] == "stable")]
    assert len(stable) == 2
    assert not stable["symmetric"].any()
    C1, C2, modulus = re.search(rf"in\s+the {case} case \(\$C = ([\d.]+), ([\d.]+)\$[^)]*?([\d.]+)\)", PAGE).groups()
    for _, orbit in stable.iterrows():
        assert [orbit["C1"], orbit["C2"], orbit["modulus_1"]] == [number(C1), number(C2), number(modulus)]
        assert orbit["fast"] == "stable"


def test_no_symmetric_response_is_stable_and_how_often_the_criteria_are_right():
    points, orbits = tables()
    assert not (orbits["symmetric"] & (orbits["exact"] == "stable")).any()
    both = (points["fast"] == "stable") & (points["slow"] == "stable")
    assert (points["printed_10_26"] == points["exact"]).sum() == 3
    assert (both == (points["exact"] == "stable")).sum() == 6
    assert len(points) == 7
