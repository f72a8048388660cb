"""Copies of the project in which tests run builds; some are made only once for all test processes."""

import fcntl
import multiprocessing
import os
import re
import runpy
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from compiled_code import share

ROOT = Path(__file__).parents[2]
HIDDEN = [".git", ".venv", ".cache", ".snakemake", ".*_cache", ".hypothesis"]
NOT_COPIED = shutil.ignore_patterns(*HIDDEN, "results", "tries", "*.egg-info", "tests", "__pycache__")
CORES = ["--cores", "2"]
SNAKEMAKE = [str(Path(sys.executable).with_name("snakemake")), *CORES]
FORKS = multiprocessing.get_context("forkserver")
FORKS.set_forkserver_preload(["snakemake.cli", "matplotlib.figure", "matplotlib.style"])
"""Context for processes that have these modules imported, which takes most of the time of short commands."""


class Tree:
    """A directory with all files that a build needs."""

    def __init__(self, path: Path):
        self.path = path

    def __truediv__(self, name):
        return self.path / name

    def snakemake(self, *arguments, check=True, prefix=(), **environment) -> str:
        """Run Snakemake after the words `prefix`, and return its output; a variable that is None is unset."""
        if prefix or environment:
            run = self.start(*arguments, prefix=prefix, **environment)
            output = run.communicate()[0]
            self.returncode = run.returncode
        else:
            self.returncode, output = run_module(self.path, "snakemake", *CORES, *arguments)
        assert not check or self.returncode == 0, output
        return output

    def start(self, *arguments, prefix=(), **environment) -> subprocess.Popen:
        """Start Snakemake in the background in its own process group; a variable that is None is unset."""
        return subprocess.Popen(
            [*prefix, *SNAKEMAKE, *arguments],
            cwd=self.path,
            env={name: value for name, value in {**os.environ, **environment}.items() if value is not None},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )

    def dry_run(self, *arguments) -> str:
        """Return the output of a dry run of Snakemake with the library of the tree."""
        return self.snakemake("--dry-run", *arguments, check=False)

    def planned(self, *arguments) -> set[str]:
        """Return the rules that a build would run, without targets that only collect files."""
        output = self.dry_run(*arguments, "--quiet", "host")
        assert self.returncode == 0, output
        rules = set(re.findall(r"^(?:local)?(?:rule|checkpoint) (\w+)", output, re.MULTILINE))
        return rules - {"all", "figures", "stability", "companions", "accuracy", "sweeps", "studies"}

    def edit(self, name, old, new):
        """Replace a text in a file of the tree; the file must contain the text."""
        text = (self / name).read_text(encoding="utf-8")
        assert old in text
        (self / name).write_text(text.replace(old, new), encoding="utf-8")


def copied(source: Path, path: Path) -> Tree:
    shutil.copytree(source, path, symlinks=True, ignore=NOT_COPIED)
    share(path / "src/vibroimpact")
    return Tree(path)


def with_results(source: Path, path: Path) -> Tree:
    """Copy a tree with its results and their records, so that a build in the copy makes only the rest."""
    tree = copied(source, path)
    for made in ("results", ".snakemake/metadata", ".snakemake/sums"):
        if (source / made).exists():
            shutil.copytree(source / made, path / made, symlinks=True)
    return tree


def whole_copy(source: Tree, path: Path) -> Tree:
    """Copy a tree with its results and its compiled code."""
    shutil.copytree(source.path, path, symlinks=True, ignore=shutil.ignore_patterns("locks", "compiled-*"))
    share(path / "src/vibroimpact")
    return Tree(path)


def without_studies(tree: Tree) -> Tree:
    """Delete every folder and file named `studies` in a tree, and return the tree."""
    for path in [*tree.path.rglob("studies"), *tree.path.rglob("studies.*")]:
        if ".snakemake" not in path.parts:
            shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
    return tree


def run_module(tree: Path, module: str, *arguments: str) -> tuple[int, str]:
    """Run `python -m module` in a tree with the library of the tree; return exit status and output."""
    with tempfile.NamedTemporaryFile("r", encoding="utf-8") as output:
        process = FORKS.Process(target=_run_module, args=(tree, output.name, module, arguments))
        process.start()
        process.join()
        return process.exitcode, output.read()


def _run_module(tree, output, module, arguments):
    os.chdir(tree)
    with open(output, "w", encoding="utf-8") as file:
        for stream in (sys.stdout, sys.stderr):
            os.dup2(file.fileno(), stream.fileno())
    sys.path.insert(0, str(tree / "src"))
    sys.argv[1:] = arguments
    runpy.run_module(module, run_name="__main__", alter_sys=True)


def made_once(tmp_path_factory, name: str, copy: Callable[[Path], object], *targets) -> Tree:
    """Return a tree that the first test process copies and builds. Tests may read it, but must not change it.

    A failed build is not repeated.
    """
    shared = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        shared = shared.parent
    tree, made, failed = Tree(shared / name), shared / f"{name}.made", shared / f"{name}.failed"
    with open(shared / f"{name}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert not failed.exists(), failed.read_text()
        if not made.exists():
            shutil.rmtree(tree.path, ignore_errors=True)
            copy(tree.path)
            output = tree.snakemake(*targets, check=False)
            if tree.returncode:
                failed.write_text(output)
            assert tree.returncode == 0, output
            made.touch()
    return tree
