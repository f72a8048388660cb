"""Which part of the evidence of the claims is for other parameters than the chapter's."""

import copy

from configs import GOOD
from vibroimpact_pipeline.studies.claims_config import departures_by_part, digest


def test_what_differs_from_the_chapter_is_named_by_the_part_of_the_evidence():
    config = copy.deepcopy(GOOD)
    seen = {"sweeps.design": digest(config["sweeps"]["design"])}
    assert departures_by_part(config, seen) == {}
    config["cases"]["weak"]["f10_hat"] = 0.6
    config["sweeps"]["design"]["starts"] = 9
    del config["cases"]["unequal"]
    found = departures_by_part(config, seen)
    assert found.keys() == {"weak", "unequal", "absorber"}
    assert found["weak"] == "cases.weak.f10_hat is 0.6 instead of 0.5"
    config["system"]["kappa"] = 0.7
    assert "system" in departures_by_part(config, seen)
