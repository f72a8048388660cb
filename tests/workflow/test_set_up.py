"""Test the set-up: it runs once, uses only the lock, starts over if killed, and explains a failure in one line."""

import ast
import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import tomllib
import venv
import zipfile
from importlib.metadata import packages_distributions
from pathlib import Path

import pip
import pytest
from packaging.requirements import Requirement

from pipeline_trees import ROOT, Tree
from vibroimpact_pipeline import environment

RECORDING = """#!/bin/sh
# An interpreter that makes an environment of itself, and writes down what pip and uv are to install, and with what.
env | grep -E '^(PYTHON[A-Z]|UV_)' >>variables
case "$*" in *"-m pip "*) env | grep '^PIP_' >>variables ;; esac
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
        echo "${0##*/} $* $(cut -d ' ' -f 1 "${lock%% *}" | grep -c ==)" >>calls
        [ -e .venv/bin/uv ] || cp "$0" .venv/bin/uv
        case "$0" in */uv) ! [ -e unreachable ] ;; esac ;;
    *) echo "$*" >>calls ;;
esac
"""


@pytest.fixture
def recording(tree):
    """Return variables for a set-up that only records calls and installs nothing."""
    (tree / "recording").write_text(RECORDING)
    (tree / "recording").chmod(0o755)
    return {"PYTHON": str(tree / "recording")}


def start(tree, *lock, **environment):
    return subprocess.Popen(
        ["bash", "workflow/set_up.sh", *lock],
        cwd=tree.path,
        env=os.environ | environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )


def set_up(tree, *lock, expected=0, **environment):
    """Run a set-up, check its exit status and return its output."""
    run = start(tree, *lock, **environment)
    output = run.communicate()[0]
    assert run.returncode == expected, output
    return output


def test_an_interpreter_that_does_not_fit_is_refused(tree):
    (tree / "old").write_text("#!/bin/sh\nexit 1\n")
    (tree / "old").chmod(0o755)
    assert "Python 3.11 or newer" in set_up(tree, expected=1, PYTHON=str(tree / "old"))
    assert not (tree / ".venv").exists()


def test_a_killed_set_up_starts_over_and_a_finished_one_does_not(tree, recording):
    (tree / "hold").touch()
    first = start(tree, **recording)
    while not (tree / "started").exists():
        assert first.poll() is None, first.communicate()[0]
        time.sleep(0.02)
    os.killpg(first.pid, signal.SIGKILL)
    first.communicate()
    (tree / "hold").unlink()
    assert not (tree / ".venv/.complete").exists()
    assert "1 of 3" in set_up(tree, **recording)
    assert set_up(tree, **recording) == ""


def test_a_moved_checkout_is_set_up_again(tree, recording, tmp_path):
    """The environment contains absolute paths."""
    set_up(tree, **recording)
    moved = tree.path.rename(tmp_path / "moved")
    assert "1 of 3" in set_up(Tree(moved), PYTHON=str(moved / "recording"))


def installs(tree) -> list[str]:
    """For each installation from a lock, return the program, its arguments and the number of packages."""
    return [call for call in (tree / "calls").read_text().splitlines() if "--requirement" in call]


@pytest.mark.parametrize("source", [{}, {"WHEELS": "wheels"}], ids=["network", "folder"])
def test_everything_is_installed_from_the_lock_and_first_of_all_what_installs_and_builds(tree, recording, source):
    (tree / "wheels").mkdir()
    set_up(tree, **recording, **source)
    first, rest = installs(tree)
    assert (first.split()[-1], int(rest.split()[-1]) > 100) == ("2", True)
    assert [call.split()[0] for call in (first, rest)] == ["python", "python" if source else "uv"]
    assert all("--require-hashes" in call and "--no-build-isolation" in call for call in (first, rest))
    assert all(("--no-index --find-links wheels" in call) == bool(source) for call in (first, rest))
    for name in ("setuptools", "uv"):
        assert re.search(rf"^{name}==\S+ \\\n +--hash=sha256:", (ROOT / "environment.lock").read_text(), re.MULTILINE)


