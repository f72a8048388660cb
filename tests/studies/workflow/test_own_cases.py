"""A config with other cases works in the studies and in the report."""

import json

import pytest

from own_cases import OWN_FIGURES, edit, own, renamed, single

CONFIG, STUDIES = "config/config.yaml", "config/studies.yaml"


def hurried(config):
    """Return the config with few starts, cycles and values for the exact system, and another name of a case."""
    regimes = config["regimes"]
    regimes["branches"] |= {"paths": [{"along": ["f20_hat"], "range": [0.9, 1.0]}], "seeds": 1}
    regimes["branches"]["attractors"] |= {"values": 3, "starts": 2}
    regimes["modulation"] |= {"starts": 2, "cycles": 60, "blocks": 2, "windows": [60]}
    regimes["basins"]["points"] = 5
    regimes["epsilon"]["values"] = 5  # three of the values are small, so that the order has an uncertainty
    return renamed(config, "unequal", "uneven")


@pytest.mark.thorough
def test_the_report_shows_own_cases_and_figures_and_claims_are_not_judged(restudied):
    edit(restudied, CONFIG, own)
    edit(restudied, STUDIES, hurried)
    restudied.snakemake("report")
    results = restudied / "results"
    for figure in OWN_FIGURES:
        assert figure in (results / "report/figures.html").read_text(encoding="utf-8")
    assert "Simulated motion of case A b" in (results / "report/figures.html").read_text(encoding="utf-8")

    claims = json.loads((results / "claims.json").read_text(encoding="utf-8"))
    assert {(claim["verdict"], claim["reason"]) for claim in claims} == {("not judged", "cases.unequal is missing")}
    reasons = ["cases.unequal is missing", "cases.weak is missing"]
    for page in results.glob("report/*.html"):
        text = page.read_text(encoding="utf-8")
        assert page.name == "search.html" or all(reason in text for reason in reasons), page  # made by Sphinx


def test_a_single_case_of_another_name_is_planned_up_to_the_report(restudied):
    edit(restudied, CONFIG, single)
    rules = restudied.planned("all", "studies", "report", "study_check")
    assert {"fig10_06", "companion_branches", "claims", "report"} <= rules
    assert not {"fig10_09", "companion_horizon"} & rules
