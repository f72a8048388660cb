"""Companion figures: numbers against theory recomputed here, lines and markers as captions say, fit for print."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from verdict_tables import verdicts_of
from vibroimpact.accuracy.verdict_table import NO_ORBIT, fixed_point_rows, orbit_rows
from vibroimpact.studies.figures import companion_10_05, companion_stability

SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}
BREAKING = np.pi**2 / (np.pi**2 - 4)


def test_without_orbits_fixed_points_are_left_without_multipliers():
    system = SYSTEMS["weak"]
    rows = fixed_point_rows("weak", system, vi.fixed_points(system), orbit_rows("weak", []))
    assert rows[["orbit", "exact"]].to_numpy().tolist() == [["", NO_ORBIT]]
    companion_stability.draw(companion_stability.compute(rows))


def test_limits_over_kappa():
    found = companion_10_05.compute((0.5, 2.2))
    rows = {series: line[["kappa", "C"]].to_numpy().T for series, line in found["csv"].groupby("series")}
    expected = {"fold": lambda rho: 1 / (1 + rho**2), "symmetry breaking": lambda rho: BREAKING + 0 * rho}
    expected["printed"] = lambda rho: 4 / (4 + np.pi * rho)
    for series, (kappa, C) in rows.items():
        rho = 2 * (1 - kappa) / (np.pi * (1 + kappa))
        if series in expected:
            np.testing.assert_allclose(C, expected[series](rho), rtol=1e-13)
            continue
        # |W| <= 1 just inside, not just outside, by sampling a flight of (10.10).
        t = np.linspace(0, np.pi, 20001)[:, None]
        for factor, within in ((0.999, True), (1.001, False)):
            x = factor * C
            W = (1 - x) * np.cos(t) + rho * x * np.sin(t) + x * (1 - 2 * t / np.pi)
            assert ((W.max(axis=0) <= 1 + 1e-9) == within)[1:-1:8].all()
    assert len(rows) == 4
    outline = found["outline"]["C"]
    assert [outline.min(), outline.max()] == pytest.approx([rows["fold"][1].min(), BREAKING])


@pytest.mark.parametrize("C_range", [(0.7, 2.0), (0.5, 1.6)])
def test_a_range_that_cuts_the_region_is_refused(C_range):
    with pytest.raises(ValueError, match=r"^C_range: "):
        companion_10_05.compute(C_range)


def test_every_verdict_on_a_fixed_point_is_a_dot_filled_where_it_says_stable():
    points, _ = verdicts_of(SYSTEMS)
    columns = [*companion_stability.CRITERIA]
    axes = companion_stability.draw(companion_stability.compute(points)).axes[0]
    dots = {(line.get_xdata()[0], line.get_ydata()[0]): line.get_markerfacecolor() for line in axes.lines}
    assert len(dots) == 7 * 4
    for (x, y), face in dots.items():
        assert face == ("black" if points[columns[x]].iloc[y] == "stable" else "white")
    assert axes.get_yticklabels()[2].get_text() == "equal (c)"
