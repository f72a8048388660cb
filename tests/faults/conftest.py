"""Trees that a test may change."""

import pytest

from pipeline_trees import ROOT, Tree, copied


@pytest.fixture
def tree(tmp_path) -> Tree:
    """The project before a build."""
    return copied(ROOT, tmp_path / "tree")
