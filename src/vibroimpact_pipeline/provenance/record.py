"""Where the files of a figure come from: what goes into their metadata, and what only the sidecar says."""

import json
import platform
import time
from contextlib import contextmanager
from pathlib import Path

import numpy

from vibroimpact.figures.kit.files import replacing
from vibroimpact.figures.kit.versions import drawn_with
from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.git import git
from vibroimpact_pipeline.integrity.checksums import digest_of
from vibroimpact_pipeline.provenance.rounding import rounded_by

LOCK = "environment.lock"


@contextmanager
def recorded(job):
    """Give the record of a job's figure and its outputs by name; write the sidecar, with the run time, at the end."""
    start, outputs = time.monotonic(), dict(job.output.items())
    sidecar = outputs.pop("provenance")
    root = root_of(job)
    provenance = record(job.params.provenance, job.input, root)
    yield provenance, outputs
    write_sidecar(sidecar, provenance, outputs.values(), root, seconds=time.monotonic() - start)


def record(decided: dict, inputs, root: Path) -> dict:
    """What decides on a figure, the same in every build of one commit: by the rules, lock, inputs, versions."""
    versions = {"python": platform.python_version(), "numpy": numpy.__version__, **drawn_with()}
    return {
        **decided,
        "lock": digest_of(root / LOCK),
        "inputs": {str(path): digest_of(path) for path in inputs},
        "versions": versions,
    }


def write_sidecar(path, provenance: dict, outputs, root: Path, seconds: float) -> None:
    """Write the record, the files that were made, and what no file of the figure bears: commit, machine, run time."""
    commit, changes = git("rev-parse", "HEAD", root=root), git("status", "--porcelain", root=root)
    sidecar = provenance | {
        "outputs": {str(output): digest_of(output) for output in outputs},
        "commit": commit,
        "tree": None if changes is None else "modified" if changes else "clean",
        "seconds": round(seconds, 3),
        "rounded by": rounded_by(),
    }
    with replacing(path) as partial:
        partial.write_text(json.dumps(sidecar, indent=2) + "\n", encoding="utf-8")