def test_pip_installs_what_uv_cannot_reach(tree, recording):
    (tree / "unreachable").touch()
    assert "trying pip" in set_up(tree, **recording)
    assert [call.split()[0] for call in installs(tree)] == ["python", "uv", "python"]


def test_a_second_lock_is_added_once_to_what_is_set_up(tree, recording):
    set_up(tree, **recording)
    count = (tree / "development.lock").read_text().count("==")
    added = set_up(tree, "development", **recording).splitlines()
    assert [line for line in added if "Adding" in line] == added
    assert re.search(r"Adding (\d+) packages of development.lock", added[0])[1] <= str(count)
    assert "--requirement development.lock" in installs(tree)[-1]
    assert set_up(tree, "development", **recording) == set_up(tree, **recording) == ""
    (tree / "development.lock").write_text("other==1 --hash=sha256:0\n")
    assert "Adding 1 packages" in set_up(tree, "development", **recording)
    (tree / "pyproject.toml").write_text("")
    assert "1 of 3" in (again := set_up(tree, "development", **recording))
    assert "Adding 1 packages" in again


def test_a_second_lock_that_was_not_installed_is_tried_again(tree, recording):
    set_up(tree, **recording)
    (tree / ".venv/bin/python").write_text("#!/bin/sh\nexit 1\n")
    (tree / "unreachable").touch()
    assert "Adding" in set_up(tree, "development", expected=1, **recording)
    (tree / "unreachable").unlink()
    assert "Adding" in set_up(tree, "development", **recording)


def test_a_set_up_works_in_its_own_folder_and_without_paths_of_others(tree, recording, tmp_path):
    """CDPATH would change the target of `cd workflow/..`; variables of Python, pip and uv would change packages."""
    (tmp_path / "elsewhere/workflow").mkdir(parents=True)
    names = ("HOME", "PATH", "USERBASE", "STARTUP", "DONTWRITEBYTECODE")
    set_up(
        tree,
        **recording,
        CDPATH=str(tmp_path / "elsewhere"),
        **{f"PYTHON{name}": "/nowhere" for name in names},
        **dict.fromkeys(("PIP_USER", "PIP_REQUIRE_HASHES", "PIP_DRY_RUN"), "1"),
        **dict.fromkeys(("UV_PYTHON", "UV_DEFAULT_INDEX", "UV_CONFIG_FILE", "UV_CONSTRAINT", "UV_EXCLUDE"), "/nowhere"),
        **dict.fromkeys(("PIP_TARGET", "PIP_PREFIX", "PIP_CONSTRAINT", "PIP_REQUIREMENT", "PIP_PYTHON"), "/nowhere"),
    )
    assert not (tmp_path / "elsewhere/.venv").exists()
    told = (tree / "variables").read_text().splitlines()
    assert "PIP_CONFIG_FILE=/dev/null" in told
    assert [line for line in told if line.endswith(("=/nowhere", "=1"))] == []


PIP_CONF = """
[global]
user = true
target = /nowhere
require-virtualenv = true
index-url = https://mirror.example.org/simple?a=b
extra-index-url =
    https://one.example.org
    https://two.example.org
trusted-host = of.the.file
[install]
constraint = /nowhere
trusted-host = of.the.command
"""


