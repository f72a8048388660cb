"""Set environment variables for all commands and jobs of the pipeline."""

import getpass
import importlib.util
import os
from pathlib import Path

CACHES = {
    "XDG_CACHE_HOME": "",
    "XDG_CONFIG_HOME": "",
    "MPLCONFIGDIR": "matplotlib",
    "IPYTHONDIR": "ipython",
    "HEYOKA_CACHE_DIR": "heyoka",
}
"""Cache folder below `.cache` for each environment variable; without these, libraries write to the home directory."""

REMOVED = ("JUPYTER_", "MPLBACKEND", "PYTHONSTARTUP")
"""Prefixes of variables to remove, since they change kernels, page templates, the backend or start-up code."""

REQUIRED = ("numpy", "scipy", "numba", "matplotlib", "pandas", "papermill", "pydantic", "flint", "mpmath", "yaml")
"""Modules that the workflow and its jobs need."""


def missing_libraries() -> list[str]:
    """Return the names of required modules that are not installed."""
    return [name for name in REQUIRED if importlib.util.find_spec(name) is None]


def set_environment(checkout: Path) -> None:
    """Set PYTHONPATH, and environment variables that select cache folders and one thread per job.

    The cache folders are in the checkout. If the checkout is not writable, they are in the working directory.
    """
    cache_folder = (checkout if os.access(checkout, os.W_OK) else Path.cwd()) / ".cache"
    for variable, folder in CACHES.items():
        (cache_folder / folder).mkdir(parents=True, exist_ok=True)
        os.environ[variable] = str(cache_folder / folder)
    paths = [str(checkout / "src"), *filter(None, os.getenv("PYTHONPATH", "").split(os.pathsep))]
    os.environ["PYTHONPATH"] = os.pathsep.join(dict.fromkeys(paths))
    for variable in [name for name in os.environ if name.startswith(REMOVED)]:
        del os.environ[variable]
    os.environ |= {"OMP_NUM_THREADS": "1", "JUPYTER_PREFER_ENV_PATH": "1"}
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    try:
        getpass.getuser()
    except (KeyError, OSError):  # Snakemake needs a user name, which some containers lack
        os.environ["LOGNAME"] = str(os.getuid())
