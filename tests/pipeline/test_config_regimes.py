"""Bad settings of the regimes, each with the line that the user reads."""

import copy
from dataclasses import fields

import pytest

from pipeline_trees import ROOT
from vibroimpact.system import System
from vibroimpact_pipeline.config import parse, problems
from vibroimpact_pipeline.config.system import NAMES


def problems_with(path, value):
    config = copy.deepcopy(parse((ROOT / "config/config.yaml").read_text()))
    *parents, key = path
    place = config["regimes"]
    for parent in parents:
        place = place[parent]
    place[key] = value
    return problems(config)


@pytest.mark.parametrize(
    ("path", "value", "where"),
    [
        (("branches", "case"), "uneqal", "regimes.branches.case"),
        (("basins", "case"), "none", "regimes.basins.case"),
        (("epsilon", "mixed", "case"), "none", "regimes.epsilon.mixed.case"),
        (("branches", "paths", 0, "along"), ["f20"], "regimes.branches.paths[0].along[0]"),
        (("coexistence", "case"), "none", "regimes.coexistence.case"),
        (("observation", "blocks"), 1, "regimes.observation.blocks"),
        (("observation", "retest"), 0, "regimes.observation.retest"),
        (("map", "points"), 1, "regimes.map.points"),
        (("map", "tiles"), 0, "regimes.map.tiles"),
        (("observation", "nearness"), 0, "regimes.observation.nearness"),
        (("basins", "colour"), 1, "regimes.basins.colour"),
    ],
)
def test_a_bad_setting_is_named(path, value, where):
    assert [place for place, _ in problems_with(path, value)] == [where]


def test_a_path_may_lead_along_every_parameter():
    assert list(NAMES) == [field.name for field in fields(System)]
    assert problems_with(("branches", "paths", 0), {"along": ["kappa", "epsilon"], "range": [0.1, 0.5]}) == []
