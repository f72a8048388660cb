"""Set-up: skipped while nothing it depends on changed, and clear where it cannot work."""

import os
import subprocess


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


def test_the_lock_is_whole(tree):
    """Every package with a version and a hash, none from a place of its own, the optional integrator with a marker."""
    text = (tree / "environment.lock").read_text().replace("\\\n", " ")
    packages = [line.split() for line in text.splitlines()]
    assert all("==" in package[0] and package[-1].startswith("--hash=sha256:") for package in packages)
    assert "://" not in text
    [heyoka] = [line for line in text.splitlines() if line.startswith("heyoka==")]
    assert "sys_platform == 'linux'" in heyoka
