"""What Numba has compiled of the checkout, for a copy of the library with the same content elsewhere."""

import os
import shutil
from pathlib import Path

from numba.core.caching import _CacheLocator

from pipeline_trees import ROOT


def share(library: Path, cache: Path) -> None:
    """Put the code of these tests where Numba looks for that of another copy of the library, as far as there is any."""
    for source in (ROOT / "src/vibroimpact").rglob("__init__.py"):
        code = _folder(Path(os.environ["NUMBA_CACHE_DIR"]), source)
        if code.exists():
            copy = library / source.relative_to(ROOT / "src/vibroimpact")
            shutil.copytree(code, _folder(cache, copy), dirs_exist_ok=True)


def _folder(cache, source):
    """Where Numba keeps what it compiles of the package of a source, good for every copy with the same content."""
    return cache / _CacheLocator.get_suitable_cache_subpath(str(source))
