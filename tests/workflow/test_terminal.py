"""What a user sees of a build: through a pipe, on a terminal, and from the events of Snakemake one by one."""

import logging
import os
import pty
import signal
import subprocess
import termios
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from pipeline_trees import ROOT, SNAKEMAKE, Tree, run_module
from snakemake_logger_plugin_brief import results
from snakemake_logger_plugin_brief.handler import LogHandler
from snakemake_logger_plugin_brief.screen import Screen
from snakemake_logger_plugin_brief.words import duration, words

SNAKEFILE = """
rule all:
    input: "good.txt", "bad.txt"
rule good:
    output: "good.txt"
    log: "good.log"
    shell: "touch {output}"
rule bad:
    output: "bad.txt"
    log: "bad.log"
    shell: "seq 20 > {log}; test ! -e wait || (: > started; exec sleep 600); exit 3"
"""
"""`touch` in place of `:` would be a process, and a shell forgets a Ctrl-C while it waits for one that ends well."""


@pytest.fixture
def small(tmp_path) -> Tree:
    """A workflow of three jobs, one of which fails, or waits to be interrupted where there is a file `wait`."""
    (tmp_path / "Snakefile").write_text(SNAKEFILE)
    return Tree(tmp_path)


def command(*arguments):
    return [*SNAKEMAKE, *arguments, "--keep-going", "--logger", "brief"]


def hear_ctrl_c():
    """A shell that starts the tests in the background has them ignore Ctrl-C, and all that they start."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Terminal:
    """A pseudo-terminal of 60 columns; what a program has written on it."""

    def __init__(self):
        self.primary, self.secondary = pty.openpty()
        termios.tcsetwinsize(self.secondary, (24, 60))

    def run(self, *arguments, directory, environment=None, interrupt=None):
        """Exit status and output of a program, interrupted like Ctrl-C does once there is a file `interrupt`."""
        place = {"cwd": directory, "env": {**os.environ, "TERM": "xterm", **(environment or {})}}
        streams = dict.fromkeys(("stdin", "stdout", "stderr"), self.secondary)
        process = subprocess.Popen(arguments, start_new_session=True, preexec_fn=hear_ctrl_c, **place, **streams)
        while interrupt and not interrupt.exists():
            assert process.poll() is None, self.text()
            time.sleep(0.02)
        if interrupt:
            os.killpg(process.pid, signal.SIGINT)
        text = self.text()
        return process.wait(), text

    def text(self):
        """All that is written until the last writer is gone."""
        os.close(self.secondary)
        return b"".join(iter(self._read, b"")).decode().replace("\r\n", "\n")

    def _read(self):
        try:
            return os.read(self.primary, 4096)
        except OSError:  # the end of a terminal
            return b""


def test_a_failure_through_a_pipe(small):
    output = small.snakemake("--keep-going", "--logger", "brief", check=False)
    assert small.returncode == 1
    assert "\x1b" not in output
    assert "\r" not in output
    lines = output.splitlines()
    assert lines[0].startswith("3 jobs to do.")
    [good] = [line for line in lines if line.endswith("  good")]
    assert good.startswith("1 of 3  ")
    [log] = small.path.glob(".snakemake/log/*")
    place = lines.index("Failed: bad (exit status 3)")
    assert lines[place + 1 : -1] == ["  Its log bad.log ends:", *(f"    {number}" for number in range(6, 21))]
    assert lines[-1].startswith("Not finished after ")
    assert lines[-1].endswith(f", 1 of 3 done. Failed: bad. The full log: {log.relative_to(small.path)}")
    assert "Error in rule bad" in log.read_text()
    assert len(lines) < 25


def test_a_failure_on_a_terminal(small):
    status, output = Terminal().run(*command(), directory=small.path)
    assert status == 1
    assert "\x1b[31mFailed: bad (exit status 3)\x1b[0m\n" in output
    assert "\r\x1b[K0 of 3  " in output


def test_an_interruption_is_no_failure(small):
    (small / "wait").touch()
    status, output = Terminal().run(*command(), directory=small.path, interrupt=small / "started")
    assert status == 1
    assert "Failed" not in output
    last = output.rpartition("\r\x1b[K")[2]
    assert last.startswith("Stopped after ")
    assert last.endswith(" done. The same command goes on from here.\n")


def test_all_that_snakemake_says_is_shown_on_demand(small):
    output = small.snakemake("good", "--logger", "brief", V="1")
    [log] = small.path.glob(".snakemake/log/*")
    assert "Finished jobid: 0 (Rule: good)" in output
    assert "Finished jobid: 0 (Rule: good)" in log.read_text()


def test_a_figure_is_made_and_shown_where_it_is(tree):
    *_, finished, done, page = tree.snakemake("fig10_03").splitlines()
    assert finished.startswith("1 of 1  ")
    assert finished.endswith(" s  figure 10.3")
    assert done.endswith(": 1 job. 1 figure in results/figures/.")
    assert page == "Open first: results/notebooks/fig10_03.html"
    assert "notebooks/fig10_03.html" in (tree / "results/index.html").read_text(encoding="utf-8")
    assert tree.snakemake("fig10_03").splitlines()[1:] == [f"Nothing to do: all is up to date. {page}"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--dry-run", "fig10_03"], "rule fig10_03:"),
        (["--list-target-rules"], "\nfigures\n"),
        (["no_such_figure"], "No rule to produce no_such_figure"),
        (["--lint"], "Lints for rule figure_check"),
    ],
)
def test_other_commands_say_what_they_said(tree, arguments, said):
    assert said in run_module(tree.path, "snakemake", "--cores", "2", *arguments)[1]


def test_help_has_straight_columns():
    lines = subprocess.run(["make", "help"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.splitlines()
    entries = [line for line in lines if "  " in line]
    assert len(entries) > 10
    column = entries[0].index("list these commands")
    assert {line[column - 2 : column] for line in entries} == {"  "}
    assert not [line for line in entries if line[column] == " "]


"""Events one by one."""


def record(event, created=0.0, message="", level=logging.INFO, **fields):
    entry = logging.LogRecord("snakemake", level, "", 0, message, (), None)
    entry.__dict__ |= {"created": created, "event": event, **fields}
    return entry


def jobs(**rules):
    return record(LogEvent.RUN_INFO, stats={**rules, "total": sum(rules.values())})


def started(jobid, rule, created=0.0, benchmark=None, log=("a.log",), **wildcards):
    about = {"rule_name": rule, "wildcards": wildcards, "output": ["a"], "log": list(log), "benchmark": benchmark}
    return record(LogEvent.JOB_INFO, created, jobid=jobid, **about)


def finished(jobid, created):
    return record(LogEvent.JOB_FINISHED, created, job_id=jobid)


def failed(jobid, rule, cause="exit status 1", log=()):
    yield record(LogEvent.ERROR, message=cause, level=logging.ERROR, exception="RuleException")
    yield record(LogEvent.JOB_ERROR, level=logging.ERROR, jobid=jobid, rule_name=rule, log=list(log))


def said(message, level=logging.INFO):
    return record(None, message=message, level=level)


@pytest.fixture
def handler(tmp_path, monkeypatch):
    """A handler that writes into a file; time passes when it is told so."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(results, "START", str(tmp_path))
    monkeypatch.setattr(LogHandler, "_clock", lambda self: None)
    asked = dict.fromkeys(("dryrun", "verbose", "printshellcmds", "debug_dag", "quiet", "nocolor"), False)
    handler = LogHandler(SimpleNamespace(**asked), None)
    with open(tmp_path / "screen", "w+") as stream:
        handler._screen = Screen(stream)
        yield handler


