"""The environment variables of every command of the pipeline and of its jobs."""

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
"""Folders below `.cache` by the variable that names each to its library; by default they lie in the home directory."""

OF_THE_USER = ("JUPYTER_", "MPLBACKEND", "PYTHONSTARTUP")
"""Beginnings of variables that would bring kernels, page templates, a backend of Matplotlib or code from elsewhere."""

NEEDED = ("numpy", "scipy", "numba", "matplotlib", "pandas", "papermill", "pydantic", "flint", "mpmath", "yaml")
"""Modules without which jobs fail; Snakemake alone parses, lints and lists the workflow."""


def missing_libraries() -> list[str]:
    """Return the names of required modules that are not installed."""
    return [name for name in NEEDED if importlib.util.find_spec(name) is None]


def set_environment(checkout: Path | None) -> None:
    """Set the variables of this process and of its jobs: the library of the
    checkout, caches there, one thread each.

    Without a checkout, or where it cannot be written to, caches lie in the working directory.
    """
    cache_folder = (checkout if checkout and os.access(checkout, os.W_OK) else Path.cwd()) / ".cache"
    for variable, folder in CACHES.items():
        (cache_folder / folder).mkdir(parents=True, exist_ok=True)
        os.environ[variable] = str(cache_folder / folder)
    if checkout:
        paths = [str(checkout / "src"), *filter(None, os.getenv("PYTHONPATH", "").split(os.pathsep))]
        os.environ["PYTHONPATH"] = os.pathsep.join(dict.fromkeys(paths))
    for variable in [name for name in os.environ if name.startswith(OF_THE_USER)]:
        del os.environ[variable]
    os.environ |= {"OMP_NUM_THREADS": "1", "JUPYTER_PREFER_ENV_PATH": "1"}
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    try:
        getpass.getuser()
    except (KeyError, OSError):  # in a container, say, where Snakemake would end in a traceback
        os.environ["LOGNAME"] = str(os.getuid())
