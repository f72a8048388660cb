"""How far tables are apart: each measure on numbers whose distance is known."""

import numpy as np
import pytest
from scipy.stats import ks_2samp, ttest_ind

from vibroimpact.figures.kit.tables import curve, join
from vibroimpact_pipeline.figure_check.tables import MEASURES, Rules, differences_in_structure, distances

SIZE = Rules({"value": "kind"}, {"kind": {"size": 8.0}})
RANDOM = np.random.default_rng(5)


def apart(measure, old, new):
    """Distance of a column between tables of one series."""
    rules = Rules({"value": "kind"}, {"kind": {measure: 1.0}})
    old, new = (curve("a", "s", value=values) for values in (old, new))
    assert differences_in_structure(old, new, rules) == []
    (found,) = distances(old, new, rules)
    return found


@pytest.mark.parametrize("measure", MEASURES)
def test_the_same_is_no_distance_away(measure):
    assert apart(measure, [1.0, 2.0, 4.0], [1.0, 2.0, 4.0]).distance == 0


def test_the_largest_distance_is_a_share_of_the_axis():
    assert apart("largest", [0.0, 2.0, 4.0], [0.0, 2.5, 4.1]).distance == pytest.approx(0.125)


def test_infinity_is_a_place_and_no_axis():
    assert apart("largest", [0.0, 4.0, np.inf], [1.0, 4.0, np.inf]).distance == pytest.approx(0.25)
    assert apart("largest", [0.0, 4.0, np.inf], [0.0, 4.0, 4.0]).distance == np.inf


def test_decades_are_counted_down_to_the_floor():
    assert apart("decades", [1e-3, 1e-9], [1e-3, 1e-7]).distance == pytest.approx(2)
    assert apart("decades", [1e-3, 0.0], [1e-3, 1e-18]).distance == 0


def test_rows_that_differ_are_counted_whatever_their_distance():
    found = apart("part of rows", [0.0, 1.0, 2.0, 3.0], [0.0, 1.0 + 1e-9, 5.0, 3.5])
    assert found.distance == 0.5
    assert found.row == "a, s, row 3"


def test_outcomes_are_texts_that_may_differ_and_others_may_not():
    old = join([curve("a", "s", label=["one", "two", "two", "two"], value=np.arange(4.0))])
    new = old.assign(label=["one", "one", "two", "two"])
    rules = Rules({"label": "outcome", "value": "x"}, {"outcome": {"part of rows": 1.0}, "x": {"largest": 1.0}})
    found = {entry.column: entry for entry in distances(old, new, rules)}
    assert (found["label"].distance, found["label"].reference, found["label"].new) == (0.25, "two", "one")
    named = Rules({"value": "x"}, {"x": {"largest": 1.0}})
    assert differences_in_structure(old, new, named) == [
        "a, s, one: 2 rows instead of 1",
        "a, s, two: 2 rows instead of 3",
    ]


def test_samples_are_compared_as_by_kolmogorov_and_smirnov():
    old, new = RANDOM.normal(size=300), RANDOM.normal(0.4, size=250)
    expected = ks_2samp(old, new).statistic * np.sqrt(300 * 250 / 550)
    assert apart("distribution", old, new).distance == pytest.approx(expected)


def test_samples_of_one_distribution_are_near_and_rounding_of_equal_values_is_nothing():
    draws = [apart("distribution", *RANDOM.exponential(size=(2, 400))).distance for _ in range(50)]
    assert max(draws) < 2.2
    equal = np.append(np.ones(40), 5.0)
    assert apart("distribution", equal, equal + RANDOM.normal(0, 1e-12, 41)).distance == 0


def test_sizes_of_samples_differ_in_units_of_their_standard_deviation():
    old = RANDOM.normal(size=2000)
    found = distances(*(curve("a", "s", value=values) for values in (old, old[::4])), SIZE)
    assert [entry.distance for entry in found] == [pytest.approx(1500 / np.sqrt(2500))]


def test_a_shift_of_all_decades_is_told_from_scatter():
    old = 10.0 ** RANDOM.uniform(-9, -3, size=101)
    scatter = old * 10.0 ** RANDOM.uniform(-1, 1, size=101)
    assert apart("middle of decades", old, 1000 * old).distance == pytest.approx(3)
    assert apart("middle of decades", old, scatter).distance < 0.5 < apart("decades", old, scatter).distance


def test_the_same_is_asked_of_numbers_and_of_texts():
    old = curve("a", "s", value=[0.0, 1.0, 2.0]).assign(label=["one", "two", "two"])
    rules = Rules({"value": "x", "label": "x"}, {"x": {"same": 1e-9}})
    new = old.assign(value=[0.0, 1.0, 2.001], label=["one", "two", "one"])
    assert [entry.distance for entry in distances(old, new, rules)] == [pytest.approx(5e-4), pytest.approx(1 / 3)]


def test_means_differ_in_units_of_their_standard_error():
    old, new = RANDOM.normal(size=17), RANDOM.normal(0.5, size=17)
    expected = abs(ttest_ind(old, new, equal_var=False).statistic)
    assert apart("mean", old, new).distance == pytest.approx(expected, rel=1e-4)


def test_a_series_has_rules_of_its_own():
    old = join([curve("a", "line", value=[0.0, 1.0]), curve("a", "dots", value=[0.2, 0.4, 0.6])])
    new = join([curve("a", "line", value=[0.0, 1.0]), curve("a", "dots", value=[0.3, 0.5])])
    rules = Rules(
        {"value": {"dots": "sample", "others": "x"}}, {"x": {"largest": 1.0}, "sample": {"distribution": 1.0}}
    )
    assert differences_in_structure(old, new, rules) == []
    assert {entry.kind: entry.distance == 0 for entry in distances(old, new, rules)} == {"x": True, "sample": False}
    gone = new[new["series"] == "line"]
    assert differences_in_structure(old, gone, rules) == ["a, dots: no rows instead of 3"]


def test_a_column_without_a_rule_is_named():
    table = curve("a", "s", value=[1.0], other=[2.0])
    assert [entry.kind for entry in distances(table, table, Rules({"value": "x"}, {"x": {"largest": 1.0}}))] == [
        "x",
        None,
    ]
