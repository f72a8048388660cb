"""Results on disk: written whole or not at all, each with a record of its content and origin.

The record of `results/a/b.csv` is `results/a/.made/b.csv.json`: the SHA-256 of the result, the rule, its wildcards,
a digest of its parameters (a slice of the config and fingerprints of the code), and the SHA-256 of every input.
A result without a record, or with one that does not fit, counts as not made.
"""

import hashlib
import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

RESULTS = "results"
RECORDS = ".made"
PARTIAL = ".partial-"
"""Prefix of the folders that hold outputs until their job has ended well."""
OF_SNAKEMAKE = ".snakemake_timestamp"
"""A file that Snakemake adds to directories."""
LEFT_ALONE = (RECORDS, "logs", "benchmarks")
"""Folders below the results that hold none."""


class NotAsMade(RuntimeError):
    """A file differs from what its job wrote, or has no record."""


def digest_of(path) -> str:
    """Return the SHA-256 of a file, or for a directory that of the names and digests of all files below it."""
    path = Path(path)
    if path.is_dir():
        below = sorted(file for file in path.rglob("*") if file.is_file() and file.name != OF_SNAKEMAKE)
        return digest_of_data({str(file.relative_to(path)): digest_of(file) for file in below})
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def digest_of_data(data) -> str:
    """Return the SHA-256 of JSON data, such as the parameters of a job."""
    return hashlib.sha256(json.dumps(data, sort_keys=True, default=str).encode()).hexdigest()


def to_disk(path) -> None:
    """Flush a file, or the names in a directory, to disk; a power cut loses a rename without it."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


@contextmanager
def replacing(path) -> Iterator[Path]:
    """Yield a temporary path of the same name; move it to `path` at the end unless an exception is raised."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=PARTIAL, dir=path.parent) as folder:
        yield (partial := Path(folder, path.name))
        put_in_place(partial, path)


def put_in_place(partial: Path, path: Path) -> None:
    """Move a complete file or directory to its path and flush both to disk."""
    for each in [partial, *partial.rglob("*")] if partial.is_dir() else [partial]:
        to_disk(each)
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    os.replace(partial, path)
    to_disk(path.parent)


def record_of(path) -> Path:
    """Return the path of the record of a result."""
    path = Path(path)
    return path.parent / RECORDS / f"{path.name}.json"


def write_record(path, made: Mapping) -> None:
    """Write the record of a result: its digest and how it was made."""
    with replacing(record_of(path)) as partial:
        partial.write_text(json.dumps({"sha256": digest_of(path), **made}, indent=1) + "\n", encoding="utf-8")


def read_record(path) -> dict | None:
    """Return the record of a result, or None if there is none that can be read."""
    try:
        return json.loads(record_of(path).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def is_result(path) -> bool:
    """Return True for a path that jobs write to, False for a file of the checkout."""
    return not Path(path).is_absolute() and RESULTS in Path(path).parts


def checked_digests(paths: Iterable) -> dict[str, str]:
    """Return the SHA-256 of every input of a job, after comparing results with their records.

    Raises:
        NotAsMade: one has no record, or is not what its job wrote.
    """
    digests = {}
    for path in map(str, paths):
        digests[path] = digest_of(path)
        made = read_record(path) if is_result(path) else {"sha256": digests[path]}
        if not made or made.get("sha256") != digests[path]:
            raise NotAsMade(f"{path}: not what its job wrote. Build again: it is removed and made anew.")
    return digests


def distrusted(
    results: Path, params_of: Callable[[str, dict], dict | None], makes: Callable[[str], bool]
) -> dict[str, str]:
    """Return the results that must be made again, with the reason.

    Args:
        results: the directory of the results.
        params_of: of a result and its record the parameters that its job has today; None if they need no look.
        makes: whether a rule makes a path, so that it is not somebody else's file.
    """
    digests = {str(path): digest_of(path) for path in _results(results)}
    records = {path: read_record(path) for path in digests}
    found = {}
    for path, made in records.items():
        if made is None and makes(path):
            found[path] = "without a record of how it was made"
        elif made and digests[path] != made["sha256"]:
            found[path] = "not what their job wrote"
        elif made and (params := params_of(path, made)) is not None and digest_of_data(params) != made["params"]:
            found[path] = "made with other parameters or other code"
    return found | _made_from(found, records, digests)


def _made_from(distrusted, records, digests):
    """Return results made, directly or through others, from inputs that are distrusted, changed or missing."""
    found = {}

    def is_input(name, digest):
        if name in distrusted or name in found:
            return False
        return digests.get(name, None if is_result(name) else digest) == digest

    while True:
        more = {
            path: "made from these"
            for path, made in records.items()
            if made and path not in distrusted and path not in found
            for name, digest in made["inputs"].items()
            if not is_input(name, digest)
        }
        if not more:
            return found
        found |= more


def recorded_files(folder: Path) -> Iterator[Path]:
    """Return all files below a folder that have a record, without results that are directories."""
    return (path for path in sorted(_results(folder)) if path.is_file() and record_of(path).is_file())


def _results(folder: Path) -> Iterator[Path]:
    """Yield files, and directories that are results themselves, below a folder."""
    for path in folder.iterdir() if folder.is_dir() else ():
        if path.name in LEFT_ALONE or path.name.startswith(PARTIAL):
            continue
        if path.is_file() or record_of(path).is_file():
            yield path
        elif path.is_dir():
            yield from _results(path)


def remove(path) -> None:
    """Delete a result and its record."""
    path = Path(path)
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
    record_of(path).unlink(missing_ok=True)
