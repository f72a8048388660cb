"""What Snakemake remembers of each output: with which parameters it was made.

What it cannot read it forgets, and takes the output for up to date whatever its parameters.
"""

import json
from base64 import urlsafe_b64decode
from collections.abc import Iterator
from pathlib import Path

MEMORY = Path(".snakemake/metadata")


def forgotten() -> Iterator[tuple[str, Path]]:
    """Outputs of which the memory cannot be read, with the file that holds it."""
    for path in MEMORY.rglob("*"):
        if path.is_file() and not _readable(path):
            # A long name is that of nested folders, marked so.
            name = "".join(part.removeprefix("@") for part in path.relative_to(MEMORY).parts)
            yield urlsafe_b64decode(name).decode(), path


def _readable(path):
    try:
        return bool(json.loads(path.read_bytes()))
    except ValueError:
        return False
