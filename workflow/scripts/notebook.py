"""Pages of figures: their notebook executed with the parameters of each, on its finished tables and picture.

An executed notebook is kept beside the log, cell by cell as it runs, so that a failure can be read there.
"""

from pathlib import Path

from vibroimpact_pipeline.html.figure_texts import words
from vibroimpact_pipeline.html.offline import page
from vibroimpact_pipeline.jobs import running

import papermill
from ipykernel.inprocess import InProcessKernelManager
from nbformat.v4 import output_from_msg
from papermill.engines import Engine, papermill_engines

SHOWN = "stream", "display_data", "execute_result", "error"
"""Kinds of a kernel's messages that are outputs of a cell."""


class InProcess(Engine):
    """Execute the cells in this process: a kernel in a process of its own would import everything once more."""

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
            cell.outputs = [output_from_msg(message) for message in messages if message["msg_type"] in SHOWN]
            if client.get_shell_msg()["content"]["status"] == "error":
                manager.cell_exception(cell, index)
                return
            manager.cell_complete(cell, index)


papermill_engines.register("in_process", InProcess)


def execute(notebook, executed, parameters: dict):
    """Return the executed notebook; it must have the parameters that are given.

    Raises:
        ValueError: it has not, of which papermill itself would only warn; or a cell has found one of them wrong.
        papermill.PapermillExecutionError: a cell failed.
    """
    if unknown := sorted(parameters.keys() - papermill.inspect_notebook(str(notebook)).keys()):
        raise ValueError(f"notebook: {notebook} has no parameters {', '.join(unknown)}")
    try:
        return papermill.execute_notebook(
            str(notebook),
            str(executed),
            parameters,
            engine_name="in_process",
            kernel_name="python3",
            progress_bar=False,
        )
    except papermill.PapermillExecutionError as error:
        raise ValueError(error.evalue) if error.ename == "ValueError" else error from None


def parameters_of(config: dict) -> dict:
    """Return the parameters of a notebook by name, from the entries of the config that decide what its figure shows."""
    given = {}
    for path, value in config.items():
        name = path.rpartition(".")[2]
        given |= value if path == f"cases.{name}" else value if name == "plant" else {name: value}
    return given


with running(snakemake) as out:
    for figure, shown in snakemake.params.pages.items():
        texts = words(figure, shown["scene"], shown["system"] or {})
        case = {"case": shown["case"]} if shown["case"] else {}
        given = {"figure": figure, "alt": texts["alt"], **case, **parameters_of(shown["config"])}
        executed = Path(snakemake.log[0]).with_name(f"{figure}.ipynb")
        print(f"{snakemake.input.notebook} as it was executed: {executed}")
        done = execute(snakemake.input.notebook, executed, given | {"inputs": shown["inputs"]})
        injected = next(cell for cell in done.cells if "injected-parameters" in cell.metadata.get("tags", ()))
        injected.id = "injected-parameters"  # random else, and the page of each build another
        Path(getattr(out, figure)).write_text(page(done, texts["title"]), encoding="utf-8")
