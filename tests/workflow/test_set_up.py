"""Set-up: skipped while nothing it depends on changed, and clear where it cannot work."""

import os
import subprocess

import compile as script
from chapter import PARAMETERS
from vibroimpact.exact.engine.ensemble import ensemble
from vibroimpact.exact.engine.event_loop import integrate
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.system import System


def set_up(tree, **environment):
    return subprocess.run(
        ["bash", "workflow/set_up.sh"],
        cwd=tree.path,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )


def test_an_interpreter_that_does_not_fit_is_refused(tree):
    (tree / "old").write_text("#!/bin/sh\nexit 1\n")
    (tree / "old").chmod(0o755)
    run = set_up(tree, PYTHON=str(tree / "old"))
    assert run.returncode != 0
    assert "needs Python 3.11 or newer" in run.stderr
    assert not (tree / ".venv").exists()


def test_the_locks_are_whole(tree):
    """Every package with a version and a hash, none from a place of its own, the optional integrator with a marker."""
    text = "".join((tree / f"{name}.lock").read_text().replace("\\\n", " ") for name in ("environment", "cluster"))
    packages = [line.split() for line in text.splitlines()]
    assert all("==" in package[0] and package[-1].startswith("--hash=sha256:") for package in packages)
    assert sum(package[0].startswith("snakemake-executor-plugin-slurm==") for package in packages) == 1
    assert "://" not in text
    [heyoka] = [line for line in text.splitlines() if line.startswith("heyoka==")]
    assert "sys_platform == 'linux'" in heyoka


def test_what_a_cluster_needs_is_installed_on_request_alone(tree):
    """By its hashes, after the rest; a default set-up knows nothing of it."""
    said = subprocess.run(
        ["make", "--no-print-directory", "--dry-run", "cluster-tools"],
        cwd=tree.path,
        capture_output=True,
        text=True,
        check=True,
    )
    set_up, install = said.stdout.replace("\\\n", "").splitlines()
    assert set_up == "workflow/set_up.sh"
    assert "--require-hashes" in install
    assert install.endswith("--requirement cluster.lock")
    assert "cluster.lock" not in (tree / "workflow/set_up.sh").read_text()


def test_the_engine_is_compiled_for_the_arguments_that_runs_give_it(monkeypatch):
    asked, system = [], System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
    simulate(system, [0] * 8, 1, tau0=1, sample_times=[2])
    ensemble(system, [0] * 8, 1)
    monkeypatch.setattr(integrate, "compile", asked.append)
    script.engine()
    assert [tuple(signature) for signature in asked] == list(integrate.signatures)
