"""Fixtures of the tests of regimes: systems with the parameters of the chapter, and settings of the observation."""

import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.studies.regimes.settling import Observation


def make(f10_hat=1.0, f20_hat=1.0, **changes):
    return vi.System(**{**PARAMETERS, **changes}, f10_hat=f10_hat, f20_hat=f20_hat)


@pytest.fixture(scope="session")
def chapter():
    """Return a function that returns the system of the chapter with other forces and parameters."""
    return make


@pytest.fixture(scope="session")
def observation():
    """Return the settings of the default build."""
    return Observation(cycles=250, rounds=3, window=24, nearness=0.02, blocks=6, block=20, retest=10000)
