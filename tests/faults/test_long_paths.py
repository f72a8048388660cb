"""Long paths: sockets have names of 107 characters at most, the line that starts a script 127 or 255."""

import sys
from pathlib import Path

FIGURE = "fig10_03"
"""Drawn by a notebook, whose kernel is spoken to through sockets."""


def long(folder: Path, length: int) -> Path:
    """A new folder below another one, with a path of so many characters."""
    path = folder / (max(1, length - len(str(folder)) - 1) * "x")
    path.mkdir()
    return path


def test_a_long_checkout_and_a_longer_folder_for_temporary_files(tree, tmp_path):
    there = tree.path.rename(long(tmp_path, 150) / "tree")
    tree.path = there
    (tree / ".venv").symlink_to(sys.prefix)
    temporary = long(tmp_path, 200)
    tree.snakemake(FIGURE, prefix=[there / ".venv/bin/python"], TMPDIR=str(temporary))
    assert (tree / f"results/notebooks/{FIGURE}.html").exists()
    assert list(temporary.iterdir()) == []
