"""A file system without locks, as some over a network: that is said, and builds of one machine still wait in turn."""

import errno
import os
import subprocess
import sys

import pytest

WITHOUT_LOCKS = """
import errno, fcntl, os
lockf = fcntl.lockf
def without(file, *rest):
    if file.name.startswith(".cache") or {everywhere}:
        raise OSError(errno.{error}, os.strerror(errno.{error}))
    return lockf(file, *rest)
fcntl.lockf = without
"""
"""What Python runs at its start, found by this name on its path."""


@pytest.fixture
def without_locks(tmp_path, monkeypatch):
    """The path to a start of Python in which the build directory, or any, has no locks."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))

    def write(error, everywhere=False):
        (tmp_path / "sitecustomize.py").write_text(WITHOUT_LOCKS.format(error=error, everywhere=everywhere))
        return os.pathsep.join([str(tmp_path), os.environ["PYTHONPATH"]])

    return write


OTHERS = [pytest.param(error, marks=pytest.mark.thorough) for error in ("ENOSYS", "ENOTSUP")]


@pytest.mark.parametrize("error", ["ENOLCK", *OTHERS])
def test_a_build_goes_on_and_says_so_once(tree, without_locks, error):
    output = tree.snakemake("--dry-run", "companion_10_04", PYTHONPATH=without_locks(error))
    said = (
        f".cache/build.lock: {os.strerror(getattr(errno, error))}. Builds of this directory on other machines are not"
    )
    assert output.count(said) == 1
    assert output.count("are not waited for") == 1


def test_where_nothing_has_locks_a_build_goes_on(tree, without_locks):
    output = tree.snakemake("--dry-run", "companion_10_04", PYTHONPATH=without_locks("ENOLCK", everywhere=True))
    assert output.count("are not waited for") == 2


def test_another_failure_to_lock_is_no_such_case(tree, without_locks):
    output = tree.snakemake("--dry-run", PYTHONPATH=without_locks("EIO"), check=False)
    assert tree.returncode == 1
    assert "\n.cache/build.lock: Input/output error. " in output


def test_builds_of_one_machine_wait_without_locks(tree, without_locks):
    """The first is one that only holds the lock, until it is told to end."""
    paths = {"PYTHONPATH": without_locks("ENOLCK")}
    held = "from vibroimpact_pipeline import build_directory as b; lock = b.lock(); print('held', flush=True); input()"
    first = subprocess.Popen(
        [sys.executable, "-c", held],
        cwd=tree.path,
        env=os.environ | paths,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    assert first.stdout.readline() == "held\n"
    second = tree.start("--dry-run", "companion_10_04", **paths)
    assert any("Waiting for another build" in line for line in second.stdout)
    first.communicate("")
    second.communicate()
    assert second.returncode == 0