def test_of_the_settings_of_pip_those_count_that_say_how_to_reach_packages(tree, tmp_path):
    """They may be set in a file or in a variable, which overrides the file, as `pip config list` shows."""
    (tree / ".venv").symlink_to(sys.prefix)
    (tmp_path / "pip.conf").write_text(PIP_CONF)
    given = {"CONFIG_FILE": str(tmp_path / "pip.conf"), "USER": "1", "TARGET": "/nowhere", "RETRIES": "7"}
    of_user = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")}
    run = subprocess.run(
        [tree / "workflow/pip.sh", "config", "list"],
        env=of_user | {f"PIP_{name}": value for name, value in given.items()} | {"PIP_TRUSTED_HOST": "of.the.variable"},
        capture_output=True,
        text=True,
        check=True,
    )
    told = dict(line.removeprefix(":env:.").split("=", 1) for line in run.stdout.splitlines())
    told = {name: ast.literal_eval(value).split() for name, value in told.items()}
    of_this_machine = {"cert", "find-links", "proxy", "no-index", "timeout", "default-timeout"}
    assert {name: value for name, value in told.items() if name not in of_this_machine} == {
        "cache-dir": [str(tree / ".cache/pip")],
        "config-file": ["/dev/null"],
        "extra-index-url": ["https://one.example.org", "https://two.example.org"],
        "index-url": ["https://mirror.example.org/simple?a=b"],
        "retries": ["7"],
        "trusted-host": ["of.the.variable"],
    }


