"""Test the set-up: it runs once, installs only packages of the locks, and starts over if killed."""

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
# Replaces Python, pip and uv: creates files of an environment, and records calls and environment variables.
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
    """Return variables for a set-up that records calls of Python, pip and uv and installs nothing."""
    (tree / "recording").write_text(RECORDING)
    (tree / "recording").chmod(0o755)
    return {"PYTHON": str(tree / "recording")}


def start(tree, *lock, **environment):
    """Start a set-up in the background in its own process group."""
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


def test_an_unsuitable_interpreter_is_refused(tree):
    (tree / "old").write_text("#!/bin/sh\nexit 1\n")
    (tree / "old").chmod(0o755)
    assert "Python 3.11 or newer" in set_up(tree, expected=1, PYTHON=str(tree / "old"))
    assert not (tree / ".venv").exists()


def test_a_set_up_starts_over_if_killed_and_does_nothing_if_complete(tree, recording):
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
def test_all_packages_come_from_the_lock_and_uv_and_setuptools_are_installed_first(tree, recording, source):
    (tree / "wheels").mkdir()
    set_up(tree, **recording, **source)
    first, rest = installs(tree)
    assert (first.split()[-1], int(rest.split()[-1]) > 100) == ("2", True)
    assert [call.split()[0] for call in (first, rest)] == ["python", "python" if source else "uv"]
    assert all("--require-hashes" in call and "--no-build-isolation" in call for call in (first, rest))
    assert all(("--no-index --find-links wheels" in call) == bool(source) for call in (first, rest))
    for name in ("setuptools", "uv"):
        assert re.search(rf"^{name}==\S+ \\\n +--hash=sha256:", (ROOT / "environment.lock").read_text(), re.MULTILINE)


def test_pip_takes_over_if_uv_fails(tree, recording):
    (tree / "unreachable").touch()
    assert "trying pip" in set_up(tree, **recording)
    assert [call.split()[0] for call in installs(tree)] == ["python", "uv", "python"]


def test_a_second_lock_is_installed_once_into_the_environment(tree, recording):
    set_up(tree, **recording)
    count = (tree / "development.lock").read_text().count("==")
    (line,) = set_up(tree, "development", **recording).splitlines()
    assert int(re.search(r"Adding (\d+) packages of development.lock", line)[1]) <= count
    assert "--requirement development.lock" in installs(tree)[-1]
    assert set_up(tree, "development", **recording) == set_up(tree, **recording) == ""
    (tree / "development.lock").write_text("other==1 --hash=sha256:0\n")
    assert "Adding 1 packages" in set_up(tree, "development", **recording)
    (tree / "pyproject.toml").write_text("")
    assert "1 of 3" in (again := set_up(tree, "development", **recording))
    assert "Adding 1 packages" in again


def test_a_failed_installation_of_a_second_lock_is_retried(tree, recording):
    set_up(tree, **recording)
    (tree / ".venv/bin/python").write_text("#!/bin/sh\nexit 1\n")
    (tree / "unreachable").touch()
    assert "Adding" in set_up(tree, "development", expected=1, **recording)
    (tree / "unreachable").unlink()
    assert "Adding" in set_up(tree, "development", **recording)


def test_variables_of_the_user_change_neither_the_folder_nor_the_packages(tree, recording, tmp_path):
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
    variables = (tree / "variables").read_text().splitlines()
    assert "PIP_CONFIG_FILE=/dev/null" in variables
    assert [line for line in variables if line.endswith(("=/nowhere", "=1"))] == []


def run_pip(tree, *arguments, **settings):
    """Run workflow/pip.sh with the given settings of pip as environment variables, and no other settings."""
    variables = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")}
    variables |= {f"PIP_{name}": value for name, value in settings.items()}
    return subprocess.run([tree / "workflow/pip.sh", *arguments], env=variables, capture_output=True, text=True)


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


