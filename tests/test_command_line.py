"""python -m vibroimpact: what it prints is what the library says; what is wrong is one line and exit status 2."""

import csv
import io
import subprocess
import sys

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.cli.parser import main


def table(capsys, words):
    """Rows of the CSV that a command prints."""
    assert main(words.split()) == 0
    return list(csv.DictReader(io.StringIO(capsys.readouterr().out)))


def refusal(capsys, words):
    """Exit status and the only line that a command prints."""
    with pytest.raises(SystemExit) as end:
        main(words.split())
    printed = capsys.readouterr()
    assert printed.out == ""
    said = [line for line in printed.err.splitlines(keepends=True) if ": compiling " not in line]
    assert len(said) == 1
    return end.value.code, said[0]


def system_of(case, **changes):
    return vi.System(**{**PARAMETERS, **dict(zip(("f10_hat", "f20_hat"), FORCES[case], strict=True)), **changes})


def test_fixed_points_and_orbits_that_are_motions(capsys):
    rows = table(capsys, "fixed-points --case unequal")
    points = vi.fixed_points(system_of("unequal"))
    assert [[float(row["C1"]), float(row["psi2"])] for row in rows] == [[p.C[0], p.psi[1]] for p in points]
    said = [(point.stability.fast, point.stability.slow, point.stability.theory) for point in points]
    assert [(row["fast"], row["slow"], row["theory"]) for row in rows] == said
    rows = table(capsys, "orbits")
    orbits = [orbit for orbit in vi.orbits(system_of("equal")) if orbit.admissible]
    said = [(str(one.symmetric), one.impact_phases[1, 1], one.stability) for one in orbits]
    assert [(row["symmetric"], float(row["phase2_minus"]), row["exact"]) for row in rows] == said


def test_options_change_the_system(capsys):
    rows = table(capsys, "fixed-points --case weak --kappa 0.7 --f10-hat -1e-1")
    points = vi.fixed_points(system_of("weak", kappa=0.7, f10_hat=-0.1))
    assert [float(row["C2"]) for row in rows] == [point.C[1] for point in points]


def test_samples_and_events_of_a_run(capsys):
    words = "simulate --state -1e-3 0 0.1 -.5 0 0 0 0.3 --cycles 20 --tau0 0.5"
    run = vi.simulate(system_of("equal"), [-1e-3, 0, 0.1, -0.5, 0, 0, 0, 0.3], 20, 0.5)
    rows = [[float(value) for value in row.values()] for row in table(capsys, f"{words} --samples-per-cycle 4")]
    np.testing.assert_allclose([row[0] for row in rows], 0.5 + np.arange(81) * run.system.period / 4, rtol=1e-15)
    np.testing.assert_array_equal(rows[-1][1:], run.final)
    said = [(float(r["tau"]), int(r["wall"]), r["kind"], float(r["dY2"])) for r in table(capsys, f"{words} --events")]
    assert said == [(event["tau"], event["wall"], vi.KINDS[event["kind"]], event["state"][7]) for event in run.events]


BAD = {
    "fixed-points --kappa 1.2": "kappa", "fixed-points --kappa nan": "kappa", "fixed-points --kappa high": "--kappa",
    "fixed-points --kapa 0.5": "--kapa", "fixed-points --case strong": "--case", "simulate --cycles -1": "cycles",
    "simulate --samples-per-cycle 0": "samples-per-cycle", "simulate --state 1 2": "--state",
    "simulate --cycles 1000000 --samples-per-cycle 1000": "cycles", "simulate --state 0 1.5 0 0 0 0 0 0": "state",
    "simulate --plot run.png": "--plot", "simulate --output nowhere/run.csv": "output", "response": "COMMAND",
    "design --M 1 --m 1 --k 1 --c 1 --F 1 --from 1 --to 2 --plot design.gif": "plot", "orbit": "COMMAND", "": "COMMAND",
}  # fmt: skip


@pytest.mark.parametrize("words", BAD)
def test_wrong_words_are_one_line_that_names_the_option(capsys, words):
    status, line = refusal(capsys, words)
    assert status == 2
    assert BAD[words] in line
    assert "--help" in line


def test_a_run_that_fails_is_one_line(capsys):
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


def test_a_reader_that_has_seen_enough_is_no_error():
    command = f"{sys.executable} -m vibroimpact simulate --cycles 1000 | head -2"
    run = subprocess.run(["bash", "-o", "pipefail", "-c", command], capture_output=True, text=True, check=False)
    assert run.returncode == 0
    assert len(run.stdout.splitlines()) == 2
    assert run.stderr == ""


INTERRUPTED = """
import os, signal, sys, threading
from vibroimpact.__main__ import main

signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell in the background has its commands ignore it
threading.Timer(3.0, os.kill, [os.getpid(), signal.SIGINT]).start()
sys.argv = "vibroimpact simulate --events --cycles 10000000 --state 0 0 0 0 0 0.5 0 -0.5".split()
sys.exit(main())
"""


@pytest.mark.thorough
def test_an_interrupt_is_one_line_and_ends_the_command_by_the_signal():
    """A shell takes that for the status 130 and ends its loop, if the command is in one."""
    run = subprocess.run([sys.executable, "-c", INTERRUPTED], capture_output=True, text=True, check=False, timeout=300)
    assert (run.returncode, run.stdout) == (-2, "")
    assert [line for line in run.stderr.splitlines() if ": compiling " not in line] == ["vibroimpact: interrupted"]


def test_every_command_has_its_help(capsys):
    for words in ([], ["fixed-points"], ["orbits"], ["simulate"], ["design"], ["compile"]):
        with pytest.raises(SystemExit) as end:
            main([*words, "--help"])
        assert end.value.code == 0
        assert "usage: vibroimpact" in capsys.readouterr().out
