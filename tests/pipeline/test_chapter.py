"""The config and the library hold the chapter's numbers."""

from chapter import FORCES, PARAMETERS
from pipeline_trees import ROOT
from vibroimpact.system import chapter
from vibroimpact_pipeline.config import read
from vibroimpact_pipeline.studies.claims_config import digest, unlike


def test_the_config_is_the_chapters():
    config = read(ROOT / "config/config.yaml")
    assert config["system"] == PARAMETERS
    assert {case: (values["f10_hat"], values["f20_hat"]) for case, values in config["cases"].items()} == FORCES


def test_the_library_has_the_chapters():
    assert chapter.PARAMETERS == PARAMETERS
    assert {case: tuple(forces.values()) for case, forces in chapter.CASES.items()} == FORCES


def test_what_differs_from_the_chapter_is_named_by_the_part_of_the_evidence():
    config = read(ROOT / "config/config.yaml")
    seen = {"sweeps.design": digest(config["sweeps"]["design"])}
    assert unlike(config, seen) == {}
    config["cases"]["weak"]["f10_hat"] = 0.6
    config["sweeps"]["design"]["starts"] = 9
    del config["cases"]["unequal"]
    found = unlike(config, seen)
    assert found.keys() == {"weak", "unequal", "absorber"}
    assert found["weak"] == "cases.weak.f10_hat is 0.6, not 0.5"
    config["system"]["kappa"] = 0.7
    assert "system" in unlike(config, seen)
