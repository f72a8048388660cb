"""Trees that a test may change: the project with two figures, one read from a table that another job wrote."""

import shutil

import pytest

from pipeline_trees import ROOT, Tree, copied, made_once

FIGURES = "fig10_06", "companion_10_04"


@pytest.fixture
def tree(tmp_path) -> Tree:
    """The project before a build."""
    return copied(ROOT, tmp_path / "tree")


@pytest.fixture
def drawn(tmp_path, tmp_path_factory) -> Tree:
    """The project with figure 10.6, the fixed points that it shows, and the companion of 10.4."""
    made = made_once(tmp_path_factory, "drawn", lambda path: copied(ROOT, path), *FIGURES)
    shutil.copytree(made.path, tmp_path / "tree", symlinks=True)
    return Tree(tmp_path / "tree")
