"""Fixture of an archive, which is made once."""

import pytest

from archives import checkout
from pipeline_trees import Tree, made_once


@pytest.fixture(scope="session")
def archived(alone, tmp_path_factory) -> Tree:
    """Return the built chapter as a git checkout with its archive. Tests may read it, but must not change it."""
    return made_once(tmp_path_factory, "archived", lambda path: checkout(alone, path), "archive")
