"""What jobs wrote: the SHA-256 of every output, so that damage shows.

The record of an output lies below results/checksums/, in the form of `sha256sum`, by the path of the output from the
working directory. An output without a record is taken as it is.
"""

import hashlib
from collections.abc import Iterable, Iterator
from pathlib import Path

from vibroimpact.figures.kit.files import keep, replacing

RECORDS = Path("results/checksums")


class Damaged(RuntimeError):
    """A file is not what its job wrote."""


def record(outputs: Iterable[str]) -> None:
    """Write down what outputs are; from now on they survive a power cut, and so does the record."""
    files = {output: _files(Path(output)) for output in outputs}
    written = {path for paths in files.values() for path in paths}
    for path in [*written, *{path.parent for path in written}]:
        keep(path)
    for output, paths in files.items():
        with replacing(_record_of(output)) as partial:
            partial.write_text("".join(f"{digest_of(path)}  {path}\n" for path in paths), encoding="utf-8")


def forget(outputs: Iterable[str]) -> None:
    """Drop the records of outputs that are about to be made."""
    for output in outputs:
        _record_of(output).unlink(missing_ok=True)


def expect(outputs: Iterable[str]) -> None:
    """See that outputs are what their records say.

    Raises:
        Damaged: one of them is not.
    """
    if found := damaged(outputs):
        raise Damaged(f"{', '.join(found)}: not what was written. Build again, which makes it anew.")


def damaged(outputs: Iterable[str]) -> list[str]:
    """Those of some outputs that are not what their records say: of a directory, where one of its files is not."""
    return [str(output) for output in outputs if not _as_written(output)]


def recorded() -> Iterator[str]:
    """All outputs that have a record and are there."""
    for path in sorted(RECORDS.rglob("*.sha256")):
        output = path.relative_to(RECORDS).with_suffix("")
        if output.exists():
            yield str(output)


def has_record(output) -> bool:
    return _record_of(output).is_file()


def digest_of(path) -> str:
    """SHA-256 of a file's content, in hexadecimal digits."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _record_of(output):
    return Path(f"{RECORDS}/{output}.sha256")


def _as_written(output):
    if not has_record(output):
        return True
    try:
        lines = _record_of(output).read_text(encoding="utf-8", errors="replace").splitlines()
        return lines != [] and all(_matches(output, *line.partition("  ")[::2]) for line in lines)
    except OSError:  # what cannot be read is no better than what reads otherwise
        return False


def _matches(output, digest, name):
    path = Path(name)
    return path.is_relative_to(output) and path.is_file() and digest_of(path) == digest


def _files(output):
    return sorted(path for path in output.rglob("*") if path.is_file()) if output.is_dir() else [output]
