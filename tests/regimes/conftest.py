"""The chapter's system under given forcing."""

import pytest

import vibroimpact as vi

CHAPTER = dict(
    epsilon=0.1,
    kappa=0.65,
    alpha12_hat=1.0,
    gamma1_hat=0.2,
    gamma2_hat=0.2,
    gamma12_hat=0.2,
    sigma20_hat=0.5,
    sigma_e_hat=0.2,
)


def make(f10_hat=1.0, f20_hat=1.0, **changes):
    return vi.System(**{**CHAPTER, **changes}, f10_hat=f10_hat, f20_hat=f20_hat)


@pytest.fixture(scope="session")
def chapter():
    return make
