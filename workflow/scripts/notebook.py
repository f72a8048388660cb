"""Execute a notebook once for each figure that the notebook explains, and write the page of the figure.

If a cell fails, the executed notebook in results/logs/notebooks shows the failed cell.
"""

from pathlib import Path

from vibroimpact_pipeline.html.figure_texts import words
from vibroimpact_pipeline.html.offline import page
from vibroimpact_pipeline.jobs import LOGS, running

import papermill
from ipykernel.inprocess import InProcessKernelManager
from nbformat.v4 import output_from_msg
from papermill.engines import Engine, papermill_engines

OUTPUT_MESSAGES = "stream", "display_data", "execute_result", "error"
"""Types of kernel messages that are outputs of a cell."""


class InProcess(Engine):
    """Execute cells in this process, since a separate kernel process would have to import all modules again."""

    @classmethod
    def execute_managed_notebook(cls, manager, kernel_name, **settings):
        kernel = InProcessKernelManager()
        kernel.start_kernel()
        client = kernel.client()
        client.start_channels()
        for index, cell in enumerate(manager.nb.cells):
            if cell.cell_type != "code":
                continue
            manager.cell_start(cell, index)
            client.execute(cell.source)
            cell.execution_count = kernel.kernel.execution_count - 1
            messages = client.iopub_channel.get_msgs()
            cell.outputs = [output_from_msg(message) for message in messages if message["msg_type"] in OUTPUT_MESSAGES]
            if client.get_shell_msg()["content"]["status"] == "error":
                manager.cell_exception(cell, index)
                return
            manager.cell_complete(cell, index)


papermill_engines.register("in_process", InProcess)


def execute(notebook, executed, parameters: dict):
    """Execute a notebook with the given parameters and return the executed notebook.

    Raises
    ------
    ValueError
        If the notebook lacks a parameter, or if a cell raises ValueError.
    papermill.PapermillExecutionError
        If a cell raises another exception.
    """
    if unknown := sorted(parameters.keys() - papermill.inspect_notebook(str(notebook)).keys()):
        raise ValueError(f"notebook: {notebook} should define the parameters {', '.join(unknown)}")
    settings = {"engine_name": "in_process", "kernel_name": "python3", "progress_bar": False}
    try:
        return papermill.execute_notebook(str(notebook), str(executed), parameters, **settings)
    except papermill.PapermillExecutionError as error:
        raise ValueError(error.evalue) if error.ename == "ValueError" else error from None


def parameters_of(config: dict) -> dict:
    """Return the parameters of a notebook by name; `config` contains config entries by key path.

    The name of a parameter is the last key of the path. If a config entry is a case or a `plant`, each value of the
    entry becomes a separate parameter.
    """
    given = {}
    for path, value in config.items():
        name = path.rpartition(".")[2]
        given |= value if path == f"cases.{name}" else value if name == "plant" else {name: value}
    return given


with running(snakemake) as out:
    (LOGS / "notebooks").mkdir(exist_ok=True)
    for figure, shown in snakemake.params.pages.items():
        texts = words(figure, shown["scene"], shown["system"] or {})
        case = {"case": shown["case"]} if shown["case"] else {}
        given = {"figure": figure, "alt": texts["alt"], **case, **parameters_of(shown["config"])}
        executed = LOGS / f"notebooks/{figure}.ipynb"
        print(f"Executed notebook: {executed}")
        done = execute(snakemake.input.notebook, executed, given | {"inputs": shown["inputs"]})
        injected = next(cell for cell in done.cells if "injected-parameters" in cell.metadata.get("tags", ()))
        injected.id = "injected-parameters"  # a random id would change the page in every build
        # If the tag of a cell is the name of a figure, the cell belongs only to the page of this figure.
        others = snakemake.params.pages.keys() - {figure}
        done.cells = [cell for cell in done.cells if not others.intersection(cell.metadata.get("tags", ()))]
        Path(getattr(out, figure)).write_text(page(done, texts["title"]), encoding="utf-8")
