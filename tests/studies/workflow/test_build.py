"""The build of the studies: jobs after an edit, the figure check, records and the archive."""

import os
import re

import pytest

from archives import archive_of, checkout, commit, unpacked
from vibroimpact_pipeline.result_records import RECORDS

EDITS = [
    ("config/config.yaml", "f20_hat: 0.89", "f20_hat: 0.88", {"companion_branches", "modulation", "claims"}),
    ("config/studies.yaml", "fit_below: 0.005", "fit_below: 0.006", {"companion_epsilon"}),
]


@pytest.mark.thorough
def test_only_what_depends_on_an_edit_is_planned(restudied):
    assert restudied.planned("all", "studies") == set()
    for name, old, new, made in EDITS:
        restudied.edit(name, old, new)
        planned = restudied.planned("studies")
        assert made <= planned
        assert not {"verdict_grid", "companion_10_08", "fig10_06"} & planned
        restudied.edit(name, new, old)
    with open(restudied / "docs/studies/claims.yaml", "a") as file:
        file.write("\n")
    os.utime(restudied / "docs/studies/claims.yaml", (1e9, 1e9))  # as rsync, tar and cp -p leave it
    assert restudied.planned("all", "studies") == {"claims"}


def test_the_figures_are_those_of_the_reference_set(restudied):
    printed = restudied.snakemake("study_check")
    number, passed = re.search(r"(\d+) figures: (\d+) passed", printed).groups()
    assert number == passed


def test_every_result_has_a_record_and_every_record_its_result(studied):
    records = {
        str(path.relative_to(studied / RECORDS)).removesuffix(".json") for path in (studied / RECORDS).rglob("*.json")
    }
    assert [path for path in records if not (studied / path).exists()] == []
    files = (path for folder in ("figures", "regimes") for path in (studied / "results" / folder).rglob("*.*"))
    assert {str(path.relative_to(studied.path)) for path in files} <= records


@pytest.mark.thorough
def test_the_archive_has_both_layers(studied, tmp_path):
    """After an edit, the archive is planned together with the figures that depend on the edit."""
    tree = checkout(studied, tmp_path / "tree")
    tree.snakemake("archive")
    packed = unpacked(archive_of(tree), tmp_path)
    assert all((packed / f"results/{name}").is_file() for name in ("claims.json", "fixed_points.csv"))
    tree.edit("config/studies.yaml", "fit_below: 0.005", "fit_below: 0.006")
    commit(tree.path)
    assert tree.planned("archive") == {"companion_epsilon", "claims", "archive"}