def test_only_settings_of_pip_for_access_to_packages_are_used(tree, tmp_path):
    """`pip config list` shows the settings that pip uses. A variable overrides the settings file."""
    (tree / ".venv").symlink_to(sys.prefix)
    (tmp_path / "pip.conf").write_text(PIP_CONF)
    settings = {"CONFIG_FILE": str(tmp_path / "pip.conf"), "USER": "1", "TARGET": "/nowhere", "RETRIES": "7"}
    run = run_pip(tree, "config", "list", **settings, TRUSTED_HOST="of.the.variable")
    used = dict(line.removeprefix(":env:.").split("=", 1) for line in run.stdout.splitlines())
    of_this_machine = {"cert", "find-links", "proxy", "no-index", "timeout", "default-timeout"}
    assert {name: ast.literal_eval(value).split() for name, value in used.items() if name not in of_this_machine} == {
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
def test_uv_uses_the_package_sources_set_for_pip_and_checks_hashes(tree, tmp_path, settings):
    places = {"index": tmp_path / "index", "empty": tmp_path / "empty"}
    line = tiny_wheel(places["index"] / "tiny")
    places["empty"].mkdir()
    (places["empty"] / "pip.conf").write_text(f"[install]\nindex-url = file://{places['index']}\n")
    venv.create(tree / ".venv", symlinks=True)
    (tree / ".venv/bin/uv").symlink_to(Path(sys.executable).with_name("uv"))
    (tree / ".cache").mkdir(exist_ok=True)
    packages = next((tree / ".venv/lib").iterdir()) / "site-packages"
    (packages / "pip").symlink_to(Path(pip.__file__).parent)
    settings = {name: value.format(**places) for name, value in settings.items()}
    for lock, expected in ((line.replace("256:", "256:0")[:-2], 1), (line, 0)):
        (tree / "tiny.lock").write_text(lock)
        run = run_pip(tree, "uv", "install", "--require-hashes", "--requirement", "tiny.lock", **settings)
        assert run.returncode == expected, run.stderr
        assert expected == 0 or "Hash mismatch" in run.stderr
    assert (packages / "tiny-1.dist-info").is_dir()


PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
LOCKS = "environment", "development", "cluster"


def locked(name) -> set[str]:
    """Return the names of the packages in a lock."""
    return {*re.findall(r"^([a-z][^=\s]*)==", (ROOT / f"{name}.lock").read_text(), re.MULTILINE)}


def test_locks_pin_each_package_once_by_version_and_hash():
    """The locks share no package and contain no URL; heyoka, which exists for Linux only, has a marker."""
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
    named = [*PROJECT["dependencies"], *(one for extra in extras for one in PROJECT["optional-dependencies"][extra])]
    others = [name for one in named for name in Requirement(one).extras]
    return {one for one in named if not Requirement(one).extras} | (requirements(*others) if others else set())


BUILD_EXTRAS = "pipeline", "integrators", "set-up"
OTHER_EXTRAS = "notebooks", "cluster"
"""Extras in environment.lock, and extras in neither environment.lock nor development.lock."""


def test_each_lock_has_the_packages_of_its_extras():
    extras = PROJECT["optional-dependencies"]
    for_builds = {Requirement(one).name for one in requirements(*BUILD_EXTRAS)}
    others = {Requirement(one).name for one in requirements(*(extras.keys() - {*BUILD_EXTRAS, *OTHER_EXTRAS}))}
    assert for_builds <= locked("environment")
    assert others - for_builds <= locked("development")


def imported(path) -> set[str]:
    """Return the packages that a module imports, including imports in functions."""
    nodes = [*ast.walk(ast.parse(path.read_text(encoding="utf-8")))]
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in nodes if isinstance(node, ast.ImportFrom)}
    return {name.partition(".")[0] for name in names} - sys.stdlib_module_names


def test_modules_import_only_packages_of_environment_lock_or_declare_others():
    """A module declares other packages by a call of `need`, which names those that are not installed."""
    installed, for_builds = packages_distributions(), locked("environment")
    for path in (path for folder in ("src", "workflow/scripts") for path in (ROOT / folder).rglob("*.py")):
        calls = re.findall(r"^need\((.*)\)$", path.read_text(encoding="utf-8"), re.MULTILINE)
        declared = {"vibroimpact", "vibroimpact_pipeline"}.union(*(ast.literal_eval(f"({names},)") for names in calls))
        for name in (imported(path) & installed.keys()) - declared:
            assert {one.lower().replace("_", "-") for one in installed[name]} & for_builds, (path, name)


def test_the_extra_pipeline_contains_the_packages_that_a_build_requires():
    contained = {Requirement(one).name for one in requirements("pipeline")}
    distributions = {"flint": "python-flint", "yaml": "pyyaml"}
    assert {distributions.get(name, name) for name in environment.REQUIRED} <= contained


def test_the_workflow_names_packages_that_are_not_installed(tree):
    hidden = tree / "hidden/sitecustomize.py"
    hidden.parent.mkdir()
    hidden.write_text("import sys\n\nsys.modules |= {'papermill': None, 'flint': None}\n", encoding="utf-8")
    message = tree.snakemake("fig10_04", check=False, PYTHONPATH=str(hidden.parent))
    assert tree.returncode != 0
    assert message.splitlines()[-1].startswith("Packages not installed: papermill, flint. Run `make set-up`")
    assert "Traceback" not in message


def compiled_files(tree) -> dict[str, int]:
    """Return the modification time of each file of compiled code."""
    return {str(path): path.stat().st_mtime_ns for path in (tree / "src").rglob("*.nb[ic]")}


@pytest.mark.thorough
def test_the_first_build_after_a_set_up_compiles_nothing(tree):
    shutil.rmtree(tree / "src/vibroimpact/__pycache__")
    environment = os.environ | {"PYTHONPATH": str(tree / "src")}
    subprocess.run([sys.executable, "workflow/scripts/compile.py"], cwd=tree.path, env=environment, check=True)
    before = compiled_files(tree)
    tree.snakemake()
    assert len(before) > 100
    assert compiled_files(tree) == before
