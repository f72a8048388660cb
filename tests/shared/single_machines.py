"""Single machines, and comparison of their responses with a module next to another machine."""

import numpy as np
import pytest

import vibroimpact as vi

MACHINE = vi.PhysicalSystem.single(M=1, m=0.05, k=1, c=0.02, F=0.05, L=1, kappa=0.65).dimensionless()
FIRST = vi.System(
    epsilon=0.1, kappa=0.65, alpha12_hat=0, gamma12_hat=0, gamma1_hat=0.3, gamma2_hat=0.7, sigma20_hat=-0.5,
    sigma_e_hat=0.1, f10_hat=1.4, f20_hat=0,
)  # fmt: skip
SECOND = FIRST.with_(gamma2_hat=0.3, sigma20_hat=0.4, sigma_e_hat=0, f10_hat=0, f20_hat=1.2)
"""FIRST and SECOND also have asymmetric responses; in FIRST only module 1 is active, in SECOND only module 2."""
MACHINES = pytest.mark.parametrize("machine", [MACHINE, FIRST, SECOND], ids=["machine", "first", "second"])


def company(machine):
    """Return the machine next to a second forced machine, without coupling between the machines."""
    (module,) = machine.modules
    return machine.with_(**{f"f{3 - module}0_hat": 1.7})


def places(responses, module, names):
    """Return the distinct numbers of a module in several responses, sorted, shape (n, d)."""
    numbers = [np.concatenate([np.ravel(getattr(one, name)[module - 1]) for name in names]) for one in responses]
    return np.unique(np.round(numbers, 9), axis=0)


def same_numbers(alone, together, module, names):
    """Check that the module has the same numbers in both lists, and the other module NaN in the list `alone`."""
    np.testing.assert_allclose(places(alone, module, names), places(together, module, names), rtol=0, atol=2e-9)
    assert np.isnan(places(alone, 3 - module, names)).all()


def holds(many, few):
    """Return True if `many` contains all complex numbers in `few`, including multiplicities."""
    left = list(many)
    for value in few:
        nearest = int(np.argmin(np.abs(np.array(left) - value)))
        if abs(left.pop(nearest) - value) > 1e-7 * (1 + abs(value)):
            return False
    return True


def partner(one, others, module, names=("C",)):
    """Return the response in `others` that is closest to `one` in a module."""
    return min(others, key=lambda o: sum(np.abs(getattr(o, n) - getattr(one, n))[module - 1].max() for n in names))
