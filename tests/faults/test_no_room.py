"""A place that cannot be written to, and a disk that is full: said with its path, and a later build goes on."""

import os
from pathlib import Path
from types import SimpleNamespace

import pytest

from namespaces import mounted, read_only
from snakemake_logger_plugin_brief import disks
from vibroimpact.figures.kit.files import replacing

FIGURE = "companion_10_04"


@pytest.mark.parametrize("folder", ["results", ".cache", ".snakemake"])
def test_a_folder_that_cannot_be_written_to_is_named_in_a_line(tree, folder):
    (tree / folder).mkdir()
    output = tree.snakemake(FIGURE, prefix=read_only(folder), check=False)
    assert tree.returncode == 1
    [line] = [line for line in output.splitlines() if line.startswith(f"{folder}: ")]
    assert "build in another one, with --directory" in line
    assert "Traceback" not in output


def test_what_asks_only_still_answers_where_results_cannot_be_written_to(tree):
    (tree / "results").mkdir()
    assert FIGURE in tree.snakemake("--dry-run", FIGURE, prefix=read_only("results"))


@pytest.mark.parametrize("limit", ["size=16k", pytest.param("nr_inodes=4", marks=pytest.mark.thorough)])
def test_a_full_disk_is_named_nothing_half_written_counts_and_the_next_build_goes_on(tree, limit):
    """The disk is gone with the command; what is left on it is copied to where the next build finds it."""
    (tree / "results").mkdir()
    keep = "trap 'cp -a results kept' EXIT"
    prefix = mounted(f"mount -t tmpfs -o {limit} tmpfs results && {keep}")
    output = tree.snakemake(FIGURE, prefix=[*prefix[:-2], prefix[-2].replace("exec ", ""), prefix[-1]], check=False)
    assert tree.returncode == 1
    assert "No room on the disk of results/" in output
    (tree / "results").rmdir()
    (tree / "kept").rename(tree / "results")
    left = [path for path in (tree / "results").rglob("*") if "partial" in path.name]
    assert left == []
    tree.snakemake(FIGURE)
    assert (tree / f"results/figures/{FIGURE}.png").read_bytes().startswith(b"\x89PNG")


def test_a_cache_without_room_is_named_in_a_line(tree):
    (tree / ".cache").mkdir()
    output = tree.snakemake(FIGURE, prefix=mounted("mount -t tmpfs -o size=8k,nr_inodes=3 tmpfs .cache"), check=False)
    assert tree.returncode == 1
    [line] = [line for line in output.splitlines() if "/.cache/" in line]
    assert ": No space left on device. Results, records and locks come into the working directory: " in line
    assert "Traceback" not in output


def test_a_write_that_fails_names_the_file(tmp_path):
    with pytest.raises(OSError, match=r"No space left on device: '.*/table\.csv'"), replacing(tmp_path / "table.csv"):
        raise OSError(28, "No space left on device")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("numbers", "expected"),
    [
        ({"f_bavail": 100, "f_files": 9, "f_favail": 9}, ["results"]),
        ({"f_bavail": 10_000, "f_files": 9, "f_favail": 0}, ["results"]),
        ({"f_bavail": 10_000, "f_files": 0, "f_favail": 0}, []),
        ({"f_bavail": 10_000, "f_files": 9, "f_favail": 9}, []),
    ],
    ids=["bytes", "files", "no number of files", "room"],
)
def test_when_a_disk_is_full(tmp_path, monkeypatch, numbers, expected):
    monkeypatch.chdir(tmp_path)
    Path("results").mkdir()
    monkeypatch.setattr(os, "statvfs", lambda path: SimpleNamespace(f_frsize=4096, **numbers))
    assert disks.full() == expected
