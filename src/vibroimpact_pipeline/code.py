"""Fingerprints of the code, with the standard library alone: what a rule's `params` say and its job checks again.

Coarse on purpose: any change of the library makes everything computed again, one of `figures/` every figure.
"""

import hashlib
import os
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
"""The checkout."""
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
    """The fingerprint of a part of the code, by its name in PARTS, as it was when this process first asked."""
    return fingerprint_now(part)


def fingerprint_now(part: str) -> str:
    """Hash of the names and contents of all files of a part."""
    digest = hashlib.sha256()
    for path in files(part):
        digest.update(f"{path.relative_to(ROOT)}\n".encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def files(part: str) -> list[Path]:
    """All files of a part, sorted."""
    return sorted(_files(ROOT / PARTS[part], ROOT / FIGURES if part == "library" else None))


def _files(folder: Path, left_out: Path | None) -> Iterator[Path]:
    for entry in os.scandir(folder):
        path = Path(entry.path)
        if entry.is_dir() and entry.name != "__pycache__" and path != left_out:
            yield from _files(path, left_out)
        elif entry.is_file() and not entry.name.startswith("."):
            yield path


def stamps(parts) -> dict[Path, tuple[int, int]]:
    """Times of the last change of content and of state (ns) of every file; putting an old version back changes them."""
    states = {path: path.stat() for part in parts for path in files(part)}
    return {path: (state.st_mtime_ns, state.st_ctime_ns) for path, state in states.items()}
