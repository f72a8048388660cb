"""Where the pipeline's own files lie: a job may work in another directory."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
"""The root of the checkout that this package lies in."""


def cache_of(root: Path) -> Path:
    """The folder of all caches: in a checkout, or in the working directory if the checkout cannot be written to."""
    return (root if os.access(root, os.W_OK) else Path.cwd()) / ".cache"


def root_of(job) -> Path:
    """The root of the checkout that a Snakemake job's script belongs to."""
    return Path(job.scriptdir).resolve().parents[1]
