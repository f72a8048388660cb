"""What Snakemake remembers of each output: with which parameters it was made.

What it cannot read it forgets, and takes the output for up to date whatever its parameters.
"""

import json
from base64 import urlsafe_b64decode
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

MEMORY = Path(".snakemake/metadata")


def forgotten() -> Iterator[tuple[str, Path]]:
    """Outputs of which the memory cannot be read, with the file that holds it."""
    for path in MEMORY.rglob("*"):
        if path.is_file() and not _readable(path):
            with suppress(ValueError):  # a file of somebody else
                yield _output(path), path


def _output(path):
    """A long name is cut into those of nested folders, which are marked."""
    name = "".join(part.removeprefix("@") for part in path.relative_to(MEMORY).parts)
    return urlsafe_b64decode(name).decode()


def _readable(path):
    try:
        return bool(json.loads(path.read_bytes()))
    except ValueError:
        return False
