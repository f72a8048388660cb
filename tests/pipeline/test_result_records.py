"""Test that results are complete or absent, and trusted only with Snakemake's record and unmodified content."""

import json
import os
import shutil
from pathlib import Path

import pytest
from snakemake.io import IOFile
from snakemake.persistence import MetadataRecord
from snakemake.persistence.file import FilePersistence

from vibroimpact_pipeline import result_records

FIRST, SECOND = "results/a.csv", "results/b/b.csv"
LONG = f"results/{'long/' * 50}c.csv"
"""Path of a result; Snakemake splits the long name of its record into two parts."""


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def snakemake():
    """Return the records of Snakemake itself, managed by the code of Snakemake."""
    return FilePersistence(nolock=True)


def as_made(snakemake, path, inputs=()):
    """Write a result and its records, in the order in which its job and then Snakemake do so."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_text(f"content of {path}")
    digests = {one: result_records.digest_of(one) for one in inputs}
    result_records.write_record(path, {"rule": "rule", "inputs": digests})
    os.utime(path)
    snakemake._write_record(path, MetadataRecord(rule="rule"))


@pytest.fixture
def made(snakemake):
    as_made(snakemake, FIRST)
    as_made(snakemake, SECOND, [FIRST])
    as_made(snakemake, LONG)
    return [FIRST, SECOND, LONG]


def marked(snakemake, paths):
    snakemake._clear_cache()
    return snakemake._filter_incomplete_keys(paths)


def test_what_jobs_wrote_is_trusted(made, snakemake):
    assert result_records.distrust([*made, "results/not_there.csv"]) == []
    assert marked(snakemake, made) == set()


def of_another_config(path, _=None):
    """Copy another result with its date, which is older or newer."""
    shutil.copy2(FIRST if path != FIRST else SECOND, path)


def of_a_job_that_ended_with_it(path, _):
    date = os.stat(path).st_mtime_ns
    of_another_config(path)
    os.utime(path, ns=(date, date))


CHANGES = {
    "edited": lambda path, _: Path(path).write_text("0"),
    "edited under an old date": lambda path, _: [Path(path).write_text("0"), os.utime(path, (1e9, 1e9))],
    "of another config": of_another_config,
    "of a job that ended with it": of_a_job_that_ended_with_it,
    "unknown to Snakemake": lambda path, snakemake: snakemake.cleanup_metadata(IOFile(path)),
    "without record": lambda path, _: result_records.record_of(path).unlink(),
    "with a spoilt record": lambda path, _: [
        result_records.record_of(path).write_text("{"),
        os.utime(path, (1e9, 1e9)),
    ],
}


@pytest.mark.parametrize("path", [FIRST, SECOND, LONG], ids=["first", "second", "long"])
@pytest.mark.parametrize("change", CHANGES)
def test_another_file_and_one_that_is_not_known_are_marked_for_snakemake(made, snakemake, change, path):
    CHANGES[change](path, snakemake)
    assert result_records.distrust(made) == [path]
    assert marked(snakemake, made) == {path}
    assert result_records.distrust(made) == [], "said once"


def test_what_was_only_touched_or_copied_is_trusted(made):
    for path in made:
        os.utime(path)
    assert result_records.distrust(made) == []


def test_of_a_job_that_runs_snakemake_knows_more(made, snakemake):
    """The result of a running job may be newer than its records; Snakemake has marked it, so `distrust` skips it."""
    snakemake._mark_incomplete(FIRST, None)
    Path(FIRST).write_text("0")
    assert result_records.distrust(made) == []


def test_a_directory_is_one_result(snakemake):
    folder = Path("results/report")
    (folder / "pages").mkdir(parents=True)
    (folder / "pages/index.html").write_text("page")
    before = result_records.digest_of(folder)
    (folder / result_records.OF_SNAKEMAKE).touch()
    assert result_records.digest_of(folder) == before
    (folder / "pages/index.html").write_text("another page")
    assert result_records.digest_of(folder) != before


@pytest.mark.parametrize("content", [None, "", "{", "[1]", "3", "{}", '{"sha256": 1}'])
def test_a_job_reads_no_input_with_a_spoilt_record(made, content):
    record = result_records.record_of(FIRST)
    record.unlink() if content is None else record.write_text(content)
    with pytest.raises(result_records.ModifiedResult, match=r"results/a\.csv"):
        result_records.checked_digests(made)


def test_a_file_is_replaced_whole_or_not_at_all(made):
    before = Path(FIRST).read_text()
    with pytest.raises(ZeroDivisionError), result_records.replacing(FIRST) as partial:
        partial.write_text("half" * (1 // 0))
    assert Path(FIRST).read_text() == before
    assert not list(Path("results").glob(f"{result_records.PARTIAL}*"))


def test_what_a_killed_job_has_left_goes_when_the_next_begins():
    (left := result_records.partial_path(FIRST)).write_text("half")
    assert not result_records.partial_path(FIRST).exists()
    assert left.parent.is_dir()


def test_the_disk_holds_content_and_name_before_anything_counts_as_made(monkeypatch):
    """Without a flush before a rename, a power failure could leave an empty file under the final name."""
    order = []
    flush, rename = os.fsync, os.replace
    monkeypatch.setattr(
        os, "fsync", lambda number: (order.append(os.readlink(f"/proc/self/fd/{number}")), flush(number))
    )
    monkeypatch.setattr(os, "replace", lambda old, new: (order.append("renamed"), rename(old, new)))
    with result_records.replacing("file.txt") as partial:
        partial.write_text("content")
    assert [Path(step).name for step in order] == ["file.txt", "renamed", Path.cwd().name]


def test_a_record_is_json(made):
    record = json.loads(result_records.record_of(SECOND).read_text())
    inputs = {FIRST: result_records.digest_of(FIRST)}
    size = len(Path(SECOND).read_bytes())
    assert record == {"sha256": result_records.digest_of(SECOND), "size": size, "rule": "rule", "inputs": inputs}
    assert result_records.records() == {path: result_records.read_record(path) for path in made}
