"""Branches, sweeps and absorbers by their public names."""

import pickle

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
"""


def test_a_table_of_nothing_has_the_columns_of_what_could_be_in_it():
    """So much damping leaves no motion with two impacts per cycle."""
    damped = SYSTEM.with_(gamma1_hat=100.0, gamma2_hat=100.0)
    found, nothing = (vi.branches(one, "kappa", (0.6, 0.7), of="theory", seeds=1) for one in (SYSTEM, damped))
    assert len(found) > 0 == len(nothing)
    for empty in (nothing, pickle.loads(pickle.dumps(nothing))):
        assert vi.to_frame(empty).columns.tolist() == vi.to_frame(found).columns.tolist()


def test_a_sweep_as_a_dataset_over_its_grid(tmp_path):
    """Saved as NetCDF and read again: each value stands where its parameters say."""
    xarray = pytest.importorskip("xarray")
    axes = {"f10_hat": [0.8, 1.0], "f20_hat": [0.5, 0.7, 0.9]}
    vi.to_dataset(vi.sweep(SYSTEM, axes, ["fixed_points"]), list(axes)).to_netcdf(tmp_path / "sweep.nc", engine="scipy")
    with xarray.open_dataset(tmp_path / "sweep.nc", engine="scipy") as data:
        expected = [[len(vi.fixed_points(SYSTEM.with_(f10_hat=f10, f20_hat=f20))) for f20 in axes["f20_hat"]]
                    for f10 in axes["f10_hat"]]  # fmt: skip
        assert data["fixed_points"].transpose(*axes).values.tolist() == expected
        assert data["fixed_points"].units == data["f10_hat"].units == "1"


def test_a_picture_of_a_design_without_its_extra_says_so(monkeypatch, capsys):
    monkeypatch.setattr("vibroimpact.system.extras.find_spec", lambda name: None)
    with pytest.raises(SystemExit) as end:
        main(DESIGN.split())
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert "needs matplotlib and pandas: pip install" in said
    assert said.count("\n") == 1


@pytest.mark.thorough
def test_no_function_is_compiled_late():
    """All that these need is compiled beforehand with runs and ensembles."""
    assert compiled_late(CALLS) == []