def shown(handler, *records):
    """The lines that the records bring."""
    before = len(Path("screen").read_text())
    for entry in records:
        handler.handle(entry)
    return Path("screen").read_text()[before:].splitlines()


def test_jobs_of_one_rule_are_one_line_when_the_last_is_done(handler):
    shown(handler, jobs(simulation=2, all=1))
    starts = [started(1, "simulation", 10, case="equal"), started(2, "simulation", 20, case="weak")]
    assert shown(handler, *starts, finished(2, 25)) == []
    assert shown(handler, finished(1, 133)) == ["2 of 3     2 min 8 s  simulation (2)"]


def test_jobs_that_come_to_be_known_while_others_run_are_one_line_too(handler):
    shown(handler, jobs(plan=1, table=1), started(0, "plan"), finished(0, 1))
    shown(handler, record(LogEvent.PROGRESS, done=1, total=4))
    shown(handler, started(1, "tile", 10), started(2, "tile", 10))
    assert shown(handler, finished(1, 20)) == []
    assert shown(handler, finished(2, 30)) == ["3 of 4          30 s  tile (2)"]
    assert shown(handler, started(3, "table", 30), finished(3, 31)) == ["4 of 4           1 s  table"]


def test_a_job_that_takes_long_is_named_once_with_the_time_of_the_last_build(handler):
    Path("old.tsv").write_text("s\th:m:s\n92.4\t0:01:32\n")
    shown(handler, jobs(tile_of_sweep=2), started(1, "tile_of_sweep", 10, "old.tsv", tile="2", tiles="4"))
    handler.tick(24)
    assert shown(handler) == []
    handler.tick(26)
    handler.tick(27)
    lines = Path("screen").read_text().splitlines()[1:]
    assert lines == ["0 of 2  still running: tile of sweep 2 4 (16 s, usually 1 min 32 s)"]


