"""Jobs on a cluster that a killed build has left: they would write the same files as those of the next build."""

import os
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

PREFIX = "vibroimpact_"
"""How the names of our jobs begin (slurm-jobname-prefix of the profile)."""
PATIENCE = 120
"""Seconds within which a job that was told to end is gone; Slurm kills it after 30, unless it is set otherwise."""


def end_left_jobs() -> None:
    """End them, and wait until they are gone; to be called by who holds the lock of the working directory.

    Raises:
        RuntimeError: Slurm does not say which jobs there are, or one of them does not end.
    """
    give_up = time.monotonic() + PATIENCE
    while left := sorted(_left()):
        if time.monotonic() > give_up:
            jobs = ", ".join(left)
            raise RuntimeError(f"Slurm: job {jobs} of a build before does not end. Build again once it is gone.")
        _slurm("scancel", *left)
        time.sleep(1)


def _left() -> Iterator[str]:
    """Numbers of our jobs that were sent from here and have not ended."""
    here = str(Path.cwd())
    for line in _slurm("squeue", "--noheader", f"--user={os.getuid()}", "--format=%A|%j|%Z").splitlines():
        number, name, directory = line.split("|", 2)
        if name.startswith(PREFIX) and directory == here:
            yield number


def _slurm(*command):
    said = subprocess.run(command, capture_output=True, text=True, check=False)
    if said.returncode and command[0] == "squeue":
        raise RuntimeError(f"Slurm: {said.stderr.strip() or 'no answer'}. Build again once it answers.")
    return said.stdout
