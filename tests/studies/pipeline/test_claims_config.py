"""Test for which configs the claims of the chapter are judged."""

import pytest

from configs import GOOD, edited
from vibroimpact_pipeline.config import checked
from vibroimpact_pipeline.studies.claims_config import reason_not_judged


@pytest.mark.parametrize(
    ("edit", "reason"),
    [
        ("cases.weak.f10_hat = 0.6", "cases.weak.f10_hat is 0.6 instead of 0.5"),
        ("cases.unequal = ...", "cases.unequal is missing"),
        ("system.kappa = 0.7", "system.kappa is 0.7 instead of 0.65"),
        ("regimes.modulation.starts = 4", "simulations, stability.verdict_grid or regimes differ from"),
        ("cases.equal.simulation.window_cycles = 7", "simulations, stability.verdict_grid or regimes differ from"),
        ("cases.unequal.simulation.window_cycles = 7", ""),  # no claim depends on it
        ("sweeps.design.starts = 9", ""),
    ],
)
def test_claims_are_judged_only_with_the_parameters_of_the_chapter(edit, reason):
    assert reason_not_judged(checked(GOOD)) == ""
    found = reason_not_judged(edited(edit))
    assert found.startswith(reason) if reason else found == ""
