"""An archive, made once."""

import pytest

from archives import checkout
from pipeline_trees import Tree, made_once


@pytest.fixture(scope="session")
def archived(alone, tmp_path_factory) -> Tree:
    """The built chapter as a git checkout, with its archive. Read it, do not change it."""
    return made_once(tmp_path_factory, "archived", lambda path: checkout(alone, path), "archive")
