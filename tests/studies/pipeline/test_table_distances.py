"""The published tables of the studies, changed: what the figure check notices."""

import pytest

from published_tables import differs, kinds_used, tables_in, unnoticed
from vibroimpact_pipeline.figure_check.table_distances import KINDS

STANDARD_ERRORS = {"companion_epsilon.orders": ["uncertainty"]}
"""Of fits to errors: their digits are those of rounding."""


@pytest.mark.parametrize("name", tables_in("figures/studies"))
def test_one_number_off_by_a_per_cent_fails(name):
    assert unnoticed(name, STANDARD_ERRORS.get(name, ())) == []


def test_every_kind_is_used():
    assert kinds_used() == set(KINDS)


@pytest.mark.parametrize(
    "regimes",
    [[one] for one in ("symmetric", "hopping", "quasi-periodic", "unsettled", "no impacts")]
    + [["symmetric", "hopping", "quasi-periodic", "unsettled", "no impacts"]],
)
def test_a_regime_that_vanishes_from_the_map_fails(regimes):
    assert differs("companion_regime_map", lambda table: table.assign(**dict.fromkeys(regimes, 0.0)))
    if regimes[0] != "no impacts":
        words = dict.fromkeys(regimes, "chaotic")
        assert differs("companion_regime_map", lambda table: table.assign(regime=table["regime"].replace(words)))


@pytest.mark.parametrize("factor", [1.19, 1 / 1.19])
@pytest.mark.parametrize("name", ["companion_absorber", "companion_absorber.summary", "companion_response"])
def test_balls_that_are_a_fifth_worse_or_better_fail(name, factor):
    column = "value" if name.endswith("summary") else "ratio"

    def changed(table):
        balls = table.iloc[:, :2].isin(["balls", "lowest peak"]).any(axis=1) | (column == "ratio")
        table.loc[balls, column] *= factor
        return table

    assert differs(name, changed)


@pytest.mark.parametrize(("by", "caught"), [(1e-16, False), (3.8e-16, False), (1e-6, True)])
def test_a_value_next_to_zero_is_held_to_an_absolute_floor(by, caught):
    def changed(table):
        row = table["C1"].abs().idxmin()
        assert abs(table.loc[row, "C1"]) < 1e-15
        table.loc[row, "C1"] += by
        return table

    assert differs("companion_branches.special_points", changed) == caught


@pytest.mark.parametrize(("decades", "caught"), [(0.00094, False), (0.05, True)])
def test_an_error_of_a_few_billionths_moves_by_what_roots_are_rounded_to(decades, caught):
    def changed(table):
        row = (table["error"] - 4.6e-9).abs().idxmin()
        assert table.loc[row, "error"] == pytest.approx(4.6e-9, rel=0.01)
        table.loc[row, "error"] *= 10**decades
        return table

    assert differs("companion_epsilon", changed) == caught


def worse_arithmetic(table):
    return table.assign(error=table["error"].where(table["series"] != "measured", 30 * table["error"]))


def moved_attractors(table):
    return table.assign(C2=0.8 * table["C2"])


def nearly_same_attractors(table):
    return table.assign(C2=1.0005 * table["C2"])


def other_ends(cells):
    def change(table):
        chosen = table.index[:cells]
        return table.assign(label=table["label"].where(~table.index.isin(chosen), "symmetric"))

    return change


@pytest.mark.parametrize(
    ("name", "change", "caught"),
    [
        ("companion_horizon", worse_arithmetic, True),
        ("companion_branches.attractors", moved_attractors, True),
        ("companion_branches.attractors", nearly_same_attractors, False),  # not told from another rounding
        ("companion_basins", other_ends(1), False),
        ("companion_basins", other_ends(60), True),
    ],
)
def test_chaotic_numbers_are_held_to_what_rounding_may_move(name, change, caught):
    assert differs(name, change) == caught
