"""One figure: its notebook executed with the figure's parameters -> the files of the figure, and the page to read.

The executed notebook is kept beside the log, cell by cell as it runs, so that a failure can be read there.
"""

import os
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from uuid import uuid4

import papermill
from traitlets.config import Config

from job import running
from vibroimpact.figures.kit.files import replacing
from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.config import with_key
from vibroimpact_pipeline.environment import SCRATCH
from vibroimpact_pipeline.provenance.record import recorded
from vibroimpact_pipeline.quick_end import OF_KERNEL
from vibroimpact_pipeline.report.offline import page

PARAMETERS = {"figure", "alt", "settings", "inputs", "outputs", "provenance"}


def main(notebook, executed, html, parameters: dict, title: str) -> None:
    """Execute and export a notebook; the title is that of its figure.

    Raises:
        ValueError: the parameters cell of the notebook does not name exactly those of PARAMETERS.
        papermill.PapermillExecutionError: a cell failed.
    """
    declared = set(papermill.inspect_notebook(str(notebook)))
    if declared != PARAMETERS:
        raise ValueError(f"notebook: {notebook} has the parameters {sorted(declared)}, needs {sorted(PARAMETERS)}")
    Path(executed).parent.mkdir(parents=True, exist_ok=True)
    print(f"{notebook} as it was executed: {executed}")
    with replacing(html) as partial:
        partial.write_text(page(execute(notebook, executed, parameters), title), encoding="utf-8")


def execute(notebook, executed, parameters: dict):
    """The notebook after execution.

    Its kernel is spoken to through sockets that Linux knows by a name, which the @ says: one in a folder may have a
    path of 107 characters at most.
    """
    with TemporaryDirectory(prefix=SCRATCH) as folder:
        os.environ["JUPYTER_RUNTIME_DIR"] = folder
        sockets = {"transport": "ipc", "ip": f"@{SCRATCH}{uuid4()}", "connection_file": f"{folder}/kernel.json"}
        start = {"extra_arguments": [f"--IPKernelApp.exec_lines={OF_KERNEL}"]}
        return papermill.execute_notebook(
            str(notebook),
            str(executed),
            parameters,
            kernel_name="python3",
            progress_bar=False,
            config=Config({"KernelManager": sockets, "NotebookClient": start}),
        )


if "snakemake" in globals():
    with running(snakemake), recorded(snakemake) as (provenance, outputs):
        html = outputs.pop("html")
        parameters = {
            "figure": provenance["figure"],
            "alt": snakemake.params.alt,
            "settings": snakemake.params.settings,
            "inputs": dict(snakemake.input.items()),
            "outputs": outputs,
            "provenance": provenance,
        }
        executed = Path(snakemake.log[0]).with_suffix(".ipynb")
        notebook = root_of(snakemake) / snakemake.params.notebook
        try:
            main(notebook, executed, html, parameters, snakemake.params.title)
        except papermill.PapermillExecutionError as error:
            if line := with_key(error.evalue, provenance["config"]):
                sys.exit(line)
            raise
