"""Test that files, tests and functions named in the documents exist, and that the README links every page."""

import ast
import re
import subprocess

import pytest

from pipeline_trees import ROOT

README, CONTRIBUTING = ((ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "CONTRIBUTING.md"))
PAGES = sorted(path.name for path in (ROOT / "docs").glob("*.md"))
EQUATIONS = re.findall(r"^\| (\(10\.\d+\).*?) \| (.*?) \| (.*?) \|$", CONTRIBUTING, re.MULTILINE)
LINK = re.compile(r"\]\((?!https?:|\.\./results/)([^)#]+)")
LAYER = ROOT / "docs/studies"


@pytest.mark.parametrize("page", PAGES)
def test_every_page_is_linked_from_the_readme(page):
    assert f"](docs/{page})" in README


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md", *(f"docs/{page}" for page in PAGES)])
def test_targets_of_links_exist(page):
    """Links to the studies are tested only if the checkout has the studies."""
    links = [(ROOT / page).parent / link for link in LINK.findall((ROOT / page).read_text(encoding="utf-8"))]
    assert [link for link in links if not link.exists() and not is_of_studies(link)] == []


def is_of_studies(path) -> bool:
    """Return True if a file or folder belongs to the studies, which this checkout may lack."""
    return any(name.partition(".")[0] == "studies" for name in path.parts) and not LAYER.exists()


def test_paths_of_the_quick_tests_exist():
    """`make test-quick` passes paths to pytest."""
    command = subprocess.run(["make", "-n", "test-quick"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    paths = re.findall(r" (tests/\S+)", command)
    assert len(paths) > 10
    assert [path for path in paths if not (ROOT / path).exists() and not is_of_studies(ROOT / path)] == []
    assert "`make test-quick`" in CONTRIBUTING


def docstrings(path) -> dict[str, str]:
    """Return the docstring of each function, class and method (Class.method) of a module by name."""
    module = ast.parse(path.read_text(encoding="utf-8"))
    nodes = {node.name: node for node in module.body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    for name, node in [*nodes.items()]:
        nodes |= {f"{name}.{inner.name}": inner for inner in node.body if isinstance(inner, ast.FunctionDef)}
    return {name: ast.get_docstring(node) or "" for name, node in nodes.items()}


def cited(text) -> set[int]:
    """Return the numbers of the chapter's equations in a text; a range (10.4)-(10.6) gives all its equations."""
    numbers = {int(number) for number in re.findall(r"\(10\.(\d+)\)", text)}
    for first, last in re.findall(r"\(10\.(\d+)\)[-–]\(10\.(\d+)\)", text):
        numbers |= set(range(int(first), int(last) + 1))
    return numbers


@pytest.mark.parametrize(("equations", "files", "names"), EQUATIONS, ids=[row[0] for row in EQUATIONS])
def test_docstrings_cite_the_equation_that_the_map_assigns_to_them(equations, files, names):
    modules = [ROOT / "src/vibroimpact" / name for name in re.findall(r"`([^`]+)`", files)]
    found = {name: text for module in modules for name, text in docstrings(module).items()}
    found_equations = set()
    for name in re.findall(r"`([^`]+)`", names):
        assert name in found
        found_equations |= cited(found[name])
    assert cited(equations) <= found_equations or "derived" in equations


RUNNING = (ROOT / "docs/running.md").read_text(encoding="utf-8")
NAMED = sorted(set(re.findall(r"test_\w+\.py", RUNNING)))


@pytest.mark.parametrize("name", NAMED)
def test_a_test_that_the_page_on_running_names_exists(name):
    assert list((ROOT / "tests").rglob(name)) or not LAYER.exists()


def test_the_page_on_running_names_every_test_of_faults():
    assert {path.name for path in (ROOT / "tests/faults").glob("test_*.py")} <= set(NAMED)
