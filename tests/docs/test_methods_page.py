"""Every table of docs/methods.md, computed anew."""

import functools

import pytest

from pipeline_trees import ROOT
from vibroimpact.accuracy.errors import compare
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.accuracy.stress_tests import CHAPTER, RESTING, SETTLED
from vibroimpact.integrators.contact_laws import Law
from vibroimpact.integrators.ivanov import variants
from vibroimpact.integrators.penalty import Penalty, PowerLaw
from vibroimpact.system import System

PAGE = (ROOT / "docs/methods.md").read_text(encoding="utf-8")
SYSTEM, CYCLES = System(**CHAPTER), 10
LAWS = [Law(n, 0.5 * (n - 1.0)) for n in (1.0, 1.5, 2.0, 3.0)] + [Law(1.5, 1.5)]


def table(first):
    """The numbers of the rows below a heading, without the first column."""
    rows = PAGE[PAGE.index(f"\n| {first} |") :].strip().split("\n\n")[0].splitlines()[2:]
    return [[float(cell) for cell in row.split("|")[2:-1]] for row in rows]


@functools.cache
def reference():
    return proven_run(SYSTEM, SETTLED, CYCLES).run


def error(method, setting):
    return compare(method.run(SYSTEM, SETTLED, CYCLES, 0.0, setting), reference(), SYSTEM.period).final


@pytest.mark.parametrize("row", range(len(LAWS)))
def test_laws_of_contact(row):
    method, said = Penalty("", LAWS[row]), table("law")[row]
    assert [error(method, 10.0**-n) for n in (2, 3, 4, 5)] == pytest.approx(said[:4], rel=0.06)
    flying = method.run(SYSTEM, SETTLED, CYCLES, 0.0, 1e-5).steps / CYCLES
    sticking = [method.run(SYSTEM, RESTING, 2, 0.0, duration).steps / 2 for duration in (1e-3, 1e-4, 1e-5)]
    assert [flying, *sticking] == pytest.approx(said[4:], rel=0.05)


def test_power_law():
    for exponent, said in zip((30, 100, 1_000, 10_000), table("$n$"), strict=True):
        assert [error(PowerLaw("", speed=speed), exponent) for speed in (0.3, 1.0, 3.0)] == pytest.approx(
            said, rel=0.06
        )


def test_ivanov():
    for steps, said in zip((30, 100, 300, 1_000), table("steps per cycle"), strict=True):
        assert [error(method, steps) for method in variants()] == pytest.approx(said, rel=0.06)
