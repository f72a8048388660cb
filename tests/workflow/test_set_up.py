"""Set-up: done once, from the lock alone, started over if it was killed, and one line where it cannot work."""

import ast
import os
import re
import signal
import subprocess
import sys
import time
import tomllib
import zipfile

import pytest
import yaml
from packaging.requirements import Requirement

from chapter import PARAMETERS
from pipeline_trees import ROOT, Tree
from vibroimpact.compile import event_loop
from vibroimpact.exact.engine.ensemble import ensemble
from vibroimpact.exact.engine.event_loop import integrate
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.system import System
from vibroimpact_pipeline import environment

RECORDING = """#!/bin/sh
# An interpreter that makes an environment of itself, and writes down what pip is asked to install, and with what.
env | grep '^PYTHON[A-Z]' >>variables
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
        echo "$* $(cut -d ' ' -f 1 "${lock%% *}" | grep -c ==)" >>calls ;;
    *) echo "$*" >>calls ;;
esac
"""


@pytest.fixture
def recording(tree):
    """The environment of a set-up that installs nothing."""
    (tree / "recording").write_text(RECORDING)
    (tree / "recording").chmod(0o755)
    return {"PYTHON": str(tree / "recording")}


def start(tree, **environment):
    return subprocess.Popen(
        ["bash", "workflow/set_up.sh"],
        cwd=tree.path,
        env=os.environ | environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )


def set_up(tree, expected=0, **environment):
    """Output of a set-up that ends with an exit status."""
    run = start(tree, **environment)
    output = run.communicate()[0]
    assert run.returncode == expected, output
    return output


def test_an_interpreter_that_does_not_fit_is_refused(tree):
    (tree / "old").write_text("#!/bin/sh\nexit 1\n")
    (tree / "old").chmod(0o755)
    assert "needs Python 3.11 or newer" in set_up(tree, expected=1, PYTHON=str(tree / "old"))
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
    """The environment holds absolute paths."""
    set_up(tree, **recording)
    moved = tree.path.rename(tmp_path / "moved")
    assert "1 of 3" in set_up(Tree(moved), PYTHON=str(moved / "recording"))


@pytest.mark.parametrize("source", [{}, {"WHEELS": "wheels"}], ids=["network", "folder"])
def test_everything_is_installed_from_the_lock_and_first_of_all_what_builds_packages(tree, recording, source):
    (tree / "wheels").mkdir()
    set_up(tree, **recording, **source)
    installs = [call for call in (tree / "calls").read_text().splitlines() if "--requirement" in call]
    assert [int(call.split()[-1]) > 100 for call in installs] == [False, True]
    assert all("--require-hashes" in call and "--no-build-isolation" in call for call in installs)
    assert all(("--no-index --find-links wheels" in call) == bool(source) for call in installs)
    line = r"^setuptools==\S+ \\\n +--hash=sha256:"
    assert re.search(line, (ROOT / "environment.lock").read_text(), re.MULTILINE)


def test_a_set_up_works_in_its_own_folder_and_without_paths_of_others(tree, recording, tmp_path):
    """CDPATH leads `cd workflow/..` elsewhere; a variable of Python or pip has packages put elsewhere, or not found."""
    (tmp_path / "elsewhere/workflow").mkdir(parents=True)
    names = ("HOME", "PATH", "USERBASE", "STARTUP", "DONTWRITEBYTECODE")
    set_up(
        tree,
        **recording,
        CDPATH=str(tmp_path / "elsewhere"),
        **{f"PYTHON{name}": "/nowhere" for name in names},
        **dict.fromkeys(("PIP_USER", "PIP_REQUIRE_HASHES", "PIP_DRY_RUN"), "1"),
        **dict.fromkeys(("PIP_TARGET", "PIP_PREFIX", "PIP_CONSTRAINT", "PIP_REQUIREMENT", "PIP_PYTHON"), "/nowhere"),
    )
    assert not (tmp_path / "elsewhere/.venv").exists()
    told = (tree / "variables").read_text().splitlines()
    assert "PIP_CONFIG_FILE=/dev/null" in told
    assert [line for line in told if line.endswith(("=/nowhere", "=1"))] == []


