"""Write results atomically, and write a record of the content and origin of each result.

The record of `results/a/b.csv` is `.snakemake/sums/results/a/b.csv.json`. A record contains the rule that made the
result, the SHA-256 of the result, and the SHA-256 of each input in results/. A result that was copied from another
build has no record.
"""

import base64
import hashlib
import json
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

RESULTS = "results"
RECORDS = Path(".snakemake/sums")
PARTIAL = ".partial-"
"""Prefix of the folders that contain outputs until their job has succeeded."""
OF_SNAKEMAKE = ".snakemake_timestamp"
"""Name of the file that Snakemake adds to output directories."""


class ModifiedResult(RuntimeError):
    """Raised if a result has been modified since its job wrote it, or has no record."""


def digest_of(path) -> str:
    """Return the SHA-256 of a file. For a directory, return the SHA-256 of the names and digests of its files."""
    path = Path(path)
    if path.is_dir():
        below = sorted(file for file in path.rglob("*") if file.is_file() and file.name != OF_SNAKEMAKE)
        listed = {str(file.relative_to(path)): digest_of(file) for file in below}
        return hashlib.sha256(json.dumps(listed).encode()).hexdigest()
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def to_disk(path) -> None:
    """Flush a file or a directory to disk, so that a power failure does not undo a rename."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def partial_path(path) -> Path:
    """Create an empty folder next to `path`; return the path in this folder that has the same name as `path`."""
    path = Path(path)
    folder = path.with_name(PARTIAL + path.name)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder / path.name


@contextmanager
def replacing(path) -> Iterator[Path]:
    """Yield a temporary path; move the file written there to `path` unless an exception is raised."""
    partial = partial_path(path)
    try:
        yield partial
        put_in_place(partial, Path(path))
    finally:
        shutil.rmtree(partial.parent)


def put_in_place(partial: Path, path: Path) -> None:
    """Move a complete file or directory to its final path and flush it to disk."""
    for each in [partial, *partial.rglob("*")] if partial.is_dir() else [partial]:
        to_disk(each)
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    os.replace(partial, path)
    to_disk(path.parent)


def record_of(path) -> Path:
    """Return the path of the record of a result."""
    return RECORDS / f"{path}.json"


def write_record(path, origin: Mapping) -> None:
    """Write the record of a result: digest, size and origin."""
    with replacing(record_of(path)) as partial:
        partial.write_text(
            json.dumps({"sha256": digest_of(path), "size": os.stat(path).st_size, **origin}, indent=1) + "\n",
            encoding="utf-8",
        )


def read_record(path) -> dict:
    """Return the record of a result, or an empty mapping if there is no readable record."""
    try:
        return dict(json.loads(record_of(path).read_text(encoding="utf-8")))
    except (OSError, TypeError, ValueError):
        return {}


def records() -> dict[str, dict]:
    """Return the records of all existing results in the working directory, by the path of the result."""
    paths = (str(path.relative_to(RECORDS)).removesuffix(".json") for path in sorted(RECORDS.rglob("*.json")))
    return {path: read_record(path) for path in paths if os.path.exists(path)}


def is_result(path) -> bool:
    """Return True for the path of a result, False for a file of the checkout."""
    return not Path(path).is_absolute() and RESULTS in Path(path).parts


def checked_digests(paths: Iterable) -> dict[str, str]:
    """Return the SHA-256 of each result among the inputs of a job, by path.

    Raises
    ------
    ModifiedResult
        If a result has no record or has been modified.
    """
    digests = {path: digest_of(path) for path in map(str, paths) if is_result(path)}
    for path, digest in digests.items():
        if read_record(path).get("sha256") != digest:
            _mark(path)
            raise ModifiedResult(f"{path}: modified since it was built, or without a record; rerun to rebuild")
    return digests


def distrust(outputs: Iterable) -> list[str]:
    """Mark each existing result as incomplete if it has no record or does not match its record.

    Return the paths of the newly marked results. Snakemake rebuilds a marked result when the result is needed.
    """
    # Snakemake removes the mark of a result after the job has written the record. Therefore marks are read before
    # records: if a result has no mark, its record is complete.
    present = [path for path in map(str, outputs) if os.path.exists(path)]
    unmarked = [path for path in present if not _of_snakemake("incomplete", path).exists()]
    found = [path for path in unmarked if not _as_recorded(path)]
    for path in found:
        _mark(path)
    return found


def _mark(path: str) -> None:
    """Mark a result as incomplete."""
    marker = _of_snakemake("incomplete", path)
    marker.parent.mkdir(parents=True, exist_ok=True)
    marker.write_text("{}", encoding="utf-8")


def _as_recorded(path: str) -> bool:
    """Return True if a result matches its record.

    The content of the result is not read if its size is as recorded and three modification times ascend. These are the
    times of the record, of the result, and of Snakemake's own record.
    """
    try:
        # After a build, these times ascend: the job writes the record, then Snakemake touches the result, and then
        # Snakemake writes its own record.
        times = [Path(one).stat().st_mtime_ns for one in (record_of(path), path, _of_snakemake("metadata", path))]
    except OSError:
        return False
    record = read_record(path)
    if times == sorted(times) and record.get("size") == os.stat(path).st_size:
        return True
    return record.get("sha256") == digest_of(path)


def _of_snakemake(folder: str, path: str) -> Path:
    """Return the path of Snakemake's own record of a result; `folder` is "metadata" or "incomplete".

    Snakemake has no public function that returns this path. `_of_snakemake` was tested with Snakemake 9.12 and 9.27.
    """
    name = base64.urlsafe_b64encode(path.encode()).decode()
    *cut, last = (name[start : start + 254] for start in range(0, len(name), 254))
    return Path(".snakemake", folder, *(f"@{part}" for part in cut), last)
