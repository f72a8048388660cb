"""What Numba has compiled of the checkout, for a copy of the library with the same content elsewhere."""

import shutil
from pathlib import Path

from numba.core.caching import _CacheLocator

LIBRARY = Path(__file__).parents[2] / "src/vibroimpact"
KEPT = "__pycache__"


def share(library: Path, cache: Path | None = None) -> None:
    """Put the code of this checkout where Numba looks for that of another copy, as far as there is any.

    cache: the folder that NUMBA_CACHE_DIR names there; None for the copy's own.
    """
    for source in LIBRARY.rglob("__init__.py"):
        for folder in (LIBRARY / KEPT).glob("compiled-*"):
            copy = library / source.relative_to(LIBRARY)
            target = cache or library / KEPT / folder.name
            if (code := folder / _subfolder(source)).is_dir() and copy.exists():
                shutil.copytree(code, target / _subfolder(copy), dirs_exist_ok=True)


def _subfolder(source):
    """Where Numba keeps what it compiles of the package of a source, good for every copy with the same content."""
    return _CacheLocator.get_suitable_cache_subpath(str(source))
