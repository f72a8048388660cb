"""A result that is not what its job wrote is not used, not called right, and not kept: the next build makes it anew."""

import errno
import os
from base64 import urlsafe_b64encode
from pathlib import Path

import pytest

from pipeline_trees import run_module
from vibroimpact_pipeline.integrity import checksums
from vibroimpact_pipeline.integrity.repair import remove_damaged

FIGURE = "companion_10_04"
TABLE = f"results/figures/{FIGURE}.csv"
POINTS = "results/fixed_points/equal.csv"


def ours(output):
    return True


def empty(path):
    path.write_bytes(b"")


def cut(path):
    path.write_bytes(path.read_bytes()[: path.stat().st_size * 6 // 10])


def altered_without_a_trace(path):
    """Same size, same time."""
    times = path.stat()
    path.write_bytes(path.read_bytes().replace(b"1", b"2"))
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))


def contents(tree):
    """All results but what tells how long it took."""
    files = (path for path in (tree / "results").rglob("*") if path.is_file())
    timed = ("benchmarks", "provenance", "notebooks", "logs")
    return {str(path): path.read_bytes() for path in files if not any(word in str(path) for word in timed)}


@pytest.mark.parametrize("damage", [empty, altered_without_a_trace])
def test_a_damaged_output_is_made_anew(drawn, damage):
    before = contents(drawn)
    damage(drawn / TABLE)
    assert f"{TABLE}: not what was written. Removed; made anew when needed." in drawn.snakemake(FIGURE).splitlines()
    assert contents(drawn) == before


def test_a_dry_run_says_so_and_leaves_it(drawn):
    cut(drawn / TABLE)
    before = contents(drawn)
    said = drawn.dry_run(FIGURE)
    assert f"{TABLE}: not what was written. A build removes it; made anew when needed." in said.splitlines()
    assert contents(drawn) == before


def test_an_output_whose_parameters_snakemake_cannot_read_is_made_anew(drawn):
    """It would be taken for up to date whatever its parameters."""
    before = contents(drawn)
    name = urlsafe_b64encode(TABLE.encode()).decode()
    (drawn / ".snakemake/metadata" / name).write_bytes(b"")
    said = drawn.snakemake(FIGURE)
    assert f"{TABLE}: how it was made is not known any more. Removed; made anew when needed." in said.splitlines()
    assert contents(drawn) == before


def test_a_damaged_table_is_made_anew_before_a_figure_is_drawn_from_it(drawn):
    before = contents(drawn)
    cut(drawn / POINTS)
    (drawn / "results/figures/fig10_06.csv").unlink()
    assert f"{POINTS}: not what was written." in drawn.snakemake("fig10_06")
    assert contents(drawn) == before


def test_a_job_on_another_machine_refuses_a_damaged_table(drawn):
    """It is started without a look at all results; the build that sends it has had that before."""
    cut(drawn / POINTS)
    drawn.snakemake("--mode", "remote", "--force", "--allowed-rules", "fig10_06", "--", "fig10_06", check=False)
    assert drawn.returncode != 0
    log = (drawn / "results/logs/figures/fig10_06.log").read_text()
    assert log == f"{POINTS}: not what was written. Build again, which makes it anew.\n"
    assert not list((drawn / "results").rglob("fig10_06.p*"))


def test_a_file_in_a_directory_counts_for_the_directory(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = tmp_path / "results/report/data/index.html"
    page.parent.mkdir(parents=True)
    page.write_text("whole")
    checksums.record(["results/report"])
    (tmp_path / "results/report/.snakemake_timestamp").touch()  # Snakemake's own, later
    said = []
    remove_damaged(said.append, ours, dry_run=False)
    assert said == []
    empty(page)
    remove_damaged(said.append, ours, dry_run=False)
    assert said == ["results/report: not what was written. Removed; made anew when needed."]
    assert not (tmp_path / "results/report").exists()


def test_what_has_no_record_is_taken_as_it_is(drawn):
    (drawn / f"results/checksums/{TABLE}.sha256").unlink()
    cut(drawn / TABLE)
    assert "Nothing to do" in drawn.snakemake(FIGURE)


def test_the_records_are_those_of_sha256sum(drawn):
    records = sorted((drawn / "results/checksums").rglob("*.sha256"))
    lines = [record.read_text() for record in records]
    assert len(lines) == 17  # of two figures, fixed points, orbits with their search, verdicts
    assert all(
        line.endswith(f"  {record.relative_to(drawn / 'results/checksums').with_suffix('')}\n")
        for line, record in zip(lines, records, strict=True)
    )


@pytest.mark.parametrize("asked", ["--summary", "--rulegraph", "--unlock", "--list-target-rules"])
def test_what_builds_nothing_removes_nothing(drawn, asked):
    cut(drawn / TABLE)
    before = contents(drawn)
    status, output = run_module(drawn.path, "snakemake", "--cores", "2", asked)
    assert status == 0, output
    assert contents(drawn) == before


def test_what_cannot_be_read_is_damaged_and_what_cannot_be_removed_is_said(drawn, monkeypatch):
    """As root everything can be read: the disk says no."""
    monkeypatch.chdir(drawn.path)

    def refuse(path, **_):
        raise OSError(errno.EIO, "Input/output error", str(path))

    monkeypatch.setattr(checksums, "digest_of", refuse)
    assert TABLE in checksums.damaged([TABLE])
    monkeypatch.setattr(Path, "unlink", refuse)
    with pytest.raises(OSError, match="Input/output error"):
        remove_damaged(print, ours, dry_run=False)
    assert (drawn / TABLE).exists()


def test_what_no_rule_makes_stays(drawn):
    """A record beside it may be that of somebody else, of a workflow that uses this one as a module say."""
    data, record = drawn / "results/data", drawn / "results/checksums/results/data.sha256"
    data.mkdir()
    (data / "measured.csv").write_text("1\n")
    record.write_text("0" * 64 + " *measured.csv\n")
    assert "results/data" not in drawn.snakemake(FIGURE)
    assert (data / "measured.csv").exists()
    record.unlink()


@pytest.mark.parametrize("name", ["notes.txt", "@part/cmVz"])
def test_a_file_of_somebody_else_in_snakemakes_memory_is_left(drawn, name, monkeypatch):
    monkeypatch.chdir(drawn.path)
    stray = drawn / ".snakemake/metadata" / name
    stray.parent.mkdir(exist_ok=True)
    stray.write_text("")
    remove_damaged(pytest.fail, ours, dry_run=False)
    assert stray.exists()
