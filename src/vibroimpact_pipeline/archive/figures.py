"""The figures of a build, as the records beside them tell."""

import json
from dataclasses import dataclass
from pathlib import Path

from vibroimpact_pipeline.integrity.checksums import digest_of
from vibroimpact_pipeline.provenance.record import LOCK
from vibroimpact_pipeline.same_bytes import has_time

RECORD = ".provenance.json"


@dataclass(frozen=True)
class Figure:
    """A figure: its name, its record, and the path of the record."""

    name: str
    record: dict
    path: Path

    @property
    def files(self) -> list[str]:
        """Its files, paths from where the build worked."""
        return list(self.record["outputs"])

    @property
    def picture(self) -> str:
        return next(file for file in self.files if file.endswith(".png"))

    @property
    def timed(self) -> bool:
        """Whether it shows run times, and so other numbers in every build."""
        table = self.path.with_name(f"{self.name}.csv")
        return table.is_file() and has_time(table)


def figures(results) -> list[Figure]:
    """The figures among some results, by name."""
    records = sorted(Path(path) for path in results if str(path).endswith(RECORD))
    return [
        Figure(path.name.removesuffix(RECORD), json.loads(path.read_text(encoding="utf-8")), path) for path in records
    ]


def check_environment(made: list[Figure], root) -> None:
    """See that all figures were made with the packages that the archive will name.

    Snakemake looks at code, config and inputs, not at this.

    Raises:
        ValueError: some were made with another environment.lock.
    """
    lock = digest_of(Path(root) / LOCK)
    if others := [figure.name for figure in made if figure.record["lock"] != lock]:
        names = " ".join(others)
        raise ValueError(
            f"{LOCK} has changed since these figures were made, so that they might come out otherwise. "
            f"Make them anew: snakemake --forcerun {names} -- archive"
        )
