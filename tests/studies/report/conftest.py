"""The report, built once for all tests."""

from pathlib import Path

import pytest

from pipeline_trees import Tree, made_once, whole_copy


@pytest.fixture(scope="session")
def reported(studied, tmp_path_factory) -> Tree:
    """The project with its studies and its report. Read it, do not change it."""
    return made_once(tmp_path_factory, "reported", lambda path: whole_copy(studied, path), "report")


@pytest.fixture(scope="session")
def site(reported) -> Path:
    return reported / "results/report"
