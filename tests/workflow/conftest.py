"""Copies of the project that a test may change."""

import shutil

import pytest

from pipeline_trees import ROOT, Tree, copied


@pytest.fixture
def tree(tmp_path) -> Tree:
    """The project before a build."""
    return copied(ROOT, tmp_path / "tree")


@pytest.fixture
def rebuilt(built, tmp_path) -> Tree:
    """A built tree that a test may change."""
    shutil.copytree(built.path, tmp_path / "tree", symlinks=True, ignore=shutil.ignore_patterns("locks"))
    return Tree(tmp_path / "tree")
