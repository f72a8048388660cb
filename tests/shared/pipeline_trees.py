"""Copies of the project to build in, and what is made once for all test processes."""

import fcntl
import multiprocessing
import os
import runpy
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from compiled_code import share

ROOT = Path(__file__).parents[2]
NOT_COPIED = shutil.ignore_patterns(
    ".git",
    ".venv",
    ".cache",
    ".snakemake",
    "results",
    "tries",
    ".*_cache",
    ".hypothesis",
    "*.egg-info",
    "tests",
    "__pycache__",
)
CORES = ["--cores", "2"]
SNAKEMAKE = [str(Path(sys.executable).with_name("snakemake")), *CORES]
FORKS = multiprocessing.get_context("forkserver")
FORKS.set_forkserver_preload(["snakemake.cli", "matplotlib.figure", "matplotlib.style"])
"""Processes that have imported these already: most of what commands of a second spend their time on."""


class Tree:
    """A directory with everything that a build needs."""

    def __init__(self, path: Path):
        self.path = path

    def __truediv__(self, name):
        return self.path / name

    def snakemake(self, *arguments, check=True, prefix=(), **environment) -> str:
        """Output of one Snakemake call, started by the command `prefix`; a variable that is None is not set."""
        if prefix or environment:
            run = self.start(*arguments, prefix=prefix, **environment)
            output = run.communicate()[0]
            self.returncode = run.returncode
        else:
            self.returncode, output = run_module(self.path, "snakemake", *CORES, *arguments)
        assert not check or self.returncode == 0, output
        return output

    def start(self, *arguments, prefix=(), **environment) -> subprocess.Popen:
        """A Snakemake call in the background, in a process group of its own; a variable that is None is not set."""
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
        """Output of one Snakemake call that builds nothing, with the library of the tree."""
        return self.snakemake("--dry-run", *arguments, check=False)

    def planned(self, *arguments) -> set[str]:
        """Rules that a build would run, but for the targets that only gather."""
        output = self.dry_run(*arguments, "--quiet", "host")
        assert self.returncode == 0, output
        rules = {
            line.split()[1].rstrip(":")
            for line in output.splitlines()
            if line.startswith(("rule ", "localrule ", "checkpoint "))
        }
        return rules - {"all", "figures", "stability", "companions", "accuracy", "sweeps", "studies"}

    def edit(self, name, old, new):
        """Replace a text that must be there in a file of the tree."""
        text = (self / name).read_text(encoding="utf-8")
        assert old in text
        (self / name).write_text(text.replace(old, new), encoding="utf-8")


def copied(source: Path, path: Path) -> Tree:
    shutil.copytree(source, path, symlinks=True, ignore=NOT_COPIED)
    share(path / "src/vibroimpact")
    return Tree(path)


def with_results(source: Path, path: Path) -> Tree:
    """A copy that starts from what the source has built, if that is whole: the build of the copy makes the rest."""
    tree = copied(source, path)
    if (source / "results").exists():
        shutil.copytree(source / "results", path / "results", symlinks=True)
    for known in (".snakemake/metadata", ".snakemake/sums"):
        if (source / known).exists():
            shutil.copytree(source / known, path / known)
    return tree


def whole_copy(source: Tree, path: Path) -> Tree:
    """A copy of a tree with its results, and with what is compiled of it."""
    shutil.copytree(source.path, path, symlinks=True, ignore=shutil.ignore_patterns("locks", "compiled-*"))
    share(path / "src/vibroimpact")
    return Tree(path)


def without_studies(tree: Tree) -> Tree:
    """A tree after every folder and file called `studies` in it is deleted."""
    for path in [*tree.path.rglob("studies"), *tree.path.rglob("studies.*")]:
        if ".snakemake" not in path.parts:
            shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
    return tree


def run_module(tree: Path, module: str, *arguments: str) -> tuple[int, str]:
    """Exit status and output of `python -m module` in a tree, with the library of the tree."""
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
    """A tree that is copied and built by the first test process to ask for it. Read it, do not change it.

    A build that fails is not tried again.
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
