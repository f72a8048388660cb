"""Set-up where there is no network, no lock, or somebody kills it; what builds a package is pinned like all else."""

import os
import re
import signal
import subprocess
import tarfile
import time
import zipfile
from hashlib import sha256
from io import BytesIO

import pytest

from namespaces import unshared
from pipeline_trees import ROOT, Tree

RECORDING = """#!/bin/sh
# An interpreter that makes an environment of itself and writes down what else it is asked to do.
case "$*" in
    *_base_executable*) echo "$0" ;;
    *platform.*) echo cpython 3 11 nothing ;;
    *ensurepip*) ;;
    "-m venv"*)
        mkdir -p .venv/bin .venv/lib/python3.11/site-packages
        touch .venv/lib/python3.11/site-packages/_vibroimpact.pth
        cp "$0" .venv/bin/python
        touch started
        while [ -e hold ]; do sleep 0.02; done ;;
    *--requirement*)
        lock=${*##*--requirement }
        echo "$* $(cut -d ' ' -f 1 "${lock%% *}" | grep -c ==)" >>calls ;;
    *--editable*) echo "$TMPDIR $PIP_CACHE_DIR" >>places; echo "$*" >>calls ;;
    *) echo "$*" >>calls ;;
esac
"""


@pytest.fixture
def recording(tree):
    """The environment of a set-up that installs nothing."""
    python = tree / "recording"
    python.write_text(RECORDING)
    python.chmod(0o755)
    return {"PYTHON": str(python)}


def set_up(tree, prefix=(), **environment):
    """A set-up in the background."""
    return subprocess.Popen(
        [*prefix, "bash", "workflow/set_up.sh"],
        cwd=tree.path,
        env=os.environ | environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )


def said(tree, expected=0, **environment):
    """The output of a set-up."""
    run = set_up(tree, **environment)
    output = run.communicate()[0]
    assert run.returncode == expected, output
    return output


def test_a_killed_set_up_starts_over_and_a_finished_one_does_not(tree, recording):
    (tree / "hold").touch()
    first = set_up(tree, **recording)
    while not (tree / "started").exists():
        assert first.poll() is None, first.communicate()[0]
        time.sleep(0.02)
    os.killpg(first.pid, signal.SIGKILL)
    first.communicate()
    (tree / "hold").unlink()
    assert not (tree / ".venv/.complete").exists()
    assert "1 of 3" in said(tree, **recording)
    assert (tree / ".venv/.complete").exists()
    assert said(tree, **recording) == ""


def test_another_path_to_the_checkout_is_the_same_checkout(tree, recording, tmp_path):
    said(tree, **recording)
    link = tmp_path / "link"
    link.symlink_to(tree.path)
    assert said(Tree(link), PWD=str(link), **recording) == ""
    moved = tree.path.rename(tmp_path / "moved")  # .venv holds absolute paths
    assert "1 of 3" in said(Tree(moved), PYTHON=str(moved / "recording"))


def test_what_builds_a_package_is_installed_from_the_lock_before_all_else(tree, recording):
    """Nothing is built with tools that pip would choose by itself."""
    said(tree, **recording)
    installs = [call for call in (tree / "calls").read_text().splitlines() if "--no-build-isolation" in call]
    assert len(installs) == 3
    packages = [call.split()[-1] for call in installs if "--requirement" in call]
    assert packages[0] == "1"
    assert int(packages[1]) > 100
    assert all("--require-hashes" in call for call in installs[:2])
    line = r"^setuptools==\S+ \\\n +--hash=sha256:"
    assert re.search(line, (ROOT / "environment.lock").read_text(), re.MULTILINE)


def test_temporary_files_and_downloads_come_into_the_checkout(tree, recording):
    said(tree, PIP_CACHE_DIR="", **recording)
    assert (tree / "places").read_text() == f"{tree.path}/.cache {tree.path}/.cache/pip\n"


def test_wheels_come_from_a_folder_alone(tree, recording):
    (tree / "wheels").mkdir()
    said(tree, WHEELS="wheels", **recording)
    installs = [call for call in (tree / "calls").read_text().splitlines() if "--requirement" in call]
    assert len(installs) == 2
    assert all("--no-index --find-links wheels" in call for call in installs)


def test_a_folder_of_wheels_that_is_none_is_refused(tree, recording):
    output = said(tree, expected=1, WHEELS="nowhere", **recording)
    assert output == "WHEELS=nowhere is no folder. Fill one where there is a network: make wheels WHEELS=nowhere\n"
    assert not (tree / ".venv").exists()


def test_a_folder_is_filled_with_what_the_lock_names(tree, recording):
    """Whatever builds a package to learn its name is that of the lock here, too."""
    make = dict(cwd=tree.path, env=os.environ | recording, capture_output=True, text=True, check=False)
    assert "Name the folder: make wheels WHEELS=folder" in subprocess.run(["make", "wheels"], **make).stderr
    assert not (tree / "calls").exists()
    assert subprocess.run(["make", "wheels", "WHEELS=new folder"], **make).returncode == 0
    [call] = [call for call in (tree / "calls").read_text().splitlines() if " download " in call]
    options = "--require-hashes --no-deps --no-build-isolation --dest new folder -r environment.lock -r cluster.lock"
    assert call == f"-m pip download {options}"


