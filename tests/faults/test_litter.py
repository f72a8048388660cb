"""What killed builds have left is swept by the next one that holds the lock of its directory, and by no other."""

import fcntl
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from vibroimpact_pipeline import build_directory
from vibroimpact_pipeline.environment import SCRATCH

LEFT = ["results/figures/.fig10_03.csv.123.partial", ".snakemake/scripts/tmpabcd.notebook.py", ".cache/labels.json.123"]
SHARED = [
    ".cache/numba/0123/engine_45/flow.node-1.py311.nbi.tmp.67",
    ".cache/numba/0123.456.partial/engine_45/flow.node-1.py311.nbi",
    ".cache/matplotlib/fontlist.json.matplotlib-lock",
    f"{SCRATCH}abcd/kernel.json",
]
"""In folders where others may be at work."""
KEPT = [
    "results/figures/fig10_03.csv",
    "results/logs/figures/fig10_03.log",
    ".snakemake/metadata/tmp",
    ".cache/labels.json",
    ".cache/numba/0123/engine_45/flow.node-1.py311.nbi",
    "another.partial",
]


@pytest.fixture
def litter(tmp_path, monkeypatch):
    """A build directory, which is also where temporary files come, with files that were written an instant ago."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    for name in [*LEFT, *SHARED, *KEPT]:
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).touch()
    return Path(LEFT[0]).stat().st_mtime


def there(*names):
    return [name for name in names if Path(name).exists()]


def test_what_only_a_build_of_this_directory_writes_is_swept_at_once(litter):
    build_directory.sweep(litter)
    assert there(*LEFT) == []
    assert there(*SHARED, *KEPT) == [*SHARED, *KEPT]


def test_what_others_may_be_writing_is_swept_when_it_is_old(litter):
    build_directory.sweep(litter + 2 * build_directory.LONG_AGO)
    assert there(*LEFT, *SHARED) == []
    assert there(*KEPT) == KEPT


def test_a_build_sweeps(tree):
    litter = tree / LEFT[0]
    litter.parent.mkdir(parents=True)
    litter.touch()
    tree.snakemake("--dry-run", "companion_10_04")
    assert not litter.exists()


def test_a_build_that_waits_for_another_sweeps_nothing(tree):
    """The lock is taken here in place of another build."""
    litter = tree / LEFT[0]
    for folder in (litter.parent, tree / ".cache"):
        folder.mkdir(parents=True)
    litter.touch()
    with open(tree / ".cache/build.lock", "w") as lock:
        fcntl.lockf(lock, fcntl.LOCK_EX)
        second = tree.start("--dry-run", "companion_10_04")
        assert any("Waiting for another build" in line for line in second.stdout)
        assert litter.exists()
    second.communicate()
    assert second.returncode == 0
    assert not litter.exists()


def test_a_killed_kernel_leaves_what_the_sweep_knows(tmp_path):
    """The folder of its connection is the only thing that a notebook has outside the build directory."""
    code = (
        "import json, sys, pathlib, notebook\n"
        "cell = {'cell_type': 'code', 'execution_count': None, 'metadata': {}, 'outputs': [],\n"
        "        'source': 'import os, signal; os.kill(os.getppid(), signal.SIGKILL)'}\n"
        "kernel = {'kernelspec': {'name': 'python3', 'display_name': 'Python 3', 'language': 'python'}}\n"
        "content = {'cells': [cell], 'metadata': kernel, 'nbformat': 4, 'nbformat_minor': 4}\n"
        "pathlib.Path('source.ipynb').write_text(json.dumps(content))\n"
        "notebook.execute('source.ipynb', 'executed.ipynb', {})"
    )
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    paths = {"PYTHONPATH": os.pathsep.join(sys.path), "TMPDIR": str(temporary)}
    run = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=os.environ | paths, check=False)
    assert run.returncode < 0
    [left] = temporary.iterdir()
    assert left.name.startswith(SCRATCH)
    assert [path.name for path in left.iterdir()] == ["kernel.json"]
