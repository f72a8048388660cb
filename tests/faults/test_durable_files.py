"""A file bears its name only when the disk holds its content."""

import errno
import os
from pathlib import Path

import pytest

from vibroimpact.figures.kit.files import replacing
from vibroimpact_pipeline.integrity import checksums


@pytest.fixture
def calls(monkeypatch):
    """What is asked of the system in order: `sync` of a file or directory, `name` of a file."""
    asked, sync, replace = [], os.fsync, os.replace

    def note_sync(descriptor):
        asked.append(("sync", os.readlink(f"/proc/self/fd/{descriptor}")))
        sync(descriptor)

    def note_name(old, new):
        asked.append(("name", str(old), str(new)))
        replace(old, new)

    monkeypatch.setattr(os, "fsync", note_sync)
    monkeypatch.setattr(os, "replace", note_name)
    return asked


def test_the_content_comes_before_the_name_and_the_name_before_the_end(tmp_path, calls):
    with replacing(tmp_path / "table.csv") as partial:
        partial.write_text("x\n1\n")
        assert calls == []
    partial, target = str(partial), str(tmp_path / "table.csv")
    assert calls == [("sync", partial), ("name", partial, target), ("sync", str(tmp_path))]


def test_a_disk_that_does_not_take_it_leaves_the_old_file(tmp_path, monkeypatch):
    target = tmp_path / "table.csv"
    target.write_text("old")

    def full(descriptor):
        raise OSError(errno.EIO, "Input/output error")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="Input/output"), replacing(target) as partial:
        partial.write_text("new")
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_file_system_that_cannot_sync_directories_is_no_error(tmp_path, monkeypatch):
    sync = os.fsync

    def files_only(descriptor):
        if Path(f"/proc/self/fd/{descriptor}").resolve().is_dir():
            raise OSError(errno.EINVAL, "Invalid argument")
        sync(descriptor)

    monkeypatch.setattr(os, "fsync", files_only)
    with replacing(tmp_path / "table.csv") as partial:
        partial.write_text("new")
    assert (tmp_path / "table.csv").read_text() == "new"


def test_a_directory_reaches_the_disk_before_its_record(tmp_path, calls, monkeypatch):
    """Outputs that no job puts into place file by file: the pages of the report."""
    monkeypatch.chdir(tmp_path)
    pages = [tmp_path / "results/report/index.html", tmp_path / "results/report/data/points.csv"]
    for page in pages:
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(page.name)
    checksums.record(["results/report"])
    first_name = next(n for n, call in enumerate(calls) if call[0] == "name")
    synced = {path for _, path in calls[: first_name - 1]}
    assert synced == {str(path) for page in pages for path in (page, page.parent)}
