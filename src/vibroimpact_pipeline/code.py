"""Fingerprints of the code, for the `params` of rules; jobs check them again. Standard library only.

Coarse on purpose: any change of the library makes everything computed again, one of `figures/` every figure.
"""

import hashlib
import os
from collections.abc import Iterator
from functools import cache
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[1]
"""The folder of the packages: `src` of a checkout, or where they are installed."""
SHIPPED = Path(__file__).resolve().with_name("checkout")
"""What a wheel holds of the checkout besides the packages (pyproject.toml says what)."""
INSTALLED = SHIPPED.is_dir()
ROOT = SHIPPED if INSTALLED else SOURCES.parent
"""The checkout, or what an installed pipeline has of it."""
FIGURES = "src/vibroimpact/figures"
PARTS = {
    "library": "src/vibroimpact",
    "figures": FIGURES,
    "pipeline": "src/vibroimpact_pipeline",
    "scripts": "workflow/scripts",
}
"""The folder of each part; the library's without the figures."""


@cache
def fingerprint(part: str) -> str:
    """Return the fingerprint of a part of the code (a name in PARTS), as it was at the first call in this process."""
    return fingerprint_now(part)


def fingerprint_now(part: str) -> str:
    """Return a hash of the names and contents of all files of a part."""
    digest = hashlib.sha256()
    for path in files(part):
        name = f"{PARTS[part]}/{path.relative_to(folder(part))}"  # the same for a checkout and its wheel
        digest.update(f"{name}\n".encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def files(part: str) -> list[Path]:
    """Return all files of a part, sorted."""
    left_out = {"library": folder("figures"), "pipeline": SHIPPED}
    return sorted(_files(folder(part), left_out.get(part)))


def folder(part: str) -> Path:
    """Return the folder of a part; of an installed pipeline, that of the installed package."""
    top, _, inside = PARTS[part].partition("/")
    return SOURCES / inside if INSTALLED and top == "src" else ROOT / PARTS[part]


def _files(folder: Path, left_out: Path | None) -> Iterator[Path]:
    for entry in os.scandir(folder):
        path = Path(entry.path)
        if entry.is_dir() and entry.name != "__pycache__" and path != left_out:
            yield from _files(path, left_out)
        elif entry.is_file() and not entry.name.startswith("."):
            yield path


def stamps(parts) -> dict[Path, tuple[int, int]]:
    """Return mtime and ctime (ns) of every file of the parts; restoring an old version changes its ctime."""
    states = {path: path.stat() for part in parts for path in files(part)}
    return {path: (state.st_mtime_ns, state.st_ctime_ns) for path, state in states.items()}
