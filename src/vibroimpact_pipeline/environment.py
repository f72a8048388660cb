"""The surroundings of the pipeline: the same for every command, and nothing from the user's own settings."""

import os
from pathlib import Path

from vibroimpact_pipeline.sources import Sources


def prepare(root: Path, sources: Sources) -> None:
    """Set the environment of this process and of all that it starts; every cache lies in the checkout at `root`.

    Compiled code is kept apart by the content of its sources, since Numba itself looks at one file at a time and
    would go on using a function whose callee in another file has changed.
    """
    cache = root / ".cache"
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    os.environ.setdefault("NUMBA_CACHE_DIR", str(cache / "numba" / sources.compiled()))
    os.environ |= {
        "OMP_NUM_THREADS": "1",  # Snakemake fills the cores with jobs
        "MPLCONFIGDIR": str(cache / "matplotlib"),
        "IPYTHONDIR": str(cache / "ipython"),
        "JUPYTER_PREFER_ENV_PATH": "1",
    }
    for name in ("MPLCONFIGDIR", "IPYTHONDIR"):
        Path(os.environ[name]).mkdir(parents=True, exist_ok=True)
