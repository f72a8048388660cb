"""The report, built once for all tests, and a browser to read it in."""

from pathlib import Path

import pytest
import yaml

from headless_browser import Browser, executable
from pipeline_trees import ROOT, Tree, made_once, whole_copy

SETTINGS = yaml.safe_load((ROOT / "report/report.yaml").read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def reported(studied, tmp_path_factory) -> Tree:
    """The project with its studies and its report. Read it, do not change it."""
    return made_once(tmp_path_factory, "reported", lambda path: whole_copy(studied, path), "report")


@pytest.fixture(scope="session")
def site(reported) -> Path:
    return reported / "results/report"


@pytest.fixture(scope="module")
def browser():
    """For a module, no longer: while it runs, nobody else in this process can run an event loop, as notebooks do."""
    path = executable()
    if path is None:
        pytest.skip("the report was not opened in a browser: there is no Chromium here (Debian: apt install chromium)")
    browser = Browser(path)
    yield browser
    browser.close()
