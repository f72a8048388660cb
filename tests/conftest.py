"""Settings of all tests, and fixtures with copies and builds of the project."""

import gc
import os

import pytest
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers

import vibroimpact_pipeline  # noqa: F401 (sets the environment)
from pipeline_trees import ROOT, Tree, copied, made_once, whole_copy, with_results, without_studies

os.environ["PYTHONPATH"] = str(ROOT / "src")

UNTIMED = dict(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("same", derandomize=True, **UNTIMED)
settings.register_profile("explore", print_blob=True, **UNTIMED)
settings.load_profile("same")
# Hypothesis mixes constants of the modules loaded so far into its examples, which then depend on the order of tests.
providers._get_local_constants = providers.Constants


gc.set_threshold(100_000, 50, 50)  # faster; no test depends on early collection


def pytest_addoption(parser):
    parser.addoption("--attack", type=int, default=80, help="runs of each attack on the certificate")


def pytest_collection_modifyitems(items):
    """Skip tests that take a core for minutes; `make test-all` runs them."""
    if os.environ.get("THOROUGH") != "1":
        for item in items:
            if item.get_closest_marker("thorough"):
                item.add_marker(pytest.mark.skip(reason="takes minutes: make test-all runs it"))


@pytest.fixture(scope="session")
def built(tmp_path_factory) -> Tree:
    """Return the project after the default build; tests must not change it."""
    return made_once(tmp_path_factory, "built", lambda path: with_results(ROOT, path))


@pytest.fixture(scope="session")
def alone(built, tmp_path_factory) -> Tree:
    """Return the project after the default build without the studies; tests must not change it."""
    return made_once(tmp_path_factory, "alone", lambda path: without_studies(whole_copy(built, path)))


@pytest.fixture(scope="module")
def browser():
    """Return a browser for one test module; while it is open, notebooks cannot run an event loop in this process."""
    from headless_browser import Browser, executable

    path = executable()
    if path is None:
        pytest.skip("Chromium is not installed (Debian: apt install chromium)")
    browser = Browser(path)
    yield browser
    browser.close()


@pytest.fixture
def tree(tmp_path) -> Tree:
    """Return a copy of the project before a build, which a test may change."""
    return copied(ROOT, tmp_path / "tree")


@pytest.fixture
def rebuilt(built, tmp_path) -> Tree:
    """Return a copy of the built project, which a test may change."""
    return whole_copy(built, tmp_path / "tree")
