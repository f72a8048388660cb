"""The surroundings of the pipeline: the same for every command, and nothing from the user's own settings."""

import errno
import os
import shutil
from pathlib import Path

from vibroimpact_pipeline.checkout import cache_of
from vibroimpact_pipeline.integrity.compiled import drop_untrusted
from vibroimpact_pipeline.sources import Sources

CACHES = {"MPLCONFIGDIR": "matplotlib", "IPYTHONDIR": "ipython", "HEYOKA_CACHE_DIR": "heyoka"}
"""Folders of `.cache` by the variable that names each to its library; by default they lie in the home directory."""
SCRATCH = "vibroimpact-job-"
"""How the names of a job's temporary folders begin, so that those of a killed job can be told from anybody else's."""


def prepare(root: Path, sources: Sources) -> None:
    """Set the environment of this process and of all that it starts.

    Compiled code is kept apart by the content of its sources, since Numba itself looks at one file at a time and
    would go on using a function whose callee in another file has changed.
    """
    own, cache = root / ".cache", cache_of(root)
    compiled = f"numba/{sources.compiled()}"
    if cache != own:
        _hand_on(own / compiled, cache / compiled)
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    os.environ.setdefault("NUMBA_CACHE_DIR", str(cache / compiled))
    os.environ |= {
        "OMP_NUM_THREADS": "1",  # Snakemake fills the cores with jobs
        "JUPYTER_PREFER_ENV_PATH": "1",
        **{variable: str(cache / folder) for variable, folder in CACHES.items()},
    }
    for variable in CACHES:
        Path(os.environ[variable]).mkdir(parents=True, exist_ok=True)
    drop_untrusted(root, Path.cwd())


def _hand_on(compiled: Path, target: Path) -> None:
    """Copy compiled code, unless it is there already; an interrupted copy is not taken for one."""
    if compiled.is_dir() and not target.exists():
        partial = target.with_name(f"{target.name}.{os.getpid()}.partial")
        try:
            shutil.copytree(compiled, partial)
            partial.rename(target)
        except OSError as error:  # of a copy it has neither number nor name
            shutil.rmtree(partial, ignore_errors=True)
            raise OSError(errno.EIO, f"compiled code cannot be copied here ({error})", str(target)) from None
