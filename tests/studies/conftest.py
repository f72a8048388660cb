"""The project with its studies, built once."""

import pytest

from pipeline_trees import Tree, made_once, whole_copy


@pytest.fixture(scope="session")
def studied(built, tmp_path_factory) -> Tree:
    """The project after both builds. Read it, do not change it."""
    # The index lists the studies that are there when its build begins.
    return made_once(tmp_path_factory, "studied", lambda path: whole_copy(built, path).snakemake("studies"), "all")


@pytest.fixture
def restudied(studied, tmp_path) -> Tree:
    """The same, which a test may change."""
    return whole_copy(studied, tmp_path / "tree")
