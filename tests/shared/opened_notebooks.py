"""Run notebooks as a reader would, with edited parameters; all notebooks run in one kernel, one after another."""

from pathlib import Path

import nbformat
from nbclient import NotebookClient

from pipeline_trees import ROOT


def edited(name: str, edits: dict[str, str]) -> list:
    """Return the code cells of a notebook, with edits of the cell of parameters."""
    cells = nbformat.read(ROOT / f"notebooks/{name}.ipynb", as_version=4).cells
    cells = [cell for cell in cells if cell.cell_type == "code"]
    (parameters,) = (cell for cell in cells if "parameters" in cell.metadata.get("tags", []))
    for old, new in edits.items():
        assert parameters.source.count(old) == 1, (name, old)
        parameters.source = parameters.source.replace(old, new)
    return cells


def printed(runs: dict[str, tuple[str, dict[str, str]]], folder: Path) -> dict[str, str]:
    """Return all outputs of notebooks by the keys of `runs`, whose values are (name, edits); images are "<picture>".

    One kernel, started in the folder, runs all notebooks; its variables are deleted before the next notebook.
    """
    opened = {key: [nbformat.v4.new_code_cell("%reset -f"), *edited(*run)] for key, run in runs.items()}
    cells = [cell for part in opened.values() for cell in part]
    whole = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell.source) for cell in cells])
    NotebookClient(whole, kernel_name="python3", resources={"metadata": {"path": str(folder)}}).execute()
    done = iter(whole.cells)
    return {key: "\n".join(_shown(next(done)) for _ in part) for key, part in opened.items()}


def _shown(cell):
    return "\n".join(
        "<picture>"
        if "image/png" in output.get("data", {})
        else output.get("data", {}).get("text/markdown")
        or output.get("data", output).get("text/plain", "")
        or output.get("text", "")
        for output in cell.outputs
    )
