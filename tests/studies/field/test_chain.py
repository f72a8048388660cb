"""Two sectors of the chain of Weidemann et al. (2025): their program's numbers, as stored, against exact orbits."""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from pipeline_trees import ROOT
from vibroimpact.studies.field import MATRIX, OF_THE_PROGRAM, responses, two_sectors

THEIRS = pd.read_csv(Path(__file__).with_name("chain_program.csv"), comment="#")
PAGE = (ROOT / "docs/studies/field.md").read_text(encoding="utf-8")
LOST = {0.9885: "1.37459", 0.99: "2.26855", 0.992: "3.61142"}
"""Frequencies at which the upper response is unstable, and the multiplier that is proved."""
ROWS = {r: responses(r) for r in THEIRS["r"].unique().tolist()}


def symmetric(r):
    """Exact symmetric responses in phase, the smaller first, as the program lists its own."""
    rows = [row for row in ROWS[r] if row["symmetric"]]
    assert all(row["theta1"] == pytest.approx(row["theta2"], rel=1e-9) for row in rows)
    return sorted(rows, key=lambda row: row["theta1"])


def asymmetric(r):
    return [row for row in ROWS[r] if not row["symmetric"] and row["stable"]]


@pytest.mark.parametrize("r", ROWS)
def test_harmonic_balance_is_near_the_exact_amplitudes(r):
    theirs = THEIRS[THEIRS["r"] == r]
    assert [row["theta1"] for row in symmetric(r)] == pytest.approx(theirs["theta"].tolist(), rel=0.011)


def test_all_verdicts_agree_but_those_on_the_upper_response_beyond_the_loss_of_symmetry():
    differ = [
        (row.r, row.theta)
        for r in ROWS
        for row, exact in zip(THEIRS[THEIRS["r"] == r].itertuples(), symmetric(r), strict=True)
        if bool(row.stable) != exact["stable"]
    ]
    assert differ == [
        (r, pytest.approx(theta, abs=1e-4)) for r, theta in ((0.9885, 1.6783), (0.99, 1.7594), (0.992, 1.8917))
    ]
    for r in ROWS:
        assert len(asymmetric(r)) == (4 if r in LOST else 0)
        assert sum(row["proved"] for row in asymmetric(r)) == (2 if r in LOST else 0)


def test_in_phase_one_sector_alone_is_unstable_by_finite_differences_of_the_engine():
    """Apart from saltation matrices and proofs: how fast a small lean grows in one period, with no coupling."""
    row = symmetric(0.99)[-1]
    system = two_sectors(0.99).with_(alpha12_hat=0.0, gamma12_hat=0.0)
    state, one = np.array(row["state"]), [0, 1, 4, 5]
    steps = 1e-6 * np.eye(8)[one]
    ends = [[vi.simulate(system, state + sign * step, 1).final[one] for sign in (1, -1)] for step in steps]
    monodromy = np.array([(plus - minus) / 2e-6 for plus, minus in ends]).T
    assert abs(np.linalg.eigvals(monodromy)).max() == pytest.approx(2.26855, rel=1e-4)


def test_their_time_stepping_ends_on_the_stable_exact_orbit():
    """From their own start: on the symmetric orbit where that is stable, else on an asymmetric one."""
    upper = THEIRS[THEIRS["stable"] == 1].set_index("r")
    for r in (r for r in ROWS if r not in LOST):
        assert upper["theta_simulated"][r] == pytest.approx(symmetric(r)[-1]["theta1"], rel=3e-3)
        assert abs(upper["leans"][r]) < 1e-4
    for r in LOST:
        end = asymmetric(r)[0]
        assert upper["theta_simulated"][r] == pytest.approx(end["theta1"], rel=7e-3)
        assert abs(upper["leans"][r]) == pytest.approx(abs(end["lean"]), rel=0.05)
        # So their test of practical stability, 1.99 impacts and a spread of 5 %, is passed by another response.
        assert upper["impacts_per_period"][r] >= 1.99
        assert upper["spread"][r] <= 0.05


def test_the_engine_leaves_the_unstable_response_for_an_asymmetric_one():
    """Apart from orbits and multipliers: a run from the exact unstable state, pushed by a millionth."""
    lost, system = symmetric(0.99)[-1], two_sectors(0.99)
    run = vi.simulate(system, np.array(lost["state"]) * (1 + 1e-6), 1500)
    last = run.events[(run.events["tau"] > 1400 * system.period) & (run.events["module"] == 1)]
    speeds = last["state"][:, 5]
    right, left = speeds[speeds > 0].mean(), -speeds[speeds < 0].mean()
    assert abs((right - left) / (right + left)) == pytest.approx(abs(asymmetric(0.99)[0]["lean"]), rel=0.01)


