"""The design of a ball for one machine: against closed forms, the momentum of the ball, its energy, and finer grids."""

import csv
import os
import re
import subprocess
import sys
from dataclasses import replace

import matplotlib
import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.cli.parser import main
from vibroimpact.studies import one_machine

MACHINE = vi.PhysicalSystem.single(M=120.0, m=6.0, k=3e5, c=240.0, F=40.0)
BAND = (7.4, 8.4)
NARROW = replace(MACHINE, c1=120.0), (7.6, 8.2)
CHOICE = {"clearances": [0.001, 0.002], "restitutions": [0.4]}
OPTIONS = "design --M 120 --m 6 --k 3e5 --c 240 --F 40 --from 7.4 --to 8.4 --clearance 0.001 0.002 --restitution 0.4"


@pytest.fixture(scope="module", autouse=True)
def briefly():
    """Watched for less time than a user's machine, for all that these tests compare."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(one_machine, "LONG", 120)
        patch.setattr(one_machine, "WINDOW", 60)
        yield


@pytest.fixture(scope="module")
def found():
    return vi.design(MACHINE, BAND, **CHOICE)


def test_without_ball_the_peak_is_that_of_an_oscillator(found):
    ratio = 240.0 / (2 * np.sqrt(120.0 * 3e5))
    assert found.without == pytest.approx(40.0 / 3e5 / (2 * ratio * np.sqrt(1 - ratio**2)), rel=1e-9)


@pytest.mark.parametrize("drive", [{"base": 1e-4}, {"unbalance": 0.02}])
def test_a_moving_base_and_an_unbalance_have_their_closed_form_without_ball_and_with_an_absorber(drive):
    """Transmissibility of a base; u omega^2 of an unbalance; a mass on spring and damper in place of the ball."""
    machine = vi.PhysicalSystem.single(M=120.0, m=6.0, k=3e5, c=240.0, omega=1.0, **drive)
    found = vi.design(machine, BAND, **CHOICE)

    def amplitude(omega, mass):
        force = 1e-4 * abs(3e5 + 240j * omega) if "base" in drive else 0.02 * omega**2
        return force / abs(3e5 - mass * omega**2 + 240j * omega)

    omegas = 2 * np.pi * np.array([row["frequency_Hz"] for row in found.response])
    assert [row["without_m"] for row in found.response] == pytest.approx(amplitude(omegas, 120.0), rel=1e-9)
    fine = 2 * np.pi * np.linspace(*BAND, 200_001)
    assert found.without == pytest.approx(amplitude(fine, 120.0).max(), rel=1e-8)
    assert found.machine == replace(machine, L=found.machine.L, kappa=0.4)
    absorber = max(row["absorber_m"] for row in found.response)
    assert absorber <= found.absorber * (1 + 1e-9) < found.without
    omega = 2 * np.pi * found.response[-1]["frequency_Hz"]
    at_end = vi.PhysicalSystem.single(M=120.0, m=6.0, k=3e5, c=240.0, omega=omega, L=1.0, **drive).dimensionless()
    assert at_end.forcing[0] * 3e5 == pytest.approx(amplitude(omega, 0.0) * abs(3e5 + 240j * omega), rel=1e-12)


def test_the_machine_is_told_by_its_natural_frequency_and_static_deflection(found):
    assert str(found).splitlines()[0] == "natural frequency 7.958 Hz, static deflection 0.133 mm"


def test_text_and_table_are_of_one_grid_and_window(found):
    assert [(row["clearance_m"], row["restitution"]) for row in found.candidates] == [(0.001, 0.4), (0.002, 0.4)]
    assert (found.machine.L, found.machine.kappa) == (0.002, 0.4)
    assert found.peak == max(row["with_m"] for row in found.response)
    assert f"\n  {1000 * max(row['settling_m'] for row in found.response):.3g} mm while it settles" in str(found)
    assert found.absorber < found.peak < found.without
    assert max(row["without_m"] for row in found.response) == pytest.approx(found.without, rel=0.02)


@pytest.fixture(scope="module")
def many():
    """Over the resonance, from clearances of its own."""
    return vi.design(*NARROW, restitutions=[0.15, 0.3])


def test_the_best_few_are_measured_again_and_the_best_of_those_is_chosen(many):
    """By their neighbourhood: each of them alone gets the numbers that it has in the list."""
    again = [row for row in many.candidates if np.isfinite(row["near_m"])]
    assert len(again) == 3
    assert max(row["peak_m"] for row in again) <= min(row["peak_m"] for row in many.candidates if row not in again)
    lowest = min(again, key=lambda row: row["near_m"])
    chosen = lowest["clearance_m"], lowest["restitution"], lowest["near_m"]
    assert chosen == (many.machine.L, many.machine.kappa, many.near[1])
    other = next(row for row in again if row is not lowest)
    alone = vi.design(*NARROW, [other["clearance_m"]], [other["restitution"]])
    assert alone.near[1] == other["near_m"]
    beside = [vi.design(*NARROW, [f * many.machine.L], [many.machine.kappa]) for f in (0.98, 1.02)]
    peaks = [one.peak for one in (many, *beside)]
    assert many.near == pytest.approx((min(peaks), max(peaks)), rel=1e-9)


def test_the_printed_clearance_gives_what_was_printed(many):
    said = re.search(r"^clearance (\S+) mm to each side, restitution (\S+)$", str(many), re.M).groups()
    assert len(said[0].replace(".", "").lstrip("0")) <= 3
    machine = replace(NARROW[0], L=0.3, kappa=0.9)
    again = vi.design(machine, NARROW[1], [float(f"{said[0]}e-3")], [float(said[1])])
    assert (again.peak, again.near, again.response) == (many.peak, many.near, many.response)


def test_a_machine_and_its_mirror_image_have_the_same_answer_to_the_digit(found):
    mirrored = vi.design(replace(MACHINE, F10=-40.0), BAND, **CHOICE)
    assert str(mirrored) == str(found)
    np.testing.assert_equal(mirrored.candidates, found.candidates)
    assert mirrored.response == found.response
    assert mirrored.machine == replace(found.machine, F10=-40.0)


def test_displacement_and_impacts_are_those_of_one_motion_in_one_window(found):
    """Where it is periodic, against runs from each start, sampled: the largest of them, and its impacts."""
    waited, watched = found.window
    row = found.response[20]
    omega = 2 * np.pi * row["frequency_Hz"]
    system = replace(found.machine, omega1=omega, omega2=omega).dimensionless()
    runs, spans = [], (0, waited * system.period, (waited + watched) * system.period)
    states = vi.starts(one_machine.MORE_STARTS, 2)
    states[:, [2, 3, 6, 7]] = 0.0
    for state in states:
        times = np.linspace(0, spans[2], 200 * (waited + watched) + 1)
        run = vi.simulate(system, state, waited + watched, sample_times=times)
        boxes = found.machine.L * np.abs(run.samples[:, 0])
        impacts = run.events[(run.events["kind"] == vi.IMPACT) & (run.events["tau"] > spans[1])]
        early = times <= spans[1]
        runs.append((boxes[~early].max(), boxes[early].max(), len(impacts) / watched * row["frequency_Hz"]))
    largest, _, impacts = max(runs)
    assert impacts > 10
    assert row["with_m"] == pytest.approx(largest, rel=1e-3)
    assert row["impacts_per_s"] == pytest.approx(impacts, rel=2e-3)
    assert row["later_m"] == pytest.approx(largest, rel=1e-3)
    assert row["settling_m"] == pytest.approx(runs[0][1], rel=1e-3)


def test_a_transient_is_told_as_one(found, monkeypatch):
    """Watched too early: what is seen there is not what remains."""
    monkeypatch.setattr(one_machine, "SETTLED", 0.1)
    monkeypatch.setattr(one_machine, "LONG", 3)
    early = vi.design(MACHINE, (7.8, 7.9), **CHOICE)
    worst = max(early.response, key=lambda row: row["with_m"])
    assert early.peak > 1.1 * worst["later_m"]
    (line,) = (line for line in str(early).splitlines() if "had not settled" in line)
    assert f"at most {1000 * worst['later_m']:.3g} mm in the 1000 periods that follow" in line
    assert "had not settled" not in str(found)


def test_what_to_know_before_it_is_built_is_told(found):
    softest = [*found.candidates, found.candidates[0] | {"restitution": 0.5}]
    told = {
        "The clearance is the largest of those tried": {},
        "The restitution is the smallest of those tried": {"candidates": softest},
        "Fragile: with clearances within 2% of it the peak is up to 20%": {"near": (found.peak, 1.2 * found.peak)},
    }
    for words, changes in told.items():
        said = [words in str(replace(found, **others)) for others in told.values()]
        assert said == [not changes or others is changes for others in told.values()]


def run_at(hertz, L=0.002, kappa=0.4):
    """A machine driven at a frequency, and its run after a transient."""
    omega = 2 * np.pi * hertz
    machine = replace(MACHINE, L=L, kappa=kappa, omega1=omega, omega2=omega)
    system = machine.dimensionless()
    return machine, vi.simulate(system, vi.simulate(system, np.zeros(8), 200).final, 60)


def test_impulses_are_changes_of_momentum_and_speeds_account_for_the_energy_that_impacts_take():
    machine, run = run_at(7.9)
    told, unit = one_machine._impacts(machine, run), machine.L * machine.omega10
    states = run.events["state"][(run.events["module"] == 1) & (run.events["kind"] == vi.IMPACT)]
    assert len(states) == len(run.events) > 100
    # Between its impacts the ball is free, so the velocity before an impact is that after the one before.
    momentum = machine.m * unit * states[:, 5]
    assert told["impulse_Ns"] == pytest.approx(np.abs(np.diff(momentum)).mean(), rel=0.02)
    assert told["impacts_per_s"] == pytest.approx(len(states) / (60 / 7.9))
    before = unit * np.abs(states[:, 4] - states[:, 5]) / machine.kappa
    reduced, joule = machine.M * machine.m / (machine.M + machine.m), machine.k1 * machine.L**2
    lost = 0.5 * reduced * (1 - machine.kappa**2) * (before**2).sum()
    assert lost == pytest.approx(joule * np.sum(run.energy.impacts), rel=1e-9)
    assert told["impact_speed_m_s"] == pytest.approx(before.mean())


def test_finer_frequencies_change_neither_the_choice_nor_its_peak(found, monkeypatch):
    monkeypatch.setattr(one_machine, "PER_WIDTH", 3 * one_machine.PER_WIDTH)
    monkeypatch.setattr(one_machine, "LEAST", 3 * one_machine.LEAST)
    finer = vi.design(MACHINE, BAND, **CHOICE)
    assert len(finer.response) > 2.5 * len(found.response)
    assert finer.machine == found.machine
    assert finer.peak == pytest.approx(found.peak, rel=0.03)


def test_without_a_choice_clearances_up_to_the_amplitude_are_tried(many):
    """Rounded to three digits, from a quarter of F / k M / m on; others beside the best at its restitution."""
    first = [row["clearance_m"] for row in many.candidates[:8]]
    assert len(many.candidates) == 2 * 8 + 2 * 3
    np.testing.assert_allclose(first, np.geomspace(40 / 3e5 * 20 / 4, many.without, 8), rtol=5e-3)
    assert all(float(f"{row['clearance_m']:.3g}") == row["clearance_m"] for row in many.candidates)
    assert first[0] < many.machine.L < first[-1]


@pytest.mark.parametrize(
    ("told", "machine", "choice"),
    [
        ("band", MACHINE, {"band": (8.0, 7.0)}), ("band", MACHINE, {"band": (0.0, 7.0)}),
        ("machine", replace(MACHINE, c1=0.0), {}), ("machine", replace(MACHINE, k12=1.0), {}),
        ("machine", MACHINE.dimensionless(), {}), ("clearances", MACHINE, {"clearances": [0.0]}),
        ("restitutions", MACHINE, {"restitutions": [1.0]}),
    ],
)  # fmt: skip
def test_refusals_name_the_argument(told, machine, choice):
    with pytest.raises(ValueError, match=f"^{told}: "):
        vi.design(machine, **{"band": BAND} | choice)


def test_the_command_prints_the_answer_and_writes_table_and_picture(found, tmp_path, capsys):
    table, picture = tmp_path / "machine.csv", tmp_path / "machine.png"
    with matplotlib.rc_context({"text.usetex": True}):  # a setting of the user that does not reach the picture
        assert main([*OPTIONS.split(), "--output", str(table), "--plot", str(picture)]) == 0
    assert capsys.readouterr().out == f"{found}\n"
    with open(table, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [{name: float(value) for name, value in row.items()} for row in rows] == found.response
    assert picture.stat().st_size > 10_000


@pytest.mark.thorough
def test_a_backend_that_is_not_installed_does_not_cost_the_picture(tmp_path):
    """As a notebook sets it for every process that it starts."""
    command = [sys.executable, "-m", "vibroimpact", *OPTIONS.split(), "--plot", "design.pdf"]
    subprocess.run(command, env=os.environ | {"MPLBACKEND": "none"}, cwd=tmp_path, check=True)
    assert (tmp_path / "design.pdf").read_bytes().startswith(b"%PDF")


def test_a_picture_that_cannot_be_saved_does_not_cost_the_answer(found, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(vi, "design", lambda *given, **more: found)
    table = tmp_path / "machine.csv"
    monkeypatch.setattr(one_machine.Design, "plot", lambda self: 1 / 0)
    with pytest.raises(SystemExit) as end:
        main([*OPTIONS.split(), "--output", str(table), "--plot", str(tmp_path / "machine.png")])
    printed = capsys.readouterr()
    assert (end.value.code, printed.out) == (1, f"{found}\n")
    assert re.fullmatch(r"vibroimpact design: plot: .*machine.png cannot be saved: division by zero\n", printed.err)
    assert len(table.read_text().splitlines()) == 1 + len(found.response)


def test_the_picture_has_the_displacements_of_the_table(found):
    axes = found.plot().axes[0]
    lines = {line.get_label(): np.asarray(line.get_data()) for line in axes.get_lines()}
    assert len(lines) == 4
    for name, label in (("with_m", "with the ball, settled"), ("without_m", "without ball")):
        drawn = [[row["frequency_Hz"], 1000 * row[name]] for row in found.response]
        np.testing.assert_array_equal(lines[label].T, drawn)
