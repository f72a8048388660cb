"""A job that hangs, or that somebody has stopped, is told; a build does not end one by itself."""

import os
import re
import signal

from pipeline_trees import Tree
from snakemake_logger_plugin_brief.jobs import SILENT, Job

SNAKEFILE = """
rule stopped:
    output: "stopped.txt"
    log: "stopped.log"
    shell: "touch {log}; kill -STOP $$; touch {output}"
"""


def test_a_stopped_job_is_told_with_the_command_that_lets_it_go_on(tmp_path):
    (tmp_path / "Snakefile").write_text(SNAKEFILE)
    build = Tree(tmp_path).start("stopped", "--logger", "brief", SILENT_SECONDS="0.5")
    lines = []
    while not (found := re.fullmatch(r"Stopped by a signal, .*: kill -CONT (\d+)\n", line := build.stdout.readline())):
        assert line, lines
        lines.append(line)
    assert re.fullmatch(r"0 of 1  silent for .* s: stopped \(.* s\)\n", lines[-1])
    assert not (tmp_path / "stopped.txt").exists()
    os.kill(int(found[1]), signal.SIGCONT)
    rest = build.communicate()[0]
    assert build.returncode == 0, rest
    assert (tmp_path / "stopped.txt").exists()


def job(tmp_path, usual=None):
    """A job that began, and wrote to its log, at 0 s."""
    log = tmp_path / "a.log"
    log.touch()
    os.utime(log, (0, 0))
    return Job("simulation", "simulation weak", 0.0, [], [str(log)], usual)


def test_a_silent_job_is_told_again_when_its_silence_has_doubled(tmp_path):
    silent = job(tmp_path)
    assert silent.may_hang(SILENT - 1) is None
    assert silent.may_hang(SILENT) == "silent for 5 min 0 s: simulation weak (5 min 0 s)"
    assert silent.may_hang(2 * SILENT - 1) is None
    assert silent.may_hang(2 * SILENT) == "silent for 10 min 0 s: simulation weak (10 min 0 s)"


def test_a_job_that_usually_takes_as_long_is_not_told(tmp_path):
    usual = job(tmp_path, usual=SILENT)
    assert usual.may_hang(2 * SILENT - 1) is None
    assert usual.may_hang(2 * SILENT).startswith("silent for 10 min 0 s: ")


def test_a_job_that_writes_to_its_log_is_not_told(tmp_path):
    at_work = job(tmp_path)
    os.utime(at_work.logs[0], (SILENT, SILENT))
    assert at_work.may_hang(2 * SILENT - 1) is None
