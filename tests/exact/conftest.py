"""Systems of the chapter."""

import pytest

from chapter import FORCES, system_of


@pytest.fixture
def chapter():
    """Return a function of two forces and other changes that returns the chapter's system with them."""
    return lambda f10_hat=1.0, f20_hat=1.0, **changes: system_of("equal", f10_hat=f10_hat, f20_hat=f20_hat, **changes)


@pytest.fixture(params=FORCES)
def case(request):
    """Return the system of each case of the chapter in turn."""
    return system_of(request.param)