def test_without_locks_a_set_up_says_so_and_goes_on(tree, recording):
    (tree / "bin").mkdir()
    (tree / "bin/flock").write_text("#!/bin/sh\nexit 71\n")
    (tree / "bin/flock").chmod(0o755)
    output = said(tree, PATH=f"{tree / 'bin'}:{os.environ['PATH']}", **recording)
    assert output.startswith("This file system has no locks: start no other set-up of this checkout meanwhile.\n")
    assert (tree / ".venv/.complete").exists()


BACKEND = """
import zipfile
def build_wheel(folder, settings=None, metadata=None):
    with zipfile.ZipFile(f"{folder}/tiny-1-py3-none-any.whl", "w") as wheel:
        wheel.writestr("tiny.py", "BUILT_BY = 'the setuptools of the lock'")
        wheel.writestr("tiny-1.dist-info/METADATA", "Metadata-Version: 2.1\\nName: tiny\\nVersion: 1\\n")
        wheel.writestr("tiny-1.dist-info/WHEEL", "Wheel-Version: 1.0\\nRoot-Is-Purelib: true\\nTag: py3-none-any\\n")
        wheel.writestr("tiny-1.dist-info/RECORD", "")
    return "tiny-1-py3-none-any.whl"
"""
"""All that a package needs of what builds it."""
METADATA = "Metadata-Version: 2.1\nName: {}\nVersion: 1\n"


def write_wheel(folder, name, files):
    with zipfile.ZipFile(folder / f"{name}-1-py3-none-any.whl", "w") as wheel:
        for path, text in files.items():
            wheel.writestr(path, text)
        wheel.writestr(f"{name}-1.dist-info/METADATA", METADATA.format(name))
        wheel.writestr(f"{name}-1.dist-info/WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
        wheel.writestr(f"{name}-1.dist-info/RECORD", "")


def write_source(folder, name, files):
    with tarfile.open(folder / f"{name}-1.tar.gz", "w:gz") as archive:
        for path, text in files.items():
            entry = tarfile.TarInfo(f"{name}-1/{path}")
            entry.size = len(text)
            archive.addfile(entry, BytesIO(text.encode()))


@pytest.mark.thorough
def test_a_package_without_a_wheel_is_built_without_a_network(tree):
    """By a stand-in for setuptools, to know which one it was; of the project itself nothing is in this lock."""
    wheels = tree / "wheels"
    wheels.mkdir()
    write_wheel(wheels, "setuptools", {"setuptools/__init__.py": "", "setuptools/build_meta.py": BACKEND})
    build = '[build-system]\nrequires = ["setuptools"]\nbuild-backend = "setuptools.build_meta"\n'
    write_source(wheels, "tiny", {"pyproject.toml": build, "PKG-INFO": METADATA.format("tiny")})
    hashes = {path.name.split("-")[0]: sha256(path.read_bytes()).hexdigest() for path in wheels.iterdir()}
    lock = "".join(f"{name}==1 \\\n    --hash=sha256:{digest}\n" for name, digest in sorted(hashes.items()))
    (tree / "environment.lock").write_text(lock)
    run = set_up(tree, prefix=unshared("--net"), WHEELS="wheels")
    output = run.communicate()[0]
    assert "2 of 3" in output, output
    ask = [tree / ".venv/bin/python", "-c", "import tiny; print(tiny.BUILT_BY)"]
    assert subprocess.run(ask, capture_output=True, text=True, check=True).stdout == "the setuptools of the lock\n"


@pytest.mark.thorough
def test_packages_are_checked_by_hash(tree):
    """A lock with a wrong hash installs nothing and is not taken for done."""
    (tree / "wheels").mkdir()
    write_wheel(tree / "wheels", "setuptools", {"setuptools/__init__.py": ""})
    (tree / "environment.lock").write_text("setuptools==1 \\\n    --hash=sha256:" + 64 * "0" + "\n")
    assert "THESE PACKAGES DO NOT MATCH THE HASHES" in said(tree, expected=1, WHEELS="wheels")
    assert not (tree / ".venv/.complete").exists()


def test_actions_are_pinned_by_commit_and_leave_no_credentials():
    text = (ROOT / ".github/workflows/ci.yml").read_text(encoding="utf-8")
    uses = re.findall(r"uses: (.*)", text)
    assert len(uses) > 6
    assert [use for use in uses if not re.fullmatch(r"actions/[a-z-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+", use)] == []
    checkouts = re.findall(r"uses: actions/checkout@.*\n +with:\n(?: +path: .*\n)? +persist-credentials: false\n", text)
    assert len(checkouts) == text.count("actions/checkout@")
