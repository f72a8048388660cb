"""Scripts of the workflow, run as Snakemake runs them."""

import os
import runpy
from pathlib import Path
from types import SimpleNamespace

from pipeline_trees import ROOT


class Given(dict):
    """A mapping whose entries are attributes, too, as Snakemake has them."""

    __getattr__ = dict.__getitem__

    def __iter__(self):
        return iter(self.values())


def run(name: str, folder: Path, params: dict, outputs: dict, inputs=(), **wildcards) -> None:
    """Run a script in a folder, with paths from there."""
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
