"""Test that config and library contain the parameters of the chapter."""

from chapter import FORCES, PARAMETERS
from pipeline_trees import ROOT
from vibroimpact.system import chapter
from vibroimpact_pipeline.config import read


def test_the_config_has_the_values_of_the_chapter():
    config = read(ROOT / "config/config.yaml")
    assert config["system"] == PARAMETERS
    assert {case: (values["f10_hat"], values["f20_hat"]) for case, values in config["cases"].items()} == FORCES


def test_the_library_has_the_values_of_the_chapter():
    assert chapter.PARAMETERS == PARAMETERS
    assert {case: tuple(forces.values()) for case, forces in chapter.CASES.items()} == FORCES
