"""Fingerprints of the checkout's files behind a job, for the `params` of rules; the job takes them again when it ends.

Coarse on purpose: any change of the library makes everything computed again, one of `figures/` every figure.
Standard library only.
"""

import hashlib
from functools import cache
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[1]
"""The folder of the packages: `src` of a checkout, or where they are installed."""
SHIPPED = Path(__file__).resolve().with_name("checkout")
"""Files of the checkout in a wheel, besides the packages (pyproject.toml lists them)."""
INSTALLED = SHIPPED.is_dir()
ROOT = SHIPPED if INSTALLED else SOURCES.parent
"""The checkout, or the files of it in an installed pipeline."""
FIGURES = "src/vibroimpact/figures"
PARTS = {
    "library": "src/vibroimpact",
    "figures": FIGURES,
    "pipeline": "src/vibroimpact_pipeline",
    "scripts": "workflow/scripts",
    "lock": "environment.lock",
}
"""The file or folder of each part; the library's without the figures."""


@cache
def fingerprint(part: str) -> str:
    """Return the fingerprint of a part (a name in PARTS, or a path), as it was at the first call in this process."""
    return fingerprint_now(part)


def fingerprint_now(part: str) -> str:
    """Return a hash of the names and contents of all files of a part."""
    digest = hashlib.sha256()
    for path in files(part):
        name = f"{PARTS.get(part, part)}/{path.relative_to(folder(part))}"  # the same for a checkout and its wheel
        digest.update(f"{name}\n".encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def files(part: str) -> list[Path]:
    """Return all files of a part, sorted, without bytecode, hidden files and hidden folders (copies of editors)."""
    top, left_out = folder(part), {"library": folder("figures"), "pipeline": SHIPPED}.get(part)
    found = [top] if top.is_file() else (path for path in top.rglob("*") if is_source(path.relative_to(top)))
    found = (path for path in found if path.is_file())
    return sorted(path for path in found if left_out is None or not path.is_relative_to(left_out))


def is_source(path: Path) -> bool:
    """Return True for a path below a folder of sources that is neither hidden nor bytecode."""
    return not any(name.startswith(".") or name == "__pycache__" for name in path.parts)


def folder(part: str) -> Path:
    """Return the folder (or file) of a part; of an installed pipeline, code is in the installed package."""
    top, _, inside = PARTS.get(part, part).partition("/")
    return SOURCES / inside if INSTALLED and top == "src" else ROOT / PARTS.get(part, part)


def change_times(parts) -> dict[Path, int]:
    """Return the ctime (ns) of every file of the parts: putting an old version back changes it, too."""
    return {path: path.stat().st_ctime_ns for part in parts for path in files(part)}
