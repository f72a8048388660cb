"""Test the tables of regime measures and Lyapunov spectra."""

from itertools import product

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.studies.claims.modulation_tables import modulation_tables

OBSERVATION = {"cycles": 200, "rounds": 2, "window": 24, "nearness": 0.02, "blocks": 6, "block": 20, "retest": 1000}
SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}


@pytest.fixture(scope="module")
def tables():
    """Return the tables of all cases, from short runs."""
    return modulation_tables(
        SYSTEMS, starts=3, seed=2, cycles=200, blocks=20, block=10, windows=[100, 200], observation=OBSERVATION
    )


def test_spectra_contain_the_largest_exponent_and_add_up_to_the_contraction(tables):
    """The contraction follows from damping and impacts. The attractor of the periodic case has dimension 0."""
    spectra, measures = tables["spectra"], tables["measures"]
    key = ["case", "start", "regime"]
    values = spectra.pivot(index=key, columns="quantity", values="mean")
    largest = measures[measures["quantity"] == "largest Lyapunov exponent"].set_index(key)["mean"]
    assert values["exponent 1"].sort_index().equals(largest.sort_index().rename("exponent 1"))
    np.testing.assert_allclose(values["sum of exponents"], values["contraction"], atol=1e-6)
    exponents = values.loc["equal"].filter(like="exponent ")
    np.testing.assert_allclose(exponents.sum(axis=1), values.loc["equal"]["contraction"], atol=1e-9)
    assert (values.loc["equal"]["Kaplan-Yorke dimension"] == 0).all()
    assert 5 < values.loc["weak", "spread"]["Kaplan-Yorke dimension"].item() < 6.5


def test_windows_of_each_length_are_measured(tables):
    windows = tables["windows"][["cycles", "quantity"]].drop_duplicates().itertuples(index=False, name=None)
    assert set(windows) == set(product((100, 200), ("amplitude variation", "depth from extremes")))


def test_measures_of_all_cases_have_means_and_uncertainties(tables):
    measures = tables["measures"]
    assert set(measures["case"]) == set(FORCES)
    spread = measures[(measures["start"] == "spread") & (measures["quantity"] != "burst length")]
    assert spread["uncertainty"].notna().all()
    rest = measures[measures["start"] == "rest"]
    assert set(rest["regime"][rest["case"] == "weak"]) == {"one ball idle"}
    assert rest["uncertainty"][rest["quantity"] == "largest Lyapunov exponent"].notna().all()
    shares = measures[measures["quantity"] == "share of starts"].groupby("case")["mean"].sum()
    np.testing.assert_allclose(shares, 1)
    exponents = measures[measures["quantity"] == "largest Lyapunov exponent"].set_index(["case", "start"])["mean"]
    assert exponents["equal", "spread"] < 0 < exponents["weak", "spread"]
