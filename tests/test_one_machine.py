"""The design of a ball for one machine: against closed forms, the momentum of the ball, its energy, and finer grids."""

import csv
from dataclasses import replace

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact import one_machine
from vibroimpact.cli.parser import main

MACHINE = vi.PhysicalSystem.single(M=120.0, m=6.0, k=3e5, c=240.0, F=40.0)
BAND = (7.4, 8.4)
CHOICE = {"clearances": [0.001, 0.002], "restitutions": [0.4]}
OPTIONS = "design --M 120 --m 6 --k 3e5 --c 240 --F 40 --from 7.4 --to 8.4 --clearance 0.001 0.002 --restitution 0.4"
WORDS = OPTIONS.split()


@pytest.fixture(scope="module")
def found():
    return vi.design(MACHINE, BAND, **CHOICE)


def test_without_ball_and_with_it_fixed_the_peak_is_that_of_an_oscillator(found):
    for mass, said in ((120.0, found.without), (126.0, found.fixed)):
        ratio = 240.0 / (2 * np.sqrt(mass * 3e5))
        assert said == pytest.approx(40.0 / 3e5 / (2 * ratio * np.sqrt(1 - ratio**2)), rel=1e-9)


def test_the_choice_is_the_lowest_candidate_and_beats_neither_its_measurement_nor_the_absorber(found):
    rows = found.candidates
    assert [(row["clearance_m"], row["restitution"]) for row in rows] == [(0.001, 0.4), (0.002, 0.4)]
    lowest = min(rows, key=lambda row: row["peak_m"])
    assert (found.machine.L, found.machine.kappa) == (lowest["clearance_m"], 0.4)
    assert found.peak >= max(row["with_m"] for row in found.response) * (1 - 1e-12)
    assert found.absorber < found.peak < found.without
    assert max(row["without_m"] for row in found.response) == pytest.approx(found.without, rel=0.02)


def run_at(hertz, L=0.002, kappa=0.4):
    """A machine driven at a frequency, and its run after a transient."""
    omega = 2 * np.pi * hertz
    machine = replace(MACHINE, L=L, kappa=kappa, omega1=omega, omega2=omega)
    system = machine.dimensionless()
    return machine, vi.simulate(system, vi.simulate(system, np.zeros(8), 200).final, 60)


def test_impulses_are_changes_of_the_momentum_of_the_ball():
    machine, run = run_at(7.9)
    events = run.events[(run.events["module"] == 1) & (run.events["kind"] == vi.IMPACT)]
    assert len(events) > 100
    assert len(events) == len(run.events)
    # Between its impacts the ball is free, so the velocity before an impact is that after the one before.
    momentum = machine.m * machine.L * machine.omega10 * events["state"][:, 5]
    told = one_machine._impacts(machine, run)
    assert told["impulse_Ns"] == pytest.approx(np.abs(np.diff(momentum)).mean(), rel=0.02)
    seconds = 60 / 7.9
    assert told["impacts_per_s"] == pytest.approx(len(events) / seconds)
    assert told["impulse_Ns_per_s"] == pytest.approx(told["impulse_Ns"] * told["impacts_per_s"])


def test_speeds_of_impacts_account_for_the_energy_that_impacts_take():
    machine, run = run_at(7.9)
    reduced = machine.M * machine.m / (machine.M + machine.m)
    states = run.events["state"][(run.events["module"] == 1) & (run.events["kind"] == vi.IMPACT)]
    before = machine.L * machine.omega10 * np.abs(states[:, 4] - states[:, 5]) / machine.kappa
    lost = 0.5 * reduced * (1 - machine.kappa**2) * (before**2).sum()
    joule = machine.k1 * machine.L**2
    assert lost == pytest.approx(joule * np.sum(run.energy.impacts), rel=1e-9)
    assert one_machine._impacts(machine, run)["impact_speed_m_s"] == pytest.approx(before.mean())


def test_the_share_of_sticking_is_that_of_fine_samples():
    machine, run = run_at(7.9, L=3e-5, kappa=0.1)
    assert (run.events["kind"] == vi.STICK).any()
    times = np.linspace(0, run.cycles * run.system.period, 60_001)[:-1]
    samples = vi.simulate(run.system, vi.simulate(run.system, np.zeros(8), 200).final, 60, sample_times=times).samples
    gap, speed = samples[:, 0] - samples[:, 1], samples[:, 4] - samples[:, 5]
    share = np.mean((np.abs(np.abs(gap) - 1) < 1e-9) & (np.abs(speed) < 1e-9))
    assert 0.05 < share < 1
    assert one_machine._impacts(machine, run)["sticking"] == pytest.approx(share, abs=2e-3)


def test_finer_frequencies_change_neither_the_choice_nor_its_peak(found, monkeypatch):
    monkeypatch.setattr(one_machine, "PER_WIDTH", 3 * one_machine.PER_WIDTH)
    monkeypatch.setattr(one_machine, "LEAST", 3 * one_machine.LEAST)
    finer = vi.design(MACHINE, BAND, **CHOICE)
    assert len(finer.response) > 2.5 * len(found.response)
    assert finer.machine == found.machine
    assert finer.peak == pytest.approx(found.peak, rel=0.03)


def test_without_a_choice_clearances_up_to_the_amplitude_are_tried():
    rows = vi.design(MACHINE, (7.8, 8.1), restitutions=[0.5]).candidates
    tried = [row["clearance_m"] for row in rows]
    assert len(tried) == 16
    best = min(rows, key=lambda row: row["peak_m"])["clearance_m"]
    assert min(tried) < best < max(tried)
    assert sorted(tried)[-1] / sorted(tried)[0] == pytest.approx(32)


@pytest.mark.parametrize(
    ("machine", "band", "choice", "told"),
    [
        (MACHINE, (8.0, 7.0), {}, "band"),
        (MACHINE, (0.0, 7.0), {}, "band"),
        (replace(MACHINE, c1=0.0), BAND, {}, "machine"),
        (replace(MACHINE, k12=1.0), BAND, {}, "machine"),
        (MACHINE, BAND, {"clearances": [0.0]}, "clearances"),
        (MACHINE, BAND, {"restitutions": [1.0]}, "restitutions"),
        (MACHINE.dimensionless(), BAND, {}, "machine"),
    ],
)
def test_refusals_name_the_argument(machine, band, choice, told):
    with pytest.raises(ValueError, match=f"^{told}: "):
        vi.design(machine, band, **choice)


def test_the_command_prints_the_answer_and_writes_table_and_picture(found, tmp_path, capsys):
    table, picture = tmp_path / "machine.csv", tmp_path / "machine.png"
    assert main([*WORDS, "--output", str(table), "--plot", str(picture)]) == 0
    assert capsys.readouterr().out == f"{found}\n"
    with open(table, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [{name: float(value) for name, value in row.items()} for row in rows] == found.response
    assert picture.stat().st_size > 10_000


@pytest.mark.parametrize("wrong", ["--k -1", "--m 0", "--restitution 2", "--from 9", "--clearance 0"])
def test_a_wrong_option_is_named(wrong, capsys):
    with pytest.raises(SystemExit) as end:
        main([*WORDS, *wrong.split()])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert wrong.split()[0].strip("-") in said
