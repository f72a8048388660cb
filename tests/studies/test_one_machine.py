"""The design of a ball for one machine agrees with closed forms, momentum, energy and finer grids."""

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
    """Shorten the runs of all designs in this module."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(one_machine, "LONG", 120)
        patch.setattr(one_machine, "WINDOW", 60)
        yield


@pytest.fixture(scope="module")
def found():
    """Return the design for BAND and CHOICE."""
    return vi.design(MACHINE, BAND, **CHOICE)


def test_the_peak_without_ball_is_that_of_an_oscillator(found):
    ratio = 240.0 / (2 * np.sqrt(120.0 * 3e5))
    assert found.without == pytest.approx(40.0 / 3e5 / (2 * ratio * np.sqrt(1 - ratio**2)), rel=1e-9)


@pytest.mark.parametrize("drive", [{"base": 1e-4}, {"unbalance": 0.02}])
def test_responses_to_base_motion_and_unbalance_agree_with_closed_forms(drive):
    """The force is that of the moving base on spring and damper, or u omega^2 of an unbalance."""
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


def test_the_text_starts_with_natural_frequency_and_static_deflection(found):
    assert str(found).splitlines()[0] == "natural frequency 7.958 Hz, static deflection 0.133 mm"


def test_text_and_table_have_the_same_peaks(found):
    assert [(row["clearance_m"], row["restitution"]) for row in found.candidates] == [(0.001, 0.4), (0.002, 0.4)]
    assert (found.machine.L, found.machine.kappa) == (0.002, 0.4)
    assert found.peak == max(row["with_m"] for row in found.response)
    assert f"\n  {1000 * max(row['settling_m'] for row in found.response):.3g} mm while it settles" in str(found)
    assert found.absorber < found.peak < found.without
    assert max(row["without_m"] for row in found.response) == pytest.approx(found.without, rel=0.02)


@pytest.fixture(scope="module")
def many():
    """Return the design for a band around the resonance, with default clearances."""
    return vi.design(*NARROW, restitutions=[0.15, 0.3])


def test_the_best_candidates_are_measured_again_and_the_best_of_them_is_chosen(many):
    """The second measurement includes nearby clearances; a design with a single candidate gives the same numbers."""
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


def test_the_printed_clearance_and_restitution_give_the_same_design(many):
    printed = re.search(r"^clearance (\S+) mm to each side, restitution (\S+)$", str(many), re.M).groups()
    assert len(printed[0].replace(".", "").lstrip("0")) <= 3
    machine = replace(NARROW[0], L=0.3, kappa=0.9)
    again = vi.design(machine, NARROW[1], [float(f"{printed[0]}e-3")], [float(printed[1])])
    assert (again.peak, again.near, again.response) == (many.peak, many.near, many.response)


def test_a_machine_and_its_mirror_image_have_identical_designs(found):
    mirrored = vi.design(replace(MACHINE, F10=-40.0), BAND, **CHOICE)
    assert str(mirrored) == str(found)
    np.testing.assert_equal(mirrored.candidates, found.candidates)
    assert mirrored.response == found.response
    assert mirrored.machine == replace(found.machine, F10=-40.0)


def test_displacement_and_impacts_are_those_of_one_motion_in_one_window(found):
    """At a frequency with a periodic motion, sampled runs from all starts give the largest motion and its impacts."""
    settle, cycles = found.window
    row = found.response[20]
    omega = 2 * np.pi * row["frequency_Hz"]
    system = replace(found.machine, omega1=omega, omega2=omega).dimensionless()
    runs, spans = [], (0, settle * system.period, (settle + cycles) * system.period)
    states = vi.starts(one_machine.MORE_STARTS, 2)
    states[:, [2, 3, 6, 7]] = 0.0
    for state in states:
        times = np.linspace(0, spans[2], 200 * (settle + cycles) + 1)
        run = vi.simulate(system, state, settle + cycles, sample_times=times)
        boxes = found.machine.L * np.abs(run.samples[:, 0])
        impacts = run.events[(run.events["kind"] == vi.IMPACT) & (run.events["tau"] > spans[1])]
        early = times <= spans[1]
        runs.append((boxes[~early].max(), boxes[early].max(), len(impacts) / cycles * row["frequency_Hz"]))
    largest, _, impacts = max(runs)
    assert impacts > 10
    assert row["with_m"] == pytest.approx(largest, rel=1e-3)
    assert row["impacts_per_s"] == pytest.approx(impacts, rel=2e-3)
    assert row["later_m"] == pytest.approx(largest, rel=1e-3)
    assert row["settling_m"] == pytest.approx(runs[0][1], rel=1e-3)


def test_an_unsettled_response_is_reported(found, monkeypatch):
    """The observed cycles are too early, so that later displacements are smaller."""
    monkeypatch.setattr(one_machine, "SETTLED", 0.1)
    monkeypatch.setattr(one_machine, "LONG", 3)
    early = vi.design(MACHINE, (7.8, 7.9), **CHOICE)
    worst = max(early.response, key=lambda row: row["with_m"])
    assert early.peak > 1.1 * worst["later_m"]
    (line,) = (line for line in str(early).splitlines() if "had not settled" in line)
    assert f"at most {1000 * worst['later_m']:.3g} mm in the 1000 periods that follow" in line
    assert "had not settled" not in str(found)


def test_each_warning_is_printed_only_if_it_applies(found):
    softest = [*found.candidates, found.candidates[0] | {"restitution": 0.5}]
    warnings = {
        "The clearance is the largest of those tried": {},
        "The restitution is the smallest of those tried": {"candidates": softest},
        "Fragile: with clearances within 2% of it the peak is up to 20%": {"near": (found.peak, 1.2 * found.peak)},
    }
    for words, changes in warnings.items():
        printed = [words in str(replace(found, **others)) for others in warnings.values()]
        assert printed == [not changes or others is changes for others in warnings.values()]


def run_at(hertz, L=0.002, kappa=0.4):
    """Return a machine driven at a frequency, and its run after a transient."""
    omega = 2 * np.pi * hertz
    machine = replace(MACHINE, L=L, kappa=kappa, omega1=omega, omega2=omega)
    system = machine.dimensionless()
    return machine, vi.simulate(system, vi.simulate(system, np.zeros(8), 200).final, 60)


def test_impulses_are_changes_of_momentum_and_impact_speeds_give_the_dissipated_energy():
    machine, run = run_at(7.9)
    row, unit = one_machine._impacts(machine, run), machine.L * machine.omega10
    states = run.events["state"][(run.events["module"] == 1) & (run.events["kind"] == vi.IMPACT)]
    assert len(states) == len(run.events) > 100
    # The ball is free between impacts, so its velocity before an impact is that after the previous impact.
    momentum = machine.m * unit * states[:, 5]
    assert row["impulse_Ns"] == pytest.approx(np.abs(np.diff(momentum)).mean(), rel=0.02)
    assert row["impacts_per_s"] == pytest.approx(len(states) / (60 / 7.9))
    before = unit * np.abs(states[:, 4] - states[:, 5]) / machine.kappa
    reduced, joule = machine.M * machine.m / (machine.M + machine.m), machine.k1 * machine.L**2
    lost = 0.5 * reduced * (1 - machine.kappa**2) * (before**2).sum()
    assert lost == pytest.approx(joule * np.sum(run.energy.impacts), rel=1e-9)
    assert row["impact_speed_m_s"] == pytest.approx(before.mean())


def test_finer_frequencies_change_neither_the_choice_nor_its_peak(found, monkeypatch):
    monkeypatch.setattr(one_machine, "PER_WIDTH", 3 * one_machine.PER_WIDTH)
    monkeypatch.setattr(one_machine, "LEAST", 3 * one_machine.LEAST)
    finer = vi.design(MACHINE, BAND, **CHOICE)
    assert len(finer.response) > 2.5 * len(found.response)
    assert finer.machine == found.machine
    assert finer.peak == pytest.approx(found.peak, rel=0.03)


def test_default_clearances_extend_to_the_amplitude_without_ball(many):
    """Eight clearances with three digits start at a quarter of F / k M / m. Others are near the best of these eight."""
    first = [row["clearance_m"] for row in many.candidates[:8]]
    assert len(many.candidates) == 2 * 8 + 2 * 3
    np.testing.assert_allclose(first, np.geomspace(40 / 3e5 * 20 / 4, many.without, 8), rtol=5e-3)
    assert all(float(f"{row['clearance_m']:.3g}") == row["clearance_m"] for row in many.candidates)
    assert first[0] < many.machine.L < first[-1]


@pytest.mark.parametrize(
    ("argument", "machine", "choice"),
    [
        ("band", MACHINE, {"band": (8.0, 7.0)}), ("band", MACHINE, {"band": (0.0, 7.0)}),
        ("machine", replace(MACHINE, c1=0.0), {}), ("machine", replace(MACHINE, k12=1.0), {}),
        ("machine", MACHINE.dimensionless(), {}), ("clearances", MACHINE, {"clearances": [0.0]}),
        ("restitutions", MACHINE, {"restitutions": [1.0]}),
    ],
)  # fmt: skip
def test_errors_name_the_argument(argument, machine, choice):
    with pytest.raises(ValueError, match=f"^{argument}: "):
        vi.design(machine, **{"band": BAND} | choice)


def test_the_command_prints_the_design_and_writes_table_and_picture(found, tmp_path, capsys):
    table, picture = tmp_path / "machine.csv", tmp_path / "machine.png"
    with matplotlib.rc_context({"text.usetex": True}):  # a user's setting that must not affect the picture
        assert main([*OPTIONS.split(), "--output", str(table), "--plot", str(picture)]) == 0
    assert capsys.readouterr().out == f"{found}\n"
    with open(table, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [{name: float(value) for name, value in row.items()} for row in rows] == found.response
    assert picture.stat().st_size > 10_000


@pytest.mark.thorough
def test_the_picture_is_saved_although_the_backend_is_not_installed(tmp_path):
    """A notebook sets MPLBACKEND for every process that it starts."""
    command = [sys.executable, "-m", "vibroimpact", *OPTIONS.split(), "--plot", "design.pdf"]
    subprocess.run(command, env=os.environ | {"MPLBACKEND": "none"}, cwd=tmp_path, check=True)
    assert (tmp_path / "design.pdf").read_bytes().startswith(b"%PDF")


def test_the_design_is_printed_although_the_picture_cannot_be_saved(found, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(vi, "design", lambda *arguments, **options: found)
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
