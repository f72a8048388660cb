"""The command line prints results of the library; an error is one line, with exit status 2 for wrong arguments."""

import csv
import io
import subprocess
import sys

import numpy as np
import pytest

import vibroimpact as vi
from chapter import system_of
from programs import run_program
from vibroimpact.cli.parser import main


def table(capsys, arguments):
    """Return the rows of the CSV table that a command prints."""
    assert main(arguments.split()) == 0
    return list(csv.DictReader(io.StringIO(capsys.readouterr().out)))


def refusal(capsys, arguments):
    """Return the exit status and the only line that a failing command prints."""
    with pytest.raises(SystemExit) as end:
        main(arguments.split())
    printed = capsys.readouterr()
    assert printed.out == ""
    lines = [line for line in printed.err.splitlines(keepends=True) if ": compiling " not in line]
    assert len(lines) == 1
    return end.value.code, lines[0]


def test_fixed_points_are_those_of_the_case_with_changed_parameters(capsys):
    rows = table(capsys, "fixed-points --case weak --kappa 0.7 --f10-hat -1e-1 --f20-hat 1")
    points = vi.fixed_points(system_of("weak", kappa=0.7, f10_hat=-0.1, f20_hat=1.0))
    assert [[float(row["C1"]), float(row["psi2"])] for row in rows] == [[p.C[0], p.psi[1]] for p in points] != []
    verdicts = [(point.stability.fast, point.stability.slow, point.stability.theory) for point in points]
    assert [(row["fast"], row["slow"], row["theory"]) for row in rows] == verdicts


def test_orbits_are_the_admissible_ones(capsys):
    orbits = [orbit for orbit in vi.orbits(system_of("equal")) if orbit.admissible]
    expected = [(str(one.symmetric), one.impact_phases[1, 1], one.stability) for one in orbits]
    rows = table(capsys, "orbits")
    assert [(row["symmetric"], float(row["phase2_minus"]), row["exact"]) for row in rows] == expected


def test_samples_and_events_are_those_of_a_run(capsys):
    command = "simulate --state -1e-3 0 0.1 -.5 0 0 0 0.3 --cycles 20 --tau0 0.5"
    run = vi.simulate(system_of("equal"), [-1e-3, 0, 0.1, -0.5, 0, 0, 0, 0.3], 20, 0.5)
    rows = [[float(value) for value in row.values()] for row in table(capsys, f"{command} --samples-per-cycle 4")]
    np.testing.assert_allclose([row[0] for row in rows], 0.5 + np.arange(81) * run.system.period / 4, rtol=1e-15)
    np.testing.assert_array_equal(rows[-1][1:], run.final)
    rows = table(capsys, f"{command} --events")
    events = [(float(row["tau"]), int(row["wall"]), row["kind"], float(row["dY2"])) for row in rows]
    assert events == [(event["tau"], event["wall"], vi.KINDS[event["kind"]], event["state"][7]) for event in run.events]


BAD = {
    "fixed-points --kappa 1.2": "kappa", "fixed-points --kappa nan": "kappa", "fixed-points --kappa high": "--kappa",
    "fixed-points --kapa 0.5": "--kapa", "fixed-points --case strong": "--case", "simulate --cycles -1": "cycles",
    "simulate --samples-per-cycle 0": "samples-per-cycle", "simulate --state 1 2": "--state",
    "simulate --cycles 1000000 --samples-per-cycle 1000": "cycles", "simulate --state 0 1.5 0 0 0 0 0 0": "state",
    "simulate --plot run.png": "--plot", "simulate --output nowhere/run.csv": "output", "response": "COMMAND",
    "design --M 1 --m 1 --k 1 --c 1 --F 1 --from 1 --to 2 --plot design.gif": "plot", "orbit": "COMMAND", "": "COMMAND",
}  # fmt: skip


@pytest.mark.parametrize("arguments", BAD)
def test_an_error_in_arguments_is_one_line_that_names_the_option(capsys, arguments):
    status, line = refusal(capsys, arguments)
    assert status == 2
    assert BAD[arguments] in line
    assert "--help" in line


def test_the_error_of_a_failing_run_is_one_line(capsys):
    status, line = refusal(capsys, "simulate --cycles 1 --state 1e300 1e300 0 0 0 0 0 0")
    assert status == 1
    assert "time stands still" in line


def test_a_table_that_cannot_be_saved_is_printed(capsys):
    with pytest.raises(SystemExit) as end:
        main(["fixed-points", "--output", "/dev/full"])
    printed = capsys.readouterr()
    assert end.value.code == 1
    assert len(printed.out.splitlines()) == 4
    assert "output: /dev/full cannot be written (No space left on device), so the table was printed" in printed.err
    assert printed.err.count("\n") == 1


def test_a_closed_pipe_is_not_an_error():
    command = f"{sys.executable} -m vibroimpact simulate --cycles 1000 | head -2"
    run = subprocess.run(["bash", "-o", "pipefail", "-c", command], capture_output=True, text=True, check=False)
    assert run.returncode == 0
    assert len(run.stdout.splitlines()) == 2
    assert run.stderr == ""


INTERRUPTED = """
import os, signal, sys, threading
from vibroimpact.__main__ import main

signal.signal(signal.SIGINT, signal.default_int_handler)  # background jobs of a shell ignore the signal
threading.Timer(3.0, os.kill, [os.getpid(), signal.SIGINT]).start()
sys.argv = "vibroimpact simulate --events --cycles 10000000 --state 0 0 0 0 0 0.5 0 -0.5".split()
sys.exit(main())
"""


@pytest.mark.thorough
def test_an_interrupt_is_one_line_and_ends_the_command_by_the_signal():
    """A shell then has the status 130 and ends a loop that contains the command."""
    run = run_program(INTERRUPTED)
    assert (run.returncode, run.stdout) == (-2, "")
    assert [line for line in run.stderr.splitlines() if ": compiling " not in line] == ["vibroimpact: interrupted"]


def test_every_command_has_a_help_text(capsys):
    for command in ([], ["fixed-points"], ["orbits"], ["simulate"], ["design"], ["compile"]):
        with pytest.raises(SystemExit) as end:
            main([*command, "--help"])
        assert end.value.code == 0
        assert "usage: vibroimpact" in capsys.readouterr().out
