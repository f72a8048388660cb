"""Continuous integration installs what some tests need, and goes on to the tests where it cannot."""

import shutil
import subprocess

import pytest

from pipeline_trees import ROOT

SLURM = "slurmctld slurmd slurm-client munge"
INSTALLED = f"""\
apt-get update -q
apt-get install -q -y --no-install-recommends chromium
apt-get update -q
apt-get install -q -y --no-install-recommends {SLURM}
"""


@pytest.mark.parametrize(
    ("failing", "calls", "said"),
    [
        ("nothing", f"{INSTALLED}make cluster-tools\nmake test\n", ""),
        ("update", "apt-get update -q\napt-get update -q\nmake test\n", "slurmctld: not here, and not installed."),
        ("install", f"{INSTALLED}make test\n", "slurmctld: not here, and not installed."),
        ("cluster-tools", f"{INSTALLED}make cluster-tools\nmake test\n", "Slurm plugin: not installed."),
    ],
)
def test_what_cannot_be_installed_does_not_stop_the_tests(tmp_path, failing, calls, said):
    (tmp_path / ".ci").mkdir()
    shutil.copy(ROOT / ".ci/run", tmp_path / ".ci/run")
    commands = tmp_path / "bin"
    commands.mkdir()
    for command in ("dirname", "sh"):
        (commands / command).symlink_to(shutil.which(command))
    record = '#!/bin/sh\necho "${0##*/} $*" >> calls\ntest "$1" != "$FAILING"\n'
    for command, script in {"apt-get": record, "make": record, "id": "#!/bin/sh\necho 0\n"}.items():
        (commands / command).write_text(script)
        (commands / command).chmod(0o755)
    run = subprocess.run(
        [tmp_path / ".ci/run"], env={"PATH": str(commands), "FAILING": failing}, stderr=subprocess.PIPE, text=True
    )
    assert run.returncode == 0
    assert (tmp_path / "calls").read_text() == calls
    assert said in run.stderr
