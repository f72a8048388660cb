"""Test that results are complete or absent, and rebuilt unless they are unmodified and recorded by Snakemake."""

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


def write_result(snakemake, path, inputs=()):
    """Write a result and its two records, as its job and then Snakemake do."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_text(f"content of {path}")
    digests = {one: result_records.digest_of(one) for one in inputs}
    result_records.write_record(path, {"rule": "rule", "inputs": digests})
    os.utime(path)
    snakemake._write_record(path, MetadataRecord(rule="rule"))


@pytest.fixture
def results(snakemake):
    """Write three results and return their paths."""
    write_result(snakemake, FIRST)
    write_result(snakemake, SECOND, [FIRST])
    write_result(snakemake, LONG)
    return [FIRST, SECOND, LONG]


def incomplete(snakemake, paths):
    """Return the results that Snakemake regards as incomplete."""
    snakemake._clear_cache()
    return snakemake._filter_incomplete_keys(paths)


def test_results_as_written_by_jobs_are_trusted(results, snakemake):
    assert result_records.distrust([*results, "results/not_there.csv"]) == []
    assert incomplete(snakemake, results) == set()


def replace_by_another_result(path, _=None):
    """Copy another result with its date, which is older or newer."""
    shutil.copy2(FIRST if path != FIRST else SECOND, path)


def replace_under_the_same_date(path, _):
    date = os.stat(path).st_mtime_ns
    replace_by_another_result(path)
    os.utime(path, ns=(date, date))


CHANGES = {
    "edited": lambda path, _: Path(path).write_text("0"),
    "edited, with an old date": lambda path, _: [Path(path).write_text("0"), os.utime(path, (1e9, 1e9))],
    "another result": replace_by_another_result,
    "another result, with the same date": replace_under_the_same_date,
    "unknown to Snakemake": lambda path, snakemake: snakemake.cleanup_metadata(IOFile(path)),
    "without record": lambda path, _: result_records.record_of(path).unlink(),
    "with an invalid record": lambda path, _: [
        result_records.record_of(path).write_text("{"),
        os.utime(path, (1e9, 1e9)),
    ],
}


@pytest.mark.parametrize("path", [FIRST, SECOND, LONG], ids=["first", "second", "long"])
@pytest.mark.parametrize("change", CHANGES)
def test_modified_and_unrecorded_results_are_marked_as_incomplete_once(results, snakemake, change, path):
    CHANGES[change](path, snakemake)
    assert result_records.distrust(results) == [path]
    assert incomplete(snakemake, results) == {path}
    assert result_records.distrust(results) == [], "a result is reported once"


def test_results_with_another_date_only_are_trusted(results):
    for path in results:
        os.utime(path)
    assert result_records.distrust(results) == []


def test_results_of_a_running_job_are_left_to_snakemake(results, snakemake):
    """Such a result may differ from its record, but Snakemake has already marked it as incomplete."""
    snakemake._mark_incomplete(FIRST, None)
    Path(FIRST).write_text("0")
    assert result_records.distrust(results) == []


def test_the_checksum_of_a_directory_depends_on_its_files_but_not_on_the_mark_of_snakemake(snakemake):
    folder = Path("results/report")
    (folder / "pages").mkdir(parents=True)
    (folder / "pages/index.html").write_text("page")
    before = result_records.digest_of(folder)
    (folder / result_records.OF_SNAKEMAKE).touch()
    assert result_records.digest_of(folder) == before
    (folder / "pages/index.html").write_text("another page")
    assert result_records.digest_of(folder) != before


@pytest.mark.parametrize("content", [None, "", "{", "[1]", "3", "{}", '{"sha256": 1}'])
def test_an_input_without_a_valid_record_is_refused(results, content):
    record = result_records.record_of(FIRST)
    record.unlink() if content is None else record.write_text(content)
    with pytest.raises(result_records.ModifiedResult, match=r"results/a\.csv"):
        result_records.checked_digests(results)


def test_a_file_is_replaced_as_a_whole_or_not_at_all(results):
    before = Path(FIRST).read_text()
    with pytest.raises(ZeroDivisionError), result_records.replacing(FIRST) as partial:
        partial.write_text("half" * (1 // 0))
    assert Path(FIRST).read_text() == before
    assert not list(Path("results").glob(f"{result_records.PARTIAL}*"))


def test_partial_files_of_a_killed_job_are_deleted_when_the_next_one_starts():
    (partial := result_records.partial_path(FIRST)).write_text("half")
    assert not result_records.partial_path(FIRST).exists()
    assert partial.parent.is_dir()


def test_content_is_flushed_before_the_rename_and_its_folder_after_it(monkeypatch):
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


def test_a_record_has_checksum_size_rule_and_inputs(results):
    record = json.loads(result_records.record_of(SECOND).read_text())
    inputs = {FIRST: result_records.digest_of(FIRST)}
    size = len(Path(SECOND).read_bytes())
    assert record == {"sha256": result_records.digest_of(SECOND), "size": size, "rule": "rule", "inputs": inputs}
    assert result_records.records() == {path: result_records.read_record(path) for path in results}
