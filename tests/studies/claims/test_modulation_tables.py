"""Measures of regimes and Lyapunov spectra as the pipeline tables them: uncertainties, and sums that agree."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.studies.claims.modulation_tables import modulation_tables

OBSERVATION = {"cycles": 200, "rounds": 2, "window": 24, "nearness": 0.02, "blocks": 6, "block": 20, "retest": 1000}
SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}


@pytest.fixture(scope="module")
def tables():
    return modulation_tables(
        SYSTEMS, starts=3, seed=2, cycles=200, blocks=20, block=10, windows=[100, 200], observation=OBSERVATION
    )


def test_spectra_say_the_same_as_the_measures_and_add_up(tables):
    """The largest exponent, the eight of the periodic case against what damping and impacts say, its dimension 0."""
    spectra, measures = tables["spectra"], tables["measures"]
    key = ["case", "start", "regime"]
    values = spectra.pivot(index=key, columns="quantity", values="mean")
    largest = measures[measures["quantity"] == "largest Lyapunov exponent"].set_index(key)["mean"]
    assert values["exponent 1"].sort_index().equals(largest.sort_index().rename("exponent 1"))
    np.testing.assert_allclose(values["sum of exponents"], values["contraction"], atol=1e-6)
    eight = values.loc["equal"].filter(like="exponent ").sum(axis=1)
    np.testing.assert_allclose(eight, values.loc["equal"]["contraction"], atol=1e-9)
    assert (values.loc["equal"]["Kaplan-Yorke dimension"] == 0).all()
    assert 5 < values.loc["weak", "spread"]["Kaplan-Yorke dimension"].item() < 6.5


def test_measures_have_uncertainties_over_starts(tables):
    measures = tables["measures"]
    assert set(measures["case"]) == set(FORCES)
    windows = tables["windows"]
    assert set(windows["cycles"]) == {100, 200}
    assert set(windows["quantity"]) == {"amplitude variation", "depth from extremes"}
    spread = measures[(measures["start"] == "spread") & (measures["quantity"] != "burst length")]
    assert spread["uncertainty"].notna().all()
    rest = measures[measures["start"] == "rest"]
    assert set(rest["regime"][rest["case"] == "weak"]) == {"one ball idle"}
    assert rest["uncertainty"][rest["quantity"] == "largest Lyapunov exponent"].notna().all()
    shares = measures[measures["quantity"] == "share of starts"].groupby("case")["mean"].sum()
    np.testing.assert_allclose(shares, 1)
    exponents = measures[measures["quantity"] == "largest Lyapunov exponent"].set_index(["case", "start"])["mean"]
    assert exponents["equal", "spread"] < 0 < exponents["weak", "spread"]
