"""Fixtures of the tests of the report, which is built once."""

from pathlib import Path

import pytest

from pipeline_trees import Tree, made_once, whole_copy


@pytest.fixture(scope="session")
def reported(studied, tmp_path_factory) -> Tree:
    """Return the project with its studies and its report; tests must not change it."""
    return made_once(tmp_path_factory, "reported", lambda path: whole_copy(studied, path), "report")


@pytest.fixture(scope="session")
def site(reported) -> Path:
    """Return the folder of the report."""
    return reported / "results/report"
