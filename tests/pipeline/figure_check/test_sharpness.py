"""How small a change of the published numbers is seen, on a machine like that of the reference and on another."""

import json
import shutil

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from checking import LIMITS, assert_caught
from pipeline_trees import ROOT
from vibroimpact.figures import fig10_08
from vibroimpact.figures.kit import tables
from vibroimpact_pipeline.figure_check.compare import check, rules_of
from vibroimpact_pipeline.figure_check.origins import FILE
from vibroimpact_pipeline.figure_check.tables import differences_in_structure, distances

LIKE, OTHER = True, False
"""Machines: one that rounds as that of the reference, and any."""


def found(name, change, machine):
    """What the check finds in a published table after a change."""
    old = tables.read(ROOT / "figures" / f"{name}.csv")
    new, rules = change(old.copy()), rules_of(name, LIMITS, same=machine)
    other_rows = differences_in_structure(old, new, rules)
    return other_rows or [far.column for far in distances(old, new, rules) if not far.distance <= far.limit]


def worse_arithmetic(factor):
    def change(table):
        measured = table["series"] == "measured"
        return table.assign(error=table["error"].where(~measured, factor * table["error"]))

    return change


def lost_bursts(table):
    """Three of ten, wherever they are."""
    bursts = table.index[table["panel"] == "bursts"]
    return table.drop(np.random.default_rng(1).choice(bursts, 3 * len(bursts) // 10, replace=False))


def longer_bursts(table):
    return table.assign(length=table["length"].where(table["series"] == "window", 1.02 * table["length"]))


def one_cell(table):
    first = table.index[table["series"] == "start"][0]
    label = table["label"].where(table.index != first, "symmetric")
    return table.assign(label=label)


@pytest.mark.parametrize(
    ("name", "change", "machine"),
    [
        ("companion_horizon", worse_arithmetic(1e3), OTHER),
        ("companion_horizon", worse_arithmetic(30), OTHER),
        ("companion_horizon", worse_arithmetic(1.01), LIKE),
        ("companion_modulation", lost_bursts, OTHER),
        ("companion_modulation", lost_bursts, LIKE),
        ("companion_modulation", longer_bursts, LIKE),
        ("companion_basins", one_cell, LIKE),
    ],
)
def test_a_change_of_statistics_is_caught(name, change, machine):
    assert found(name, lambda table: table, machine) == []
    assert found(name, change, machine)


@pytest.mark.parametrize(("name", "change"), [("companion_modulation", longer_bursts), ("companion_basins", one_cell)])
def test_what_another_processor_may_change_is_no_failure_there(name, change):
    assert found(name, change, OTHER) == []


def settled(gamma1_hat):
    """Figure 10.8 after the motion has settled."""
    system = vi.System(**PARAMETERS | {"gamma1_hat": gamma1_hat}, f10_hat=1.0, f20_hat=1.0)
    tau = (1500 + np.arange(4 * 100 + 1) / 100) * system.period
    run = vi.simulate(system, np.zeros(8), 1504, sample_times=tau)
    return fig10_08.compute(*motion_tables(tau, run))


def motion_tables(tau, run):
    samples = tables.curve("", "", tau=tau, X2=run.samples[:, 2], Y2=run.samples[:, 3])
    events = tables.curve("", "", **{name: run.events[name] for name in ("tau", "module", "wall")})
    return samples, events.assign(X2=run.events["state"][:, 2])


@pytest.mark.parametrize(("gamma1_hat", "caught"), [(0.2, False), (0.2 * 1.003, True)])
def test_gamma1_off_by_three_per_mille_moves_figure_10_8_by_more_than_its_limit(gamma1_hat, caught):
    old, new, rules = settled(0.2), settled(gamma1_hat), rules_of("fig10_08", LIMITS)
    assert differences_in_structure(old, new, rules) == []
    assert any(far.distance > far.limit for far in distances(old, new, rules)) == caught


def test_machines_are_alike_if_all_that_rounds_is_the_same(reference, tmp_path):
    for path in reference.glob("fig10_04.*"):
        shutil.copy(path, tmp_path)
    known = {"processor": "one", "numpy": "2"}
    (tmp_path / FILE).write_text(json.dumps({"fig10_04": known}))
    sidecar = tmp_path / "fig10_04.provenance.json"
    for said, alike in [
        ({"rounded by": known}, True),
        ({"rounded by": known | {"processor": "another"}}, False),
        ({}, False),
        ([], False),
    ]:
        sidecar.write_text(json.dumps(said))
        assert check("fig10_04", tmp_path, tmp_path, LIMITS)["same rounding"] is alike


def test_on_a_like_machine_the_verdict_says_so(tmp_path):
    """Of the published set itself, with a table in which one start ends elsewhere."""
    name = "companion_basins"
    shutil.copytree(ROOT / "figures", tmp_path / "old")
    new = shutil.copytree(tmp_path / "old", tmp_path / "new")
    tables.write(one_cell(tables.read(new / f"{name}.csv")), new / f"{name}.csv")
    known = {"processor": "one"}
    (tmp_path / "old" / FILE).write_text(json.dumps({name: known}))
    (new / f"{name}.provenance.json").write_text(json.dumps({"rounded by": known}))
    for kind in ("pdf", "svg"):
        (new / f"{name}.{kind}").write_bytes(b"")
    assert_caught(check(name, tmp_path / "old", new, LIMITS), "of its axis or rows, limit 1e-09, rounded alike")