def tiny_wheel(folder) -> str:
    """Write a package into the folder of a package index; return its line for a lock."""
    folder.mkdir(parents=True)
    with zipfile.ZipFile(folder / "tiny-1-py3-none-any.whl", "w") as wheel:
        wheel.writestr("tiny-1.dist-info/METADATA", "Metadata-Version: 2.1\nName: tiny\nVersion: 1\n")
        wheel.writestr("tiny-1.dist-info/WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
        wheel.writestr("tiny-1.dist-info/RECORD", "tiny-1.dist-info/RECORD,,\n")
    (folder / "index.html").write_text('<a href="tiny-1-py3-none-any.whl">tiny-1-py3-none-any.whl</a>')
    digest = hashlib.sha256((folder / "tiny-1-py3-none-any.whl").read_bytes()).hexdigest()
    return f"tiny==1 --hash=sha256:{digest}\n"


@pytest.mark.parametrize(
    "settings",
    [
        {"INDEX_URL": "file://{index}"},
        {"INDEX_URL": "file://{empty}", "EXTRA_INDEX_URL": "file://{empty} file://{index}"},
        {"NO_INDEX": "true", "FIND_LINKS": "{index}/tiny"},
        {"CONFIG_FILE": "{empty}/pip.conf"},
    ],
    ids=["index", "second index", "folder", "file"],
)
def test_uv_takes_packages_from_where_pip_is_told_to_and_checks_their_hashes(tree, tmp_path, settings):
    places = {"index": tmp_path / "index", "empty": tmp_path / "empty"}
    line = tiny_wheel(places["index"] / "tiny")
    places["empty"].mkdir()
    (places["empty"] / "pip.conf").write_text(f"[install]\nindex-url = file://{places['index']}\n")
    venv.create(tree / ".venv", symlinks=True)
    (tree / ".venv/bin/uv").symlink_to(Path(sys.executable).with_name("uv"))
    (tree / ".cache").mkdir(exist_ok=True)
    packages = next((tree / ".venv/lib").iterdir()) / "site-packages"
    (packages / "pip").symlink_to(Path(pip.__file__).parent)
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")}
    environment |= {f"PIP_{name}": value.format(**places) for name, value in settings.items()}
    for lock, expected in ((line.replace("256:", "256:0")[:-2], 1), (line, 0)):
        (tree / "tiny.lock").write_text(lock)
        run = subprocess.run(
            [tree / "workflow/pip.sh", "uv", "install", "--require-hashes", "--requirement", "tiny.lock"],
            env=environment,
            capture_output=True,
            text=True,
        )
        assert run.returncode == expected, run.stderr
        assert expected == 0 or "Hash mismatch" in run.stderr
    assert (packages / "tiny-1.dist-info").is_dir()


LOCKS = "environment", "development", "cluster"


def locked(name) -> set[str]:
    """Return the names of the packages in a lock."""
    return {*re.findall(r"^([a-z][^=\s]*)==", (ROOT / f"{name}.lock").read_text(), re.MULTILINE)}


def test_the_locks_are_whole():
    """The locks together have each package once, with version and hash, without URLs, and heyoka with its marker."""
    locks = [locked(name) for name in LOCKS]
    assert sum(map(len, locks)) == len(set().union(*locks))
    text = "".join((ROOT / f"{name}.lock").read_text().replace("\\\n", " ") for name in LOCKS)
    packages = [line.split() for line in text.splitlines() if not line.startswith("#")]
    assert all("==" in package[0] and package[-1].startswith("--hash=sha256:") for package in packages)
    assert sum(package[0].startswith("snakemake-executor-plugin-slurm==") for package in packages) == 1
    assert "://" not in text
    [heyoka] = [line for line in text.splitlines() if line.startswith("heyoka==")]
    assert "sys_platform == 'linux'" in heyoka


def requirements(*extras):
    """Return the requirements of the library and of some extras, including extras that an extra names."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    asked = [*project["dependencies"], *(one for extra in extras for one in project["optional-dependencies"][extra])]
    others = [name for one in asked for name in Requirement(one).extras]
    return {one for one in asked if not Requirement(one).extras} | (requirements(*others) if others else set())


FOR_BUILDS = "pipeline", "integrators", "set-up"
APART = "notebooks", "cluster"
"""FOR_BUILDS: extras in environment.lock. APART: extras in neither environment.lock nor development.lock."""


def test_each_lock_has_the_packages_of_its_extras():
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    for_builds = {Requirement(one).name for one in requirements(*FOR_BUILDS)}
    others = {Requirement(one).name for one in requirements(*(extras.keys() - {*FOR_BUILDS, *APART}))}
    assert for_builds <= locked("environment")
    assert others - for_builds <= locked("development")


def imported(path) -> set[str]:
    """Return the packages that a module imports, including imports in functions."""
    nodes = [*ast.walk(ast.parse(path.read_text(encoding="utf-8")))]
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in nodes if isinstance(node, ast.ImportFrom)}
    return {name.partition(".")[0] for name in names} - sys.stdlib_module_names


def test_builds_import_packages_of_their_lock_only_and_other_jobs_say_what_they_lack():
    installed, for_builds = packages_distributions(), locked("environment")
    for path in (path for folder in ("src", "workflow/scripts") for path in (ROOT / folder).rglob("*.py")):
        named = re.findall(r"^need\((.*)\)$", path.read_text(encoding="utf-8"), re.MULTILINE)
        known = {"vibroimpact", "vibroimpact_pipeline"}.union(*(ast.literal_eval(f"({names},)") for names in named))
        for name in (imported(path) & installed.keys()) - known:
            assert {one.lower().replace("_", "-") for one in installed[name]} & for_builds, (path, name)


def test_the_extra_pipeline_brings_what_a_build_asks_for():
    brought = {Requirement(one).name for one in requirements("pipeline")}
    distributions = {"flint": "python-flint", "yaml": "pyyaml"}
    assert {distributions.get(name, name) for name in environment.REQUIRED} <= brought


def test_the_workflow_names_packages_that_are_not_installed(tree):
    hidden = tree / "hidden/sitecustomize.py"
    hidden.parent.mkdir()
    hidden.write_text("import sys\n\nsys.modules |= {'papermill': None, 'flint': None}\n", encoding="utf-8")
    said = tree.snakemake("fig10_04", check=False, PYTHONPATH=str(hidden.parent))
    assert tree.returncode != 0
    assert said.splitlines()[-1].startswith("Packages not installed: papermill, flint. Run `make set-up`")
    assert "Traceback" not in said


def compiled_files(tree) -> dict[str, int]:
    """Return the modification time of each file of compiled code."""
    return {str(path): path.stat().st_mtime_ns for path in (tree / "src").rglob("*.nb[ic]")}


@pytest.mark.thorough
def test_the_first_build_compiles_nothing(tree):
    shutil.rmtree(tree / "src/vibroimpact/__pycache__")
    environment = os.environ | {"PYTHONPATH": str(tree / "src")}
    subprocess.run([sys.executable, "workflow/scripts/compile.py"], cwd=tree.path, env=environment, check=True)
    before = compiled_files(tree)
    tree.snakemake()
    assert len(before) > 100
    assert compiled_files(tree) == before
