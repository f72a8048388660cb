"""The figure check of some figures, as they are built."""

import os
import subprocess
import sys

FIGURES = "fig10_04", "companion_10_05"


def checked(tree, *figures):
    command = [sys.executable, "-m", "vibroimpact_pipeline.figure_check", *figures]
    environment = os.environ | {"PYTHONPATH": str(tree / "src")}
    return subprocess.run(command, cwd=tree.path, env=environment, capture_output=True, text=True, check=False)


def test_figures_that_agree_pass_and_one_that_is_not_made_fails(built):
    passed, failed = checked(built, *FIGURES), checked(built, FIGURES[0], "fig99")
    assert passed.returncode == 0, passed.stdout + passed.stderr
    assert passed.stdout.splitlines()[-1].startswith("2 figures: ")
    assert failed.returncode == 1
    assert "fig99: failed\n  not built: the config has no such figure\n2 figures: " in failed.stdout
