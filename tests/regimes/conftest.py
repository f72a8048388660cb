"""The chapter's system under given forcing."""

import pytest

import vibroimpact as vi
from chapter import PARAMETERS


def make(f10_hat=1.0, f20_hat=1.0, **changes):
    return vi.System(**{**PARAMETERS, **changes}, f10_hat=f10_hat, f20_hat=f20_hat)


@pytest.fixture(scope="session")
def chapter():
    return make
