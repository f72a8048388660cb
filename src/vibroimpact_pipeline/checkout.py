"""Where the pipeline's own files lie: a job may work in another directory."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
"""The root of the checkout that this package lies in."""


def root_of(job) -> Path:
    """The root of the checkout that a Snakemake job's script belongs to."""
    return Path(job.scriptdir).resolve().parents[1]
