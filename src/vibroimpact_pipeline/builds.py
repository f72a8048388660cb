"""The begin of a build: the libraries are there, no other build goes on, and every result that is there is whole."""

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

from vibroimpact_pipeline.jobs import TOKEN
from vibroimpact_pipeline.results import PARTIAL, distrusted, remove, replacing

SHOWN = 4
"""Paths that are named for each reason."""
NEEDED = ("numpy", "scipy", "numba", "matplotlib", "pandas", "papermill", "pydantic", "flint", "mpmath", "yaml")
"""Modules without which jobs fail; Snakemake alone parses, lints and lists the workflow."""
CACHES = {
    "XDG_CACHE_HOME": "",
    "XDG_CONFIG_HOME": "",
    "MPLCONFIGDIR": "matplotlib",
    "IPYTHONDIR": "ipython",
    "HEYOKA_CACHE_DIR": "heyoka",
}
"""Folders below `.cache` by the variable that names each to its library; by default they lie in the home directory."""


def set_environment(root: Path) -> None:
    """Set the variables of this process and of its jobs: caches in the checkout, one thread each.

    Where the checkout cannot be written to, caches lie in the working directory.
    """
    cache_folder = (root if os.access(root, os.W_OK) else Path.cwd()) / ".cache"
    for variable, folder in CACHES.items():
        (cache_folder / folder).mkdir(parents=True, exist_ok=True)
        os.environ[variable] = str(cache_folder / folder)
    os.environ |= {"OMP_NUM_THREADS": "1", "JUPYTER_PREFER_ENV_PATH": "1"}
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)


def missing_libraries() -> list[str]:
    """Names of the modules that jobs need and that are not installed."""
    return [name for name in NEEDED if importlib.util.find_spec(name) is None]


@cache
def lock() -> TextIO:
    """Wait for another build of this directory to end; the system frees the lock with the process."""
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


def begin(results: Path, params_of: Callable[[dict], dict | None], makes: Callable[[str], bool], dry_run: bool) -> None:
    """Remove what killed jobs have left and results that cannot be trusted (see `results.distrusted`), and say which.

    Jobs of a build before this one, which was killed, can replace nothing from now on. A dry run removes nothing.
    """
    if not dry_run:
        lock()
        with replacing(TOKEN) as partial:
            partial.write_text(secrets.token_hex(8), encoding="ascii")
        for folder in results.rglob(f"{PARTIAL}*"):
            shutil.rmtree(folder, ignore_errors=True)
    found = distrusted(results, params_of, makes)
    for reason in dict.fromkeys(found.values()):
        paths = [path for path, why in found.items() if why == reason]
        shown = ", ".join(paths[:SHOWN]) + f" and {len(paths) - SHOWN} more" * (len(paths) > SHOWN)
        print(f"{'To be made' if dry_run else 'Made'} anew, {reason}: {shown}", file=sys.stderr)
    if not dry_run:
        for path in found:
            remove(path)
