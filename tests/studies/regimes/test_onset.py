"""Where modulated responses are along a path: all forces at once as one by one, ranges counted by hand."""

import numpy as np
import pytest

from vibroimpact.studies.regimes import onset
from vibroimpact.studies.regimes.branches import Path
from vibroimpact.studies.theory.relaxation import relax


def test_forces_followed_at_once_are_those_followed_one_by_one(chapter):
    forces = [(0.5, 0.5), (1.0, 1.0), (1.0, 1.4)]
    together = relax(chapter(), 20, 5, forces=forces)
    for k, (f10, f20) in enumerate(forces):
        alone = relax(chapter(f10, f20), 20, 5)
        for quantity in ("share", "largest"):
            np.testing.assert_array_equal(getattr(together, quantity)[k], getattr(alone, quantity))


def test_the_slow_flow_modulates_the_weak_case_and_not_where_a_stable_point_holds_both_balls(chapter):
    both = Path(chapter(), ("f10_hat", "f20_hat"))
    assert onset.predicted(both, [0.5, 1.3]).tolist() == [True, False]


@pytest.mark.parametrize(
    ("flags", "ends"), [("01101110", (4, 6)), ("1101", (0, 1)), ("1", (0, 0)), ("000", (np.nan, np.nan))]
)
def test_the_longest_range_is_that_with_most_values(flags, ends):
    values = np.arange(len(flags))
    np.testing.assert_equal(onset.longest_range(values, np.array([flag == "1" for flag in flags])), ends)


def test_a_start_is_enough_and_other_paths_have_no_onset(chapter):
    names = ["asymmetric", "strongly modulated", "asymmetric", "quasi-periodic", "chaotic"]
    assert onset.observed([1.0, 2.0, 3.0], [1.0, 1.0, 2.0, 2.0, 3.0], names).tolist() == [True, False, True]
    assert onset.onsets(Path(chapter(), ("kappa",)), [0.5, 0.6], [0.5], ["chaotic"]) == []