def test_the_words_of_a_scheduler_are_told(handler):
    """Of a job that it did not take, or ended, there is no more to tell; its whole command is in the log."""
    refused = (
        "SLURM sbatch failed. The error message was 'invalid partition: x'.\n    sbatch call:\n        sbatch -p x"
    )
    about = dict(level=logging.ERROR, jobid=1, rule_name="a", log=[], rule_msg=refused)
    shown(handler, jobs(a=1), started(1, "a"), record(LogEvent.JOB_ERROR, **about))
    handler.tick(1)
    assert Path("screen").read_text().splitlines()[1:] == [
        "Failed: a",
        "  SLURM sbatch failed. The error message was 'invalid partition: x'.",
    ]


def test_a_failure_is_told_unless_an_interruption_follows(handler):
    shown(handler, jobs(a=1, b=1, c=1), started(1, "a"), *failed(1, "a"))
    handler.tick(1)
    assert Path("screen").read_text().splitlines()[1:] == ["Failed: a (exit status 1)"]
    interruption = said("Terminating processes on user request, this might take some time.")
    shown(handler, started(2, "b"), *failed(2, "b"), interruption, *failed(3, "c"))
    handler.close()
    assert Path("screen").read_text().splitlines()[2:] == [
        "Stopped after 0 s, 0 of 3 done. The same command goes on from here."
    ]


def test_a_log_is_shown_without_control_characters_and_a_cause_that_no_log_tells(handler):
    Path("a.log").write_bytes(b"\x1b[0;31mValueError\x1b[0m\x07: \xff\n\n")
    shown(handler, jobs(a=1, b=1, c=1), *failed(1, "a", "died with <Signals.SIGKILL: 9>", ["a.log"]))
    shown(handler, *failed(2, "b", "RuleException:\nx", ["missing.log"]))
    handler.close()
    assert Path("screen").read_text().splitlines()[1:-1] == [
        "Failed: a (SIGKILL)",
        "  Its log a.log ends:",
        "    ValueError: \ufffd",
        "Failed: b",
        "  Its log missing.log ends:",
        "    (nothing)",
        "  RuleException:",
        "  x",
    ]


def test_a_job_that_is_tried_again_is_done(handler):
    shown(handler, jobs(a=1), started(0, "a"), *failed(0, "a"), started(0, "a"), finished(0, 3))
    handler.close()
    assert "Done in 3 s: 1 job. Results are in results/." in Path("screen").read_text()


def test_errors_and_warnings_of_snakemake_itself_are_shown(handler):
    missing = record(LogEvent.ERROR, message="Missing output", level=logging.ERROR, exception="MissingOutputException")
    assert shown(handler, said("Building DAG of jobs..."), said("Unlocked.")) == ["Unlocked."]
    shown(handler, jobs(a=1))
    assert shown(handler, said("Select jobs to execute..."), said("Beware", logging.WARNING), missing) == [
        "Beware",
        "Missing output",
    ]
    handler.close()
    assert Path("screen").read_text().endswith("Not finished after 0 s, 0 of 1 done. The full log: .snakemake/log/\n")


def test_an_event_that_cannot_be_shown_stops_nothing(handler, monkeypatch):
    monkeypatch.setattr(logging, "raiseExceptions", False)
    shown(handler, jobs(a=1), finished(7, 1.0))
    assert shown(handler, said("Beware", logging.WARNING)) == ["Beware"]


@pytest.mark.parametrize("no_colour", ["", "1"])
def test_the_line_that_changes_fits_and_goes_before_others(monkeypatch, no_colour):
    monkeypatch.setenv("NO_COLOR", no_colour)
    monkeypatch.setenv("TERM", "xterm")
    terminal = Terminal()
    with os.fdopen(os.dup(terminal.secondary), "w") as stream:
        screen = Screen(stream)
        screen.status(70 * "x")
        screen.status(70 * "x")
        screen.say("Failed: a")
    failure = "Failed: a" if no_colour else "\x1b[31mFailed: a\x1b[0m"
    assert terminal.text() == f"\r\x1b[K{59 * 'x'}\r\x1b[K{failure}\n"


def test_a_job_without_a_log_has_the_terminal_for_itself(handler):
    shown(handler, jobs(figure_check=1), started(0, "figure_check", log=()))
    assert handler._build.status(1) == ""


@pytest.mark.parametrize(
    ("rule", "expected"),
    [
        ("fig10_03", "figure 10.3"),
        ("companion_10_04", "companion 10.4"),
        ("gather_fixed_points", "gather fixed points"),
    ],
)
def test_rules_in_words(rule, expected):
    assert words(rule) == expected


@pytest.mark.parametrize(("seconds", "expected"), [(0.2, "0 s"), (59.6, "1 min 0 s"), (3723, "1 h 2 min 3 s")])
def test_times_in_words(seconds, expected):
    assert duration(seconds) == expected
