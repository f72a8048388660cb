"""Run scripts of the workflow as Snakemake runs them."""

import os
import runpy
from pathlib import Path
from types import SimpleNamespace

from pipeline_trees import ROOT


class Given(dict):
    """A mapping whose entries are also attributes, as in Snakemake."""

    __getattr__ = dict.__getitem__

    def __iter__(self):
        return iter(self.values())


def run(name: str, folder: Path, params: dict, outputs: dict, inputs=(), **wildcards) -> None:
    """Run a script in a folder; paths are relative to the folder."""
    before = Path.cwd()
    os.chdir(folder)
    try:
        job = SimpleNamespace(
            log=[],
            threads=1,
            rule=name,
            input=Given(inputs),
            output=Given(outputs),
            params=Given(params),
            wildcards=Given(wildcards),
        )
        runpy.run_path(str(ROOT / f"workflow/scripts/{name}.py"), init_globals={"snakemake": job})
    finally:
        os.chdir(before)
