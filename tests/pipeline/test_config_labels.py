"""Labels of fixed points are solved for once, and again when something that decides on them has changed."""

import pytest
from vibroimpact_pipeline.config.labels import remembered

from configs import GOOD
from vibroimpact_pipeline.config import case_parameters, labels

EQUAL, WEAK = (case_parameters(GOOD, case) for case in ("equal", "weak"))


@pytest.fixture
def solved(monkeypatch):
    """The parameters that were solved for."""
    asked = []

    def solve(parameters):
        asked.append(parameters)
        return ["a"]

    monkeypatch.setattr(labels, "labels", solve)
    return asked


def test_the_labels_are_those_of_the_chapter():
    assert labels.labels(EQUAL) == ["a", "b", "c"]
    assert labels.labels(WEAK) == ["a"]


def test_each_system_is_solved_once(solved, tmp_path):
    for _ in range(2):
        look_up = remembered(tmp_path / "cache/labels.json", "one")
        assert look_up(EQUAL) == look_up(WEAK) == look_up(dict(reversed(EQUAL.items()))) == ["a"]
    assert solved == [EQUAL, WEAK]


def test_another_version_solves_anew(solved, tmp_path):
    for version in ("one", "two"):
        remembered(tmp_path / "labels.json", version)(EQUAL)
    assert solved == [EQUAL, EQUAL]


@pytest.mark.parametrize("text", ["", "{", "[]", "3", '{"version": "one"}'])
def test_a_damaged_file_does_no_harm(solved, tmp_path, text):
    path = tmp_path / "labels.json"
    path.write_text(text)
    assert remembered(path, "one")(EQUAL) == ["a"]
    assert remembered(path, "one")(EQUAL) == ["a"]
    assert solved == [EQUAL]
