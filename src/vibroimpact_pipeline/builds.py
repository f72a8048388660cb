"""Checks before a build: libraries installed, no other build running, every existing result intact."""

import base64
import fcntl
import importlib.util
import os
import secrets
import shutil
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TextIO

from vibroimpact_pipeline.jobs import BUILD, TOKEN
from vibroimpact_pipeline.results import PARTIAL, distrusted, remove, replacing

SHOWN = 4
"""Paths that are named for each reason."""
NEEDED = ("numpy", "scipy", "numba", "matplotlib", "pandas", "papermill", "pydantic", "flint", "mpmath", "yaml")
"""Modules without which jobs fail; Snakemake alone parses, lints and lists the workflow."""


def missing_libraries() -> list[str]:
    """Return the names of required modules that are not installed."""
    return [name for name in NEEDED if importlib.util.find_spec(name) is None]


@cache
def lock() -> TextIO:
    """Lock this directory for one build, after waiting for any other; the lock ends with the process."""
    TOKEN.parent.mkdir(exist_ok=True)
    file = open(TOKEN.with_name("build.lock"), "a")  # noqa: SIM115
    try:
        fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        print("Waiting for another build in this directory to finish.", file=sys.stderr)
        fcntl.lockf(file, fcntl.LOCK_EX)
    except OSError as error:
        print(f"{file.name}: {error.strerror}. Start no second build in this directory meanwhile.", file=sys.stderr)
    return file


def known_to_snakemake(path: str) -> bool:
    """Return True if Snakemake has its own record of how a result was made."""
    return Path(".snakemake/metadata", base64.urlsafe_b64encode(path.encode()).decode()).is_file()


def begin(results: Path, params_of: Callable[[dict], dict | None], makes: Callable[[str], bool], dry_run: bool) -> None:
    """Remove leftovers of killed jobs and results that cannot be trusted (see `results.distrusted`), and print them.

    From here on, jobs of an earlier build that was killed can replace nothing. A dry run removes nothing.
    """
    if not dry_run:
        lock()
        os.environ[BUILD] = secrets.token_hex(8)
        with replacing(TOKEN) as partial:
            partial.write_text(os.environ[BUILD], encoding="ascii")
        for folder in results.rglob(f"{PARTIAL}*"):
            shutil.rmtree(folder, ignore_errors=True)
    # As long as Snakemake knows with which parameters a result was made, it makes it anew itself where it is asked for.
    found = distrusted(results, lambda path, made: None if known_to_snakemake(path) else params_of(made), makes)
    for reason in dict.fromkeys(found.values()):
        paths = [path for path, why in found.items() if why == reason]
        shown = ", ".join(paths[:SHOWN]) + f" and {len(paths) - SHOWN} more" * (len(paths) > SHOWN)
        print(f"{'To be made' if dry_run else 'Made'} anew, {reason}: {shown}", file=sys.stderr)
    if not dry_run:
        for path in found:
            remove(path)
