"""Compiled code for the tests, kept in the checkout apart for each state of its sources; the project, built once."""

import os
import sys

import pytest

from pipeline_trees import ROOT, Tree, copied, made_once

sys.path.append(str(ROOT / "workflow/scripts"))

from environment import settle
from vibroimpact.checks.sources import Sources

settle(ROOT, Sources())
os.environ.pop("PYTHONPATH", None)


def pytest_addoption(parser):
    parser.addoption("--attack", type=int, default=80, help="runs of each attack on the certificate")


@pytest.fixture(scope="session")
def built(tmp_path_factory) -> Tree:
    """The project after a build. Read it, do not change it."""
    return made_once(tmp_path_factory, "built", lambda path: copied(ROOT, path))
