"""What lies in an archive: files of the checkout, results, and records by which the next build knows them as made."""

import base64
from pathlib import Path

from vibroimpact_pipeline.integrity.checksums import RECORDS as CHECKSUMS

SNAKEMAKE = Path(".snakemake/metadata")
"""Where Snakemake keeps what each file was made of: without it, changes of the config would go unseen."""


def content(root, tracked: list[str], results: list[str]) -> dict[str, Path]:
    """Files by their names in the archive, which are their paths from the root; the build works there.

    Args:
        root: the checkout.
        tracked: its own files.
        results: what was built, paths from the root.
    """
    checksums = (f"{CHECKSUMS}/{result}.sha256" for result in results)
    names = [*tracked, *results, *(name for name in checksums if (root / name).is_file())]
    return {name: root / name for name in [*names, *_snakemake_records(root, set(results))]}


def _snakemake_records(root, results):
    for path in sorted((root / SNAKEMAKE).rglob("*")):
        if path.is_file() and file_of_record(path.relative_to(root / SNAKEMAKE)) in results:
            yield str(path.relative_to(root))


def file_of_record(record: Path) -> str:
    """The file that a record of Snakemake is about: its path in base64, in parts that begin with @ but for the last."""
    return base64.urlsafe_b64decode("".join(part.removeprefix("@") for part in record.parts)).decode()
