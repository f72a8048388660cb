"""The notebooks as they lie in the repository: valid, stripped, with the parameters that the pipeline sets."""

import ast

import nbformat
import pytest

from pipeline_trees import ROOT

NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))


def test_there_is_one_notebook_per_kind_of_figure():
    names = ["closed_form", "drawings", "fixed_points", "physical_units", "simulation", "theoretical_response"]
    assert [path.stem for path in NOTEBOOKS] == names


@pytest.fixture(params=NOTEBOOKS, ids=lambda path: path.stem)
def notebook(request):
    return nbformat.read(request.param, as_version=nbformat.NO_CONVERT)


def test_valid_with_readable_cell_ids(notebook):
    nbformat.validate(notebook)
    assert (notebook.nbformat, notebook.nbformat_minor) == (4, 5)
    assert all(cell.id.replace("-", "").isalpha() for cell in notebook.cells)


def test_stripped(notebook):
    for cell in notebook.cells:
        if cell.cell_type == "code":
            assert cell.outputs == []
            assert cell.execution_count is None


def test_parameters_are_those_that_the_pipeline_sets(notebook):
    (cell,) = (cell for cell in notebook.cells if "parameters" in cell.metadata.get("tags", []))
    assignments = ast.parse(cell.source).body
    assert [statement.targets[0].id for statement in assignments] == [
        "figure",
        "alt",
        "settings",
        "inputs",
        "outputs",
        "provenance",
    ]
    values = {statement.targets[0].id: ast.literal_eval(statement.value) for statement in assignments}
    assert values["inputs"] == values["outputs"] == values["provenance"] == {}  # a reader's run is a reader's own


def test_begins_with_the_question_and_its_equations(notebook):
    question, equations = notebook.cells[:2]
    assert "**Question.**" in question.source
    assert equations.source.startswith("**Equations.**")
    assert "$$" in equations.source


def test_defines_no_functions(notebook):
    """Whatever computes belongs to the library, where it is tested."""
    for cell in notebook.cells:
        if cell.cell_type == "code":
            tree = ast.parse(cell.source)
            assert not any(isinstance(node, (ast.FunctionDef, ast.ClassDef)) for node in ast.walk(tree))
