"""Return versions of packages: those that determine the pixels of a picture, and those recorded with a figure."""

import platform
from importlib.metadata import version

import matplotlib
from matplotlib import ft2font


def drawing_versions() -> dict[str, str]:
    """Return the versions on which the pixels of a picture depend."""
    return {"matplotlib": matplotlib.__version__, "freetype": ft2font.__freetype_version__}


def recorded_versions() -> dict[str, str]:
    """Return the versions of Python and of the packages that compute and draw a figure."""
    packages = ("numpy", "scipy", "numba", "matplotlib")
    return {"python": platform.python_version(), **{name: version(name) for name in packages}}
