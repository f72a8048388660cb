"""The notebooks in the repository are valid and without outputs, and have the parameters that the pipeline sets."""

import ast
import tomllib

import nbformat
import pytest

from pipeline_trees import ROOT

FOLDER = ROOT / "notebooks"
NOTEBOOKS = sorted(path.relative_to(FOLDER).with_suffix("").as_posix() for path in FOLDER.rglob("*.ipynb"))
"""Notebooks of the chapter and of the studies."""


def opened(name):
    return nbformat.read(FOLDER / f"{name}.ipynb", as_version=nbformat.NO_CONVERT)


def code(notebook, tag=None):
    """Return the sources of the code cells, or of those with a tag, without the commands of IPython."""
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    chosen = [cell for cell in cells if tag is None or tag in cell.metadata.get("tags", [])]
    return ["\n".join(line for line in cell.source.splitlines() if not line.startswith("%")) for cell in chosen]


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_notebooks_are_valid_without_outputs_and_begin_with_question_and_equations(name):
    notebook = opened(name)
    nbformat.validate(notebook)
    assert (notebook.nbformat, notebook.nbformat_minor) == (4, 5)
    assert all(cell.id.replace("-", "").isalpha() for cell in notebook.cells)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(cell.outputs == [] and cell.execution_count is None for cell in cells)
    question, equations = notebook.cells[:2]
    assert "**Question.**" in question.source
    assert equations.source.startswith("**Equations.**")
    assert "$$" in equations.source


@pytest.mark.parametrize("name", [name for name in NOTEBOOKS if name != "play"])
def test_parameters_are_literals_and_only_solutions_by_hand_define_functions(name):
    """Other computations belong to the library, where they are tested."""
    notebook = opened(name)
    (source,) = code(notebook, "parameters")
    values = {node.targets[0].id: ast.literal_eval(node.value) for node in ast.parse(source).body}
    assert list(values)[:2] == ["figure", "alt"]
    assert "refuse_unknown(" in code(notebook)[2]
    assert values["inputs"] == {}  # a run by hand reads no files of a build
    for source in set(code(notebook)) - set(code(notebook, "by-hand")):
        assert not any(isinstance(node, (ast.FunctionDef, ast.ClassDef)) for node in ast.walk(ast.parse(source)))


def test_the_notebook_play_imports_only_what_its_extra_installs():
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    assert {"vibroimpact[figures]", "ipykernel>=6.29"} < set(extras["notebooks"])
    imports = [node for source in code(opened("play")) for node in ast.walk(ast.parse(source))]
    names = {alias.name for node in imports if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in imports if isinstance(node, ast.ImportFrom)}
    assert {name.split(".")[0] for name in names} == {"vibroimpact", "numpy", "scipy", "matplotlib", "IPython"}
