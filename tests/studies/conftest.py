"""Fixtures of the tests of the studies: the project after both builds."""

import pytest

from pipeline_trees import Tree, made_once, whole_copy


@pytest.fixture(scope="session")
def studied(built, tmp_path_factory) -> Tree:
    """Return the project after both builds; tests must not change it."""
    # The index lists the studies that exist when its build starts.
    return made_once(tmp_path_factory, "studied", lambda path: whole_copy(built, path).snakemake("studies"), "all")


@pytest.fixture
def restudied(studied, tmp_path) -> Tree:
    """Return a copy of the project after both builds, which a test may change."""
    return whole_copy(studied, tmp_path / "tree")
