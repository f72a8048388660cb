"""Jobs that a killed build has left on a cluster, with a stand-in for Slurm; the real one is in tests/cluster/."""

import os
from pathlib import Path

import pytest

from vibroimpact_pipeline import left_jobs

SQUEUE = '#!/bin/sh\ntest ! -e away || { echo "no scheduler" >&2; exit 1; }\ncat queue\n'
SCANCEL = '#!/bin/sh\necho "$@" >> ended\ntest -e deaf || : > queue\n'


@pytest.fixture
def queue(tmp_path, monkeypatch):
    """A queue with one job of ours, one of another directory, and one that somebody sent by hand."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    for command, script in (("squeue", SQUEUE), ("scancel", SCANCEL)):
        Path(command).write_text(script)
        Path(command).chmod(0o755)
    lines = [f"1|vibroimpact_x|{tmp_path}", "2|vibroimpact_y|/elsewhere", f"3|mine|{tmp_path}"]
    Path("queue").write_text("\n".join(lines))
    return lines


def test_jobs_of_this_directory_are_ended(queue):
    left_jobs.end_left_jobs()
    assert Path("ended").read_text() == "1\n"


def test_jobs_of_others_are_not(queue):
    Path("queue").write_text("\n".join(queue[1:]))
    left_jobs.end_left_jobs()
    assert not Path("ended").exists()


def test_a_scheduler_that_is_away_is_named(queue):
    Path("away").touch()
    with pytest.raises(RuntimeError, match=r"^Slurm: no scheduler\. Build again once it answers\.$"):
        left_jobs.end_left_jobs()


def test_a_job_that_does_not_end_is_named(queue, monkeypatch):
    Path("deaf").touch()
    monkeypatch.setattr(left_jobs, "PATIENCE", -1)
    with pytest.raises(RuntimeError, match=r"^Slurm: job 1 of a build before does not end"):
        left_jobs.end_left_jobs()
