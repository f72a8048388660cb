"""The chapter's system under given forcing, and how motions are looked at in these tests."""

import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.studies.regimes.settling import Observation


def make(f10_hat=1.0, f20_hat=1.0, **changes):
    return vi.System(**{**PARAMETERS, **changes}, f10_hat=f10_hat, f20_hat=f20_hat)


@pytest.fixture(scope="session")
def chapter():
    return make


@pytest.fixture(scope="session")
def observation():
    """That of the default build."""
    return Observation(cycles=250, rounds=3, window=24, nearness=0.02, blocks=6, block=20, retest=10000)
