"""Copies of the project that a test may change."""

import pytest

from archives import checkout
from pipeline_trees import ROOT, Tree, copied, made_once, whole_copy

FIGURES = "companion_10_08", "companion_10_05"
"""One that reads tables of jobs before it, and one that reads none."""


@pytest.fixture
def tree(tmp_path) -> Tree:
    """The project before a build."""
    return copied(ROOT, tmp_path / "tree")


@pytest.fixture
def drawn(tmp_path, tmp_path_factory) -> Tree:
    """The project with two figures and what they need."""
    made = made_once(tmp_path_factory, "drawn", lambda path: copied(ROOT, path), *FIGURES)
    return whole_copy(made, tmp_path / "tree")


@pytest.fixture
def rebuilt(built, tmp_path) -> Tree:
    """A built tree that a test may change."""
    return whole_copy(built, tmp_path / "tree")


@pytest.fixture(scope="session")
def archived(built, tmp_path_factory) -> Tree:
    """The built project as a git checkout, with its archive. Read it, do not change it."""
    return made_once(tmp_path_factory, "archived", lambda path: checkout(built, path), "archive")