def test_every_script_of_the_shell_that_changes_folders_ignores_cdpath():
    scripts = [ROOT / ".ci/run", *(ROOT / "workflow").glob("*.sh")]
    assert [
        path for path in scripts if not re.search(r"unset .*\n(?:.*\n)*cd |CDPATH; do(?:.*\n)+cd ", path.read_text())
    ] == []


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
    """As pip itself lists them: in a file or in a variable, which goes before the file."""
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


def test_one_script_calls_pip():
    files = [ROOT / name for name in ("Makefile", "Dockerfile", ".ci/run", "workflow/set_up.sh", "workflow/pip.sh")]
    assert [path.name for path in files if "-m pip" in path.read_text()] == ["pip.sh"]


@pytest.mark.thorough
def test_packages_are_checked_by_hash(tree):
    (tree / "wheels").mkdir()
    with zipfile.ZipFile(tree / "wheels/setuptools-1-py3-none-any.whl", "w") as wheel:
        wheel.writestr("setuptools-1.dist-info/METADATA", "Metadata-Version: 2.1\nName: setuptools\nVersion: 1\n")
    (tree / "environment.lock").write_text("setuptools==1 \\\n    --hash=sha256:" + 64 * "0" + "\n")
    assert "THESE PACKAGES DO NOT MATCH THE HASHES" in set_up(tree, expected=1, WHEELS="wheels")
    assert not (tree / ".venv/.complete").exists()


def test_the_locks_are_whole():
    """Every package with a version and a hash, none from a place of its own, the optional integrator with a marker."""
    text = "".join((ROOT / f"{name}.lock").read_text().replace("\\\n", " ") for name in ("environment", "cluster"))
    packages = [line.split() for line in text.splitlines() if not line.startswith("#")]
    assert all("==" in package[0] and package[-1].startswith("--hash=sha256:") for package in packages)
    assert sum(package[0].startswith("snakemake-executor-plugin-slurm==") for package in packages) == 1
    assert "://" not in text
    [heyoka] = [line for line in text.splitlines() if line.startswith("heyoka==")]
    assert "sys_platform == 'linux'" in heyoka


def test_the_lock_says_what_reads_it():
    """And `make lock`, which writes it anew, says so again."""
    (head,) = re.findall(r"sed -i '1i (#.*)' environment\.lock", (ROOT / "Makefile").read_text())
    assert (ROOT / "environment.lock").read_text().startswith(f"{head}\n")
    assert "pip and uv" in head


def requirements(*extras):
    """The requirements of the library and of some of its extras, of which one may name others."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    asked = [*project["dependencies"], *(one for extra in extras for one in project["optional-dependencies"][extra])]
    others = [name for one in asked for name in Requirement(one).extras]
    return {one for one in asked if not Requirement(one).extras} | (requirements(*others) if others else set())


def test_the_conda_environment_has_what_jobs_import():
    """The library is the one beside the rules; Snakemake starts the jobs from its own environment."""
    environment = yaml.safe_load((ROOT / "workflow/envs/vibroimpact.yaml").read_text(encoding="utf-8"))
    *_, packages = environment["dependencies"]
    needed = requirements("pipeline", "integrators", "report", "archive")
    assert {*packages["pip"]} == {one for one in needed if not one.startswith("snakemake")}


def test_the_extra_pipeline_brings_what_a_build_asks_for():
    brought = {Requirement(one).name for one in requirements("pipeline")}
    distributions = {"flint": "python-flint", "yaml": "pyyaml"}
    assert {distributions.get(name, name) for name in environment.NEEDED} <= brought


def test_the_engine_is_compiled_for_the_arguments_of_runs(monkeypatch):
    asked, system = [], System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
    simulate(system, [0] * 8, 1, tau0=1, sample_times=[2])
    ensemble(system, [0] * 8, 1)
    monkeypatch.setattr(integrate, "compile", asked.append)
    event_loop()
    assert [tuple(signature) for signature in asked] == list(integrate.signatures)


def test_actions_are_pinned_by_commit_and_leave_no_credentials():
    text = (ROOT / ".github/workflows/ci.yml").read_text(encoding="utf-8")
    uses = re.findall(r"uses: (.*)", text)
    assert len(uses) > 6
    assert [use for use in uses if not re.fullmatch(r"actions/[a-z-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+", use)] == []
    checkouts = re.findall(r"uses: actions/checkout@.*\n +with:\n(?: +path: .*\n)? +persist-credentials: false\n", text)
    assert len(checkouts) == text.count("actions/checkout@")
