"""Companion figures: numbers against theory recomputed here, lines and markers as captions say, fit for print."""

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from verdict_tables import verdicts_of
from vibroimpact.accuracy.verdict_table import NO_ORBIT, fixed_point_rows, orbit_rows
from vibroimpact.exact.orbits.search import half_period_multipliers, orbits
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.studies.figures import companion_10_05, companion_stability

SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}
BREAKING = np.pi**2 / (np.pi**2 - 4)


@pytest.fixture(scope="module")
def verdict_tables():
    return verdicts_of(SYSTEMS)


@pytest.fixture(scope="module")
def tables(verdict_tables):
    return {
        "companion_10_05": companion_10_05.compute((0.5, 2.2)),
        "companion_stability": companion_stability.compute(verdict_tables[0]),
    }


# The tables of verdicts


def test_each_fixed_point_goes_with_the_orbit_that_continues_it(verdict_tables):
    """Followed from small epsilon in steps, instead of taking the nearest at once."""
    points, exact = verdict_tables
    for _, row in points.iterrows():
        C = row[["C1", "C2"]].to_numpy(float)
        for epsilon in np.linspace(0.002, 0.1, 50):
            listed = symmetric_solutions(SYSTEMS[row["case"]].with_(epsilon=epsilon))[:, 2:]
            step = np.abs(listed - C).max(axis=1)
            assert step.min() < 0.01
            C = listed[step.argmin()]
        found = exact[(exact["case"] == row["case"]) & (exact["label"] == row["orbit"])]
        np.testing.assert_allclose(found[["C1", "C2"]].to_numpy()[0], C, atol=1e-8)
        assert row["exact"] == found["exact"].iloc[0]


def test_what_is_true_of_the_chapter_s_responses(verdict_tables):
    """No symmetric response of the three cases is stable at epsilon = 0.1; one asymmetric pair is, in two of them."""
    points, exact = verdict_tables
    assert set(points["exact"]) == {"unstable"}
    stable = exact[exact["exact"] == "stable"]
    assert not stable["symmetric"].any()
    assert stable.groupby("case").size().to_dict() == {"equal": 2, "unequal": 2}
    assert stable["admissible"].all()


def test_point_c_of_the_equal_case_breaks_symmetry_though_the_theory_calls_it_stable(verdict_tables):
    points, exact = verdict_tables
    (c,) = points[(points["case"] == "equal") & (points["label"] == "c")].to_dict("records")
    assert (c["printed_10_26"], c["fast"], c["slow"]) == ("stable",) * 3
    place = exact[exact["case"] == "equal"]["label"].tolist().index(c["orbit"])
    half = half_period_multipliers(orbits(SYSTEMS["equal"])[place])
    outside = half[np.abs(half) > 1]
    assert len(outside) == 1
    assert outside[0].real < -1.5
    small = SYSTEMS["equal"].with_(epsilon=0.002)
    nearest = min((o for o in orbits(small) if o.symmetric), key=lambda o: np.abs(o.C - [c["C1"], c["C2"]]).max())
    assert np.abs(nearest.multipliers).max() < 1


def test_without_orbits_fixed_points_are_left_without_multipliers(verdict_tables):
    system = SYSTEMS["weak"]
    nothing = orbit_rows("weak", [])
    (row,) = fixed_point_rows("weak", system, zip("a", vi.fixed_points(system), strict=True), nothing).to_dict(
        "records"
    )
    assert (row["orbit"], row["exact"]) == ("", NO_ORBIT)
    companion_stability.draw(companion_stability.compute(pd.DataFrame([row])))


def test_no_two_fixed_points_share_an_orbit(verdict_tables):
    points, _ = verdict_tables
    assert not points[["case", "orbit"]].duplicated().any()


# Numbers


def test_limits_over_kappa(tables):
    table, outline = tables["companion_10_05"]["csv"], tables["companion_10_05"]["outline"]
    rows = dict(iter(table.groupby("series")))
    for series, line in rows.items():
        kappa, C = line["kappa"].to_numpy(), line["C"].to_numpy()
        rho = 2 * (1 - kappa) / (np.pi * (1 + kappa))
        expected = {"fold": 1 / (1 + rho**2), "symmetry breaking": BREAKING, "printed": 4 / (4 + np.pi * rho)}
        if series in expected:
            np.testing.assert_allclose(C, expected[series], rtol=1e-13)
            assert len(kappa) == 401
        else:
            # |W| <= 1 just inside, not just outside, by sampling a flight of (10.10).
            t = np.linspace(0, np.pi, 20001)
            for k, r, c in zip(kappa[1::8], rho[1::8], C[1::8], strict=True):
                for factor, within in ((0.999, True), (1.001, False)):
                    x = factor * c
                    W = (1 - x) * np.cos(t) + r * x * np.sin(t) + x * (1 - 2 * t / np.pi)
                    assert (W.max() <= 1 + 1e-9) == within, k
            assert C.max() <= 2.2
    assert outline["C"].max() == pytest.approx(BREAKING)
    assert outline["C"].min() == pytest.approx(rows["fold"]["C"].min())


@pytest.mark.parametrize("C_range", [(0.7, 2.0), (0.5, 1.6)])
def test_a_range_that_cuts_the_region_is_refused(C_range):
    with pytest.raises(ValueError, match=r"^C_range: "):
        companion_10_05.compute(C_range)


def test_every_verdict_on_a_fixed_point_is_a_dot_filled_where_it_says_stable(tables, verdict_tables):
    points, _ = verdict_tables
    table = tables["companion_stability"]
    columns = [*companion_stability.CRITERIA]
    assert table[columns].to_numpy().tolist() == points[columns].to_numpy().tolist()
    axes = companion_stability.draw(table).axes[0]
    dots = {(line.get_xdata()[0], line.get_ydata()[0]): line.get_markerfacecolor() for line in axes.lines}
    assert len(dots) == 7 * 4
    for (x, y), face in dots.items():
        assert face == ("black" if points[columns[x]].iloc[y] == "stable" else "white")
    assert axes.get_yticklabels()[2].get_text() == "equal (c)"
