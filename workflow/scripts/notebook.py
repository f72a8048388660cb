"""One figure: its notebook executed with the figure's parameters -> the files of the figure, and the page to read.

The executed notebook is kept beside the log, cell by cell as it runs, so that a failure can be read there.
"""

import os
from pathlib import Path
from tempfile import TemporaryDirectory
from uuid import uuid4

import papermill
from jupyter_client.kernelspec import KernelSpecManager
from jupyter_client.manager import AsyncKernelManager
from traitlets import default
from traitlets.config import Config

from vibroimpact_pipeline import provenance
from vibroimpact_pipeline.html.figure_texts import words
from vibroimpact_pipeline.html.offline import page
from vibroimpact_pipeline.jobs import running


class OwnKernel(AsyncKernelManager):
    """A kernel of the interpreter that runs this job, whatever the kernels are that Jupyter finds by that name."""

    @default("kernel_spec_manager")
    def of_this_interpreter(self):
        return KernelSpecManager(kernel_dirs=[])


def execute(notebook, executed, parameters: dict):
    """Return the executed notebook; it must have the parameters that are given.

    Its kernel is spoken to through sockets that Linux knows by a name, which the @ says: one in a folder may have a
    path of 107 characters at most.

    Raises:
        ValueError: it has not, of which papermill itself would only warn; or a cell has found one of them wrong.
        papermill.PapermillExecutionError: a cell failed.
    """
    if unknown := sorted(parameters.keys() - papermill.inspect_notebook(str(notebook)).keys()):
        raise ValueError(f"notebook: {notebook} has no parameters {', '.join(unknown)}")
    with TemporaryDirectory() as folder:
        os.environ["JUPYTER_RUNTIME_DIR"] = folder
        sockets = {"transport": "ipc", "ip": f"@vibroimpact-{uuid4()}", "connection_file": f"{folder}/kernel.json"}
        try:
            return papermill.execute_notebook(
                str(notebook),
                str(executed),
                parameters,
                kernel_name="python3",
                kernel_manager_class=OwnKernel,
                progress_bar=False,
                config=Config({"KernelManager": sockets}),
            )
        except papermill.PapermillExecutionError as error:
            raise ValueError(error.evalue) if error.ename == "ValueError" else error from None


def the_same_in_each_build(notebook, paths: dict):
    """Return an executed notebook whose cell of given parameters has a fixed id, and paths for temporary ones."""
    given = next(cell for cell in notebook.cells if "injected-parameters" in cell.metadata.get("tags", ()))
    given.id = "injected-parameters"
    for temporary, path in paths.items():
        given.source = given.source.replace(temporary, path)
    return notebook


with running(snakemake) as out:
    params, outputs = snakemake.params, vars(out)
    texts = words(params.figure, params.scene, params.get("system") or {})
    settings = dict(params.settings)
    parameters = {
        "figure": params.figure,
        "alt": texts["alt"],
        **({"case": params.case, **params.system} if params.case else {}),
        **settings.pop("plant", {}),
        **settings,
        "inputs": {name: path for name, path in snakemake.input.items() if name != "notebook"},
        "outputs": {name: path for name, path in outputs.items() if name != "html"},
    }
    executed = Path(snakemake.log[0]).with_suffix(".ipynb")
    print(f"{snakemake.input.notebook} as it was executed: {executed}")
    done = execute(snakemake.input.notebook, executed, parameters)
    paths = {outputs[name]: path for name, path in snakemake.output.items()}
    Path(out.html).write_text(page(the_same_in_each_build(done, paths), texts["title"]), encoding="utf-8")
    provenance.write(snakemake, out)
