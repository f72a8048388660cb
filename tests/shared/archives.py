"""The built project as a git checkout with its archive, and archives unpacked."""

import os
import shutil
import tarfile
from pathlib import Path

from pipeline_trees import Tree
from vibroimpact_pipeline.git import call

COMMITTED = "2020-02-03T04:05:06+00:00"
IDENTITY = ["-c", "user.name=A", "-c", "user.email=a@example.org"]


def git(root: Path, *arguments, **variables) -> str:
    """Output of a git command that works, as a user without settings calls it."""
    run = call(*IDENTITY, *arguments, root=root, GIT_CONFIG_GLOBAL=os.devnull, **variables)
    assert run.returncode == 0, run.stderr
    return run.stdout.decode().strip()


def commit(root: Path, date: str = COMMITTED) -> None:
    """Make a folder a git checkout of all that it does not ignore."""
    for command in (["init"], ["add", "--all"], ["commit", "--message", "all"]):
        git(root, *command, GIT_COMMITTER_DATE=date)


def checkout(built: Tree, path: Path) -> Tree:
    """The built project as a checkout with one commit, without an archive of an earlier one."""
    shutil.copytree(built.path, path, symlinks=True, ignore=shutil.ignore_patterns("archive"))
    commit(path)
    return Tree(path)


def archive_of(tree: Tree) -> Path:
    """The one archive of a tree."""
    (found,) = (tree / "results/archive").glob("*.tar.gz")
    return found


def unpacked(archive: Path, folder: Path) -> Tree:
    with tarfile.open(archive) as packed:
        packed.extractall(folder, filter="data")
    return Tree(folder / archive.name.removesuffix(".tar.gz"))
