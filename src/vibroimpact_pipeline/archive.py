"""Write the archive of a build: committed sources, results, and an RO-Crate with the checksums of all files."""

import gzip
import io
import tarfile
import tempfile
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

import yaml

from vibroimpact.system.extras import need
from vibroimpact_pipeline.git import committed, git, output
from vibroimpact_pipeline.result_records import digest_of, records

need("archive", "rocrate")

from rocrate.model import ContextEntity  # noqa: E402 (after the dependency check)
from rocrate.rocrate import ROCrate  # noqa: E402

WORKFLOW = "Snakefile"


def results_behind(targets: list[str]) -> list[Path]:
    """Return the targets and all results on which they depend.

    The list also contains all other outputs of the jobs that made these results. Results of other jobs may be outdated
    and are excluded.
    """
    known = {path: record for path, record in records().items() if Path(path).is_file()}
    behind, pending = set(), list(targets)
    while pending:
        path = pending.pop(0)
        if path in known and path not in behind:
            behind.add(path)
            pending += known[path].get("inputs", ())
    jobs = [_job(known[path]) for path in behind]
    return sorted(Path(path) for path, record in known.items() if _job(record) in jobs)


def _job(record):
    return record.get("rule"), record.get("wildcards")


def differences(one, other, place: str = "") -> Iterator[tuple]:
    """Yield (key path, value in `one`, value in `other`) for each difference between nested mappings.

    If one mapping lacks a key, the value that is yielded for this mapping is None.
    """
    if isinstance(one, dict) and isinstance(other, dict):
        for name in one | other:
            yield from differences(one.get(name), other.get(name), f"{place}.{name}".removeprefix("."))
    elif one != other:
        yield place, one, other


def write(root: Path, results: list[Path], titles: dict[str, str], path) -> None:
    """Write the .tar.gz archive of a checkout; raise ValueError if the checkout is not clean.

    `titles` is a mapping from the names of the figures to their titles.
    """
    commit = committed(root)
    cited = yaml.safe_load((root / "CITATION.cff").read_text(encoding="utf-8"))
    time, date = git("log", "-1", "--format=%ct %cI", root=root).split()
    with tempfile.TemporaryDirectory(dir=Path(path).parent) as folder:
        staged = Path(folder, f"vibroimpact-{cited['version']}-{commit[:12]}")
        staged.mkdir()
        with tarfile.open(fileobj=io.BytesIO(output("archive", commit, root=root))) as sources:
            # The filter rejects unsafe members of the archive. Python before 3.11.4 has no such filter.
            sources.extraction_filter = getattr(tarfile, "data_filter", None)
            sources.extractall(staged)
        for result in results:
            (staged / result).parent.mkdir(parents=True, exist_ok=True)
            (staged / result).hardlink_to(result)
        crate(staged, cited, commit, date, titles).metadata.write(staged)
        with (
            gzip.GzipFile(path, "wb", compresslevel=6, mtime=int(time)) as packed,
            tarfile.open(fileobj=packed, mode="w") as archive,
        ):
            archive.add(staged, staged.name, filter=lambda member: _plain(member, int(time)))


def crate(folder: Path, cited: dict, commit: str, date: str, titles: dict[str, str]) -> ROCrate:
    """Return an RO-Crate, an object that describes a folder and each file in it."""
    described = ROCrate()
    written_in = {"lang": "snakemake", "lang_version": version("snakemake")}
    workflow = described.add_workflow(None, WORKFLOW, main=True, **written_in, properties={"name": "The pipeline"})
    authors = [
        ContextEntity(described, f"#author-{number}", properties={"@type": "Organization", "name": author["name"]})
        for number, author in enumerate(cited["authors"], 1)
    ]
    described.add(*authors)
    described.name = cited["title"]
    described.description = f"Sources of commit {commit} and its results."
    described.license = f"https://spdx.org/licenses/{cited['license']}"
    described.root_dataset["author"] = workflow["author"] = authors
    described.datePublished = date
    described.root_dataset["version"], described.root_dataset["identifier"] = cited["version"], commit
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        name = str(path.relative_to(folder))
        if name != WORKFLOW:
            about = titles.get(path.name.split(".")[0], name)
            properties = {"name": about, "contentSize": str(path.stat().st_size), "sha256": digest_of(path)}
            described.add_file(None, name, properties=properties)
    return described


def _plain(member: tarfile.TarInfo, time: int) -> tarfile.TarInfo:
    """Normalise owner, time and mode of an archive entry, so that equal files give identical archives."""
    member.uid = member.gid = 0
    member.uname = member.gname = ""
    member.mtime, member.mode = time, 0o755 if member.isdir() or member.mode & 0o100 else 0o644
    return member
