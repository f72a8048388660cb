"""Motions that every method is measured on, with their references."""

from functools import cache

import pytest

from vibroimpact.accuracy.reference import proven_run
from vibroimpact.rivals import METHODS
from vibroimpact.system import System

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
EQUAL = System(**CHAPTER, f10_hat=1.0, f20_hat=1.0)
WEAK = System(**CHAPTER, f10_hat=0.5, f20_hat=0.5)
MOTIONS = {
    "periodic": (EQUAL, (-0.0863, 0.3689, -0.4889, -0.7167, -0.1597, -0.6893, -0.3681, -1.2869), 3),
    "chatter": (WEAK, (-0.8, -1.799, 0.1, 0.1, 0.0, -0.01, 0.0, 0.0), 1),
}


@cache
def reference(name):
    system, state, cycles = MOTIONS[name]
    return proven_run(system, state, cycles).run


@pytest.fixture
def motion():
    """By name: (system, start, cycles, reference run)."""
    return lambda name: (*MOTIONS[name], reference(name))


@pytest.fixture
def method():
    """By name: an installed method."""

    def find(name):
        found = next(method for method in METHODS if method.name == name)
        if found.available():
            pytest.skip(found.available())
        return found

    return find
