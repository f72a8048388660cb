"""Systems of the chapter."""

import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS


@pytest.fixture
def chapter():
    """The chapter's system under given forcing."""

    def make(f10_hat=1.0, f20_hat=1.0, **changes):
        return vi.System(**{**PARAMETERS, **changes}, f10_hat=f10_hat, f20_hat=f20_hat)

    return make


@pytest.fixture(params=FORCES)
def case(request):
    """Each case of the chapter in turn."""
    f10_hat, f20_hat = FORCES[request.param]
    return vi.System(**PARAMETERS, f10_hat=f10_hat, f20_hat=f20_hat)
