"""Branches, sweeps and absorbers by their public names."""

import pickle

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from compiled_code import compiled_late
from vibroimpact.cli.parser import main

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=0.89)
DESIGN = "design --M 120 --m 6 --k 3e5 --c 120 --F 40 --from 7 --to 9 --plot design.png"
CALLS = """
vi.sections(system, start, 2, progress=False)
vi.largest_lyapunov(system, start, 20, 2, blocks=2)
vi.lyapunov_spectrum(system, start, 20, 2)
vi.decay_time(system, 1.0)
"""


def test_branches_pass_the_fixed_points_of_any_value():
    frame = vi.to_frame(vi.branches(SYSTEM, "f20_hat", (0.85, 0.95), of="theory"))
    for point in vi.fixed_points(SYSTEM):
        near = np.abs(frame[["p", "C1", "C2"]] - [0.89, *point.C]).max(axis=1).min()
        assert near < 0.05  # half a step of 0.01 in the parameter, along curves of slope up to 5
    for arguments, name in (
        (("f20", (0.8, 0.9)), "f20"), (("f20_hat", 0.9), "between"), (("f20_hat", (0.9, 0.8)), "between"),
        (("kappa", (0.5, 1.5)), "between"), (("kappa", (0.5, 0.6), "all"), "of"),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=rf"^{name}:"):
            vi.branches(SYSTEM, *arguments)


RANGES = (0.5, 1.0), (0.6, 0.7)


@pytest.mark.parametrize(
    "call",
    [
        lambda system: vi.branches(system, "kappa", RANGES[1], of="theory", seeds=1, progress=False),
        lambda system: vi.bifurcation_curves(system, ("f10_hat", "kappa"), RANGES, seeds=1, progress=False),
    ],
    ids=["branches", "curves"],
)
def test_a_table_of_nothing_has_the_columns_of_what_could_be_in_it(call):
    """So much damping leaves no motion with two impacts per cycle."""
    found, nothing = call(SYSTEM), call(SYSTEM.with_(gamma1_hat=100.0, gamma2_hat=100.0))
    assert len(found) > 0 == len(nothing)
    for empty in (nothing, pickle.loads(pickle.dumps(nothing))):
        frame = vi.to_frame(empty)
        assert frame.columns.tolist() == vi.to_frame(found).columns.tolist()
        assert frame.empty


def test_a_sweep_counts_the_fixed_points_of_every_system():
    rows = vi.sweep(SYSTEM, {"f10_hat": [0.5, 1.0], "f20_hat": [0.5, 0.89]}, ["fixed_points"])
    for row in rows:
        system = SYSTEM.with_(f10_hat=row["f10_hat"], f20_hat=row["f20_hat"])
        assert row["fixed_points"] == len(vi.fixed_points(system))
    assert vi.to_frame(rows)["fixed_points"].tolist() == [row["fixed_points"] for row in rows]
    for axes, observe, name in (({"mass": [1]}, ["orbits"], "mass"), ({"kappa": [0.5]}, ["points"], "observe")):
        with pytest.raises(ValueError, match=rf"^{name}:"):
            vi.sweep(SYSTEM, axes, observe)


def test_absorbers_by_their_public_names():
    band = (0.7, 1.4)
    best, book = vi.best_tuning(SYSTEM, band), vi.textbook_tuning(SYSTEM)
    assert vi.tuned(SYSTEM, best).peak(band) < vi.tuned(SYSTEM, book).peak(band)
    with pytest.raises(ValueError, match=r"^band: 1.0 is not a pair of numbers$"):
        vi.best_tuning(SYSTEM, 1.0)


def test_a_system_in_newtons_is_told_how_to_lose_its_units():
    plant = vi.PhysicalSystem.from_dimensionless(SYSTEM, M=120.0, k1=2e5, L=0.005)
    with pytest.raises(ValueError, match=r"^system: a PhysicalSystem is not a System; call \.dimensionless\(\)$"):
        vi.textbook_tuning(plant)


def test_a_sweep_as_a_dataset_over_its_grid(tmp_path):
    """Saved as NetCDF and read again: each value stands where its parameters say."""
    xarray = pytest.importorskip("xarray")
    axes = {"f10_hat": [0.8, 1.0], "f20_hat": [0.5, 0.7, 0.9]}
    rows = vi.sweep(SYSTEM, axes, ["fixed_points"])
    vi.to_dataset(rows, list(axes)).to_netcdf(tmp_path / "sweep.nc", engine="scipy")
    with xarray.open_dataset(tmp_path / "sweep.nc", engine="scipy") as data:
        assert data.sizes == {"f10_hat": 2, "f20_hat": 3}
        for row in rows:
            there = data.sel(f10_hat=row["f10_hat"], f20_hat=row["f20_hat"])
            assert int(there["fixed_points"]) == row["fixed_points"]
            assert (
                len(vi.fixed_points(SYSTEM.with_(f10_hat=row["f10_hat"], f20_hat=row["f20_hat"])))
                == row["fixed_points"]
            )
        assert data["fixed_points"].units == data["f10_hat"].units == "1"


def test_a_picture_of_a_design_without_its_extra_says_so(monkeypatch, capsys):
    monkeypatch.setattr("vibroimpact.system.extras.find_spec", lambda name: None)
    with pytest.raises(SystemExit) as end:
        main(
            [
                "design",
                "--M",
                "120",
                "--m",
                "6",
                "--k",
                "3e5",
                "--c",
                "120",
                "--F",
                "40",
                "--from",
                "7",
                "--to",
                "9",
                "--plot",
                "design.png",
            ]
        )
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert "needs matplotlib and pandas: pip install" in said
    assert said.count("\n") == 1


def test_no_function_is_compiled_late():
    """All that these need is compiled beforehand with runs and ensembles."""
    assert compiled_late(CALLS) == []
