"""The report, built once for all tests, and a browser to read it in."""

import fcntl
import importlib.util
import os
import shutil
import sys
from pathlib import Path

import pytest
import yaml

HERE = Path(__file__).parent
sys.path.append(str(HERE))

from headless_browser import Browser, executable  # noqa: E402

ROOT = HERE.parents[1]
SETTINGS = yaml.safe_load((ROOT / "report/report.yaml").read_text(encoding="utf-8"))

_spec = importlib.util.spec_from_file_location("pipeline_trees", HERE.parent / "workflow/conftest.py")
_trees = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(_trees)
built = _trees.built


@pytest.fixture(scope="session")
def reported(built, tmp_path_factory):
    """The built project with its report. Read it, do not change it."""
    shared = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        shared = shared.parent
    with open(shared / "reported.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (shared / "reported").exists():
            shutil.copytree(built.path, shared / "reported", symlinks=True)
        tree = _trees.Tree(shared / "reported")
        tree.snakemake("report")
    return tree


@pytest.fixture(scope="session")
def site(reported) -> Path:
    return reported / "results/report"


@pytest.fixture(scope="session")
def browser(tmp_path_factory):
    path = executable()
    if path is None:
        pytest.skip("the report was not opened in a browser: there is no Chromium here (Debian: apt install chromium)")
    browser = Browser(path, tmp_path_factory.mktemp("profile"))
    yield browser
    browser.close()
