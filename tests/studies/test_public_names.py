"""Branches, sweeps and designs through their public names."""

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


def test_an_empty_table_of_branches_has_all_columns():
    """With strong damping, no motion has two impacts per cycle."""
    damped = SYSTEM.with_(gamma1_hat=100.0, gamma2_hat=100.0)
    found, nothing = (vi.branches(one, "kappa", (0.6, 0.7), of="theory", seeds=1) for one in (SYSTEM, damped))
    assert len(found) > 0 == len(nothing)
    for empty in (nothing, pickle.loads(pickle.dumps(nothing))):
        assert vi.to_frame(empty).columns.tolist() == vi.to_frame(found).columns.tolist()


def test_a_dataset_of_a_sweep_has_the_values_at_its_parameters(tmp_path):
    """The dataset is saved as NetCDF and read again."""
    xarray = pytest.importorskip("xarray")
    axes = {"f10_hat": [0.8, 1.0], "f20_hat": [0.5, 0.7, 0.9]}
    vi.to_dataset(vi.sweep(SYSTEM, axes, ["fixed_points"]), list(axes)).to_netcdf(tmp_path / "sweep.nc", engine="scipy")
    with xarray.open_dataset(tmp_path / "sweep.nc", engine="scipy") as data:
        expected = [[len(vi.fixed_points(SYSTEM.with_(f10_hat=f10, f20_hat=f20))) for f20 in axes["f20_hat"]]
                    for f10 in axes["f10_hat"]]  # fmt: skip
        assert data["fixed_points"].transpose(*axes).values.tolist() == expected
        assert data["fixed_points"].units == data["f10_hat"].units == "1"


def test_a_missing_extra_for_pictures_is_reported_in_one_line(monkeypatch, capsys):
    monkeypatch.setattr("vibroimpact.system.extras.find_spec", lambda name: None)
    with pytest.raises(SystemExit) as end:
        main(DESIGN.split())
    assert end.value.code == 2
    printed = capsys.readouterr().err
    assert "needs matplotlib and pandas: pip install" in printed
    assert printed.count("\n") == 1


@pytest.mark.thorough
def test_no_function_is_compiled_late():
    """Functions that CALLS need are compiled in advance with runs and ensembles."""
    assert compiled_late(CALLS) == []
