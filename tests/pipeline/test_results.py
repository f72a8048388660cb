"""Results on disk: whole or absent, and trusted only with a record that fits."""

import json
import os
from pathlib import Path

import pytest

from vibroimpact_pipeline import results

RESULTS = Path("results")


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def made(path, params, inputs=()):
    """A result as a job leaves it."""
    path = RESULTS / path
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"{path} {params}")
    known = {str(RESULTS / name): results.digest_of(RESULTS / name) for name in inputs}
    results.write_record(path, {"rule": "rule", "params": results.digest_of_data(params), "inputs": known})
    return path


@pytest.fixture
def chain():
    """Three results, each made from the one before."""
    return [made("a.csv", 1), made("b/b.csv", 1, ["a.csv"]), made("c.csv", 1, ["b/b.csv"])]


def distrusted(params=1, makes=lambda path: True):
    return {str(Path(path).name) for path in results.distrusted(RESULTS, lambda path, record: params, makes)}


def test_what_jobs_wrote_is_trusted(chain):
    assert distrusted() == set()


def test_a_rule_that_is_gone_takes_nothing_with_it(chain):
    assert distrusted(params=None) == set()


def test_other_parameters_are_seen_without_any_record_of_snakemake(chain):
    assert distrusted(params=2) == {"a.csv", "b.csv", "c.csv"}


@pytest.mark.parametrize("change", [lambda path: path.write_text("0"), os.unlink], ids=["edited", "deleted"])
def test_what_depends_on_a_changed_or_deleted_result_is_made_again(chain, change):
    change(chain[1])
    assert distrusted() - {"b.csv"} == {"c.csv"}


@pytest.mark.parametrize("content", [None, "", "{", '{"sha256": 1}'])
def test_no_record_or_a_spoilt_one_is_no_trust(chain, content):
    record = results.record_of(chain[0])
    record.unlink() if content is None else record.write_text(content)
    assert distrusted() == {"a.csv", "b.csv", "c.csv"}


def test_two_results_that_changed_places(chain):
    first, second = made("x.csv", 1), made("y.csv", 1)
    first.rename("aside"), second.rename(first), Path("aside").rename(second)
    assert distrusted() == {"x.csv", "y.csv"}


def test_files_of_somebody_else_are_left_alone(chain):
    (RESULTS / "notes.txt").write_text("mine")
    (RESULTS / "logs").mkdir()
    (RESULTS / "logs/log.txt").write_text("a log")
    assert distrusted(makes=lambda path: path != "results/notes.txt") == set()


def test_a_directory_is_one_result():
    folder = RESULTS / "report"
    (folder / "pages").mkdir(parents=True)
    (folder / "pages/index.html").write_text("page")
    results.write_record(folder, {"rule": "report", "params": results.digest_of_data(1), "inputs": {}})
    assert distrusted() == set()
    (folder / "pages/index.html").write_text("another page")
    assert distrusted() == {"report"}
    results.remove(folder)
    assert not folder.exists()
    assert not results.record_of(folder).exists()


def test_inputs_are_checked_before_they_are_read(chain):
    assert set(results.checked_digests(chain)) == set(map(str, chain))
    chain[2].write_text("0")
    with pytest.raises(results.NotAsMade, match=r"results/c\.csv"):
        results.checked_digests(chain)


def test_a_file_of_the_checkout_needs_no_record(tmp_path):
    (tmp_path / "claims.yaml").write_text("claims")
    assert results.checked_digests([tmp_path / "claims.yaml", "claims.yaml"])


def test_a_file_is_replaced_whole_or_not_at_all():
    path = made("a.csv", 1)
    with pytest.raises(ZeroDivisionError), results.replacing(path) as partial:
        partial.write_text("half" * (1 // 0))
    assert path.read_text() == "results/a.csv 1"
    assert {each.name for each in RESULTS.iterdir()} == {results.RECORDS, "a.csv"}


def test_the_disk_holds_content_and_name_before_anything_counts_as_made(monkeypatch):
    """A power cut after a rename that nothing was flushed before leaves an empty file under the new name."""
    order = []
    flush, rename = os.fsync, os.replace
    monkeypatch.setattr(
        os, "fsync", lambda number: (order.append(os.readlink(f"/proc/self/fd/{number}")), flush(number))
    )
    monkeypatch.setattr(os, "replace", lambda old, new: (order.append("renamed"), rename(old, new)))
    with results.replacing("file.txt") as partial:
        partial.write_text("content")
    assert [Path(step).name for step in order] == ["file.txt", "renamed", Path.cwd().name]


def test_a_record_is_json(chain):
    record = json.loads(results.record_of(chain[1]).read_text())
    assert record["inputs"] == {"results/a.csv": results.digest_of(chain[0])}
    assert record["sha256"] == results.digest_of(chain[1])