@pytest.mark.parametrize(("r", "least"), [(0.98, 0.00154), (0.985, 0.00193)])
def test_unequal_sectors_need_a_weak_coupling_and_are_unstable(r, least):
    def unequal(kappa_c):
        found = [one for one in vi.orbits(two_sectors(r, kappa_c=kappa_c)) if one.admissible]
        assert max(found, key=lambda one: one.C.sum()).stable  # in phase
        return [one for one in found if abs(one.C[0] - one.C[1]) > 1e-3]

    assert not any(one.stable for kappa_c in (1e-5, least - 5e-6) for one in unequal(kappa_c))
    assert [len(unequal(kappa_c)) for kappa_c in (1e-5, least - 5e-6, least + 5e-6)] == [2, 2, 0]
    assert f"{least:.5f}" in PAGE


def test_the_page_says_the_same():
    cells = [
        line.strip("| ").split(" | ") for line in PAGE.splitlines() if line.startswith("| 0.9") and "stable" in line
    ]
    said = [[float(cell.strip("*")) for cell in (row[0], row[1], row[3], row[4])] for row in cells]
    expected = [
        [row.r, row.theta, exact["theta1"], exact["multiplier"]]
        for r in ROWS
        for row, exact in zip(THEIRS[THEIRS["r"] == r].itertuples(), symmetric(r), strict=True)
    ]
    np.testing.assert_allclose(said, expected, atol=6e-4)
    other = max(row["multiplier"] for row in responses(0.99, MATRIX) if row["symmetric"])
    assert f"{other:.3f} with the first" in PAGE
    assert all(row["proved"] for r in ROWS for row in symmetric(r))
    for r, multiplier in LOST.items():
        assert symmetric(r)[-1]["enclosures"][0].startswith(f"[{multiplier}")
        assert multiplier in PAGE


def watched(row):
    """A cycle of an exact response, sampled, as its own run."""
    system = vi.System(**row["system"])
    return vi.simulate(system, row["state"], 1, sample_times=np.linspace(0, system.period, 4001))


def test_how_unequal_the_speeds_are_that_the_page_tells():
    """From impacts of a run of the engine: the difference of the speeds of a ball to either side over their sum."""
    said = re.search(r"differ by (\d+), (\d+) and (\d+) % of their sum", " ".join(PAGE.split())).groups()
    for r, percent in zip(LOST, said, strict=True):
        impacts = watched(asymmetric(r)[0]).events
        speeds = impacts[impacts["module"] == 1]["state"][:, 5]
        assert len(speeds) == 2
        assert abs(speeds.sum()) / abs(speeds).sum() == pytest.approx(float(percent) / 100, abs=0.005)
        program = THEIRS.set_index(["r", "stable"])["leans"][r, 1]
        assert abs(program) == pytest.approx(float(percent) / 100, abs=0.0055)


def test_how_far_the_sector_moves():
    """Half of peak to peak, as the program measures it, over the clearance."""
    table = PAGE[PAGE.index("| $r$ | harmonic balance |") :].split("\n\n")[0].splitlines()[2:]
    said = [[float(cell) for cell in row.strip("| ").split(" | ")] for row in table]
    assert [row[0] for row in said] == list(LOST)
    for r, balance, lost, stable in said:
        assert THEIRS.set_index(["r", "stable"])["xi"][r, 1] == pytest.approx(balance, abs=5.1e-4)
        for expected, rows in ((lost, symmetric(r)[-1:]), (stable, asymmetric(r))):
            # The four asymmetric ones are two pairs that differ in the third decimal.
            found = [np.ptp(watched(row).samples[:, 0]) / 2 for row in rows]
            assert found == pytest.approx([expected] * len(rows), abs=1.1e-3)


def test_the_figure_has_the_same_numbers():
    assert np.array(OF_THE_PROGRAM) == pytest.approx(
        THEIRS[["r", "theta", "stable", "theta_simulated", "leans"]], abs=1e-6
    )


@pytest.mark.parametrize("r", [0.98, 0.99])
def test_the_system_is_theirs_in_other_units(r):
    """Their equations with balls fixed and forces of 1: the amplitude over the clearance."""
    system = two_sectors(r)
    fixed = 1 / (1 - r**2 + 2j * 1e-3 * r) / (0.3 / (2 * 1e-3))
    stiff = 1 - (1 + system.epsilon) * system.Omega**2 + 1j * system.gamma1 * system.Omega
    assert system.forcing[0] / stiff == pytest.approx(fixed, rel=1e-12)
