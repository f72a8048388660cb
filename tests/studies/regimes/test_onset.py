"""Forces with modulated responses along a path: several forces at once, predictions, and ranges counted by hand."""

import numpy as np
import pytest

from vibroimpact.studies.regimes import onset
from vibroimpact.studies.regimes.branches import Path
from vibroimpact.studies.theory.relaxation import relax


def test_several_forces_at_once_give_the_results_of_single_forces(chapter):
    forces = [(0.5, 0.5), (1.0, 1.0), (1.0, 1.4)]
    together = relax(chapter(), 20, 5, forces=forces)
    for k, (f10, f20) in enumerate(forces):
        alone = relax(chapter(f10, f20), 20, 5)
        for quantity in ("share", "largest"):
            np.testing.assert_array_equal(getattr(together, quantity)[k], getattr(alone, quantity))


def test_modulation_is_predicted_for_the_weak_case_and_not_at_a_stable_fixed_point(chapter):
    both = Path(chapter(), ("f10_hat", "f20_hat"))
    assert onset.predicted(both, [0.5, 1.3]).tolist() == [True, False]


@pytest.mark.parametrize(
    ("flags", "ends"), [("01101110", (4, 6)), ("1101", (0, 1)), ("1", (0, 0)), ("000", (np.nan, np.nan))]
)
def test_the_longest_range_is_that_with_most_values(flags, ends):
    values = np.arange(len(flags))
    np.testing.assert_equal(onset.longest_range(values, np.array([flag == "1" for flag in flags])), ends)


def test_one_modulated_start_suffices_and_a_path_in_kappa_has_no_onset(chapter):
    names = ["asymmetric", "strongly modulated", "asymmetric", "quasi-periodic", "chaotic"]
    assert onset.observed([1.0, 2.0, 3.0], [1.0, 1.0, 2.0, 2.0, 3.0], names).tolist() == [True, False, True]
    assert onset.onsets(Path(chapter(), ("kappa",)), [0.5, 0.6], [0.5], ["chaotic"]) == []
