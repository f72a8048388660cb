"""Make the built project a git checkout with an archive, and unpack archives."""

import os
import shutil
import subprocess
import tarfile
from pathlib import Path

from pipeline_trees import Tree

COMMITTED = "2020-02-03T04:05:06+00:00"
IDENTITY = ["-c", "user.name=A", "-c", "user.email=a@example.org"]


def git(root: Path, *arguments, **variables) -> str:
    """Run a git command without user settings, check that it succeeds, and return its output."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    kept |= {"LC_ALL": "C", "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"} | variables
    run = subprocess.run(["git", *IDENTITY, *arguments], cwd=root, env=kept, capture_output=True, check=False)
    assert run.returncode == 0, run.stderr
    return run.stdout.decode().strip()


def commit(root: Path, date: str = COMMITTED) -> None:
    """Make a folder a git checkout and commit all files that are not ignored."""
    for command in (["init"], ["add", "--all"], ["commit", "--message", "all"]):
        git(root, *command, GIT_COMMITTER_DATE=date)


def checkout(built: Tree, path: Path) -> Tree:
    """Copy the built project to a checkout with one commit and without an archive of an earlier commit."""
    shutil.copytree(built.path, path, symlinks=True, ignore=shutil.ignore_patterns("archive"))
    commit(path)
    return Tree(path)


def archive_of(tree: Tree) -> Path:
    """Return the path of the only archive in a tree."""
    (found,) = (tree / "results/archive").glob("*.tar.gz")
    return found


def unpacked(archive: Path, folder: Path) -> Tree:
    with tarfile.open(archive) as packed:
        packed.extractall(folder, filter="data")
    return Tree(folder / archive.name.removesuffix(".tar.gz"))
