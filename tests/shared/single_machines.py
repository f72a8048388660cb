"""Single machines, and how their responses are compared with those of a module in company."""

import numpy as np
import pytest

import vibroimpact as vi

MACHINE = vi.PhysicalSystem.single(M=1, m=0.05, k=1, c=0.02, F=0.05, L=1, kappa=0.65).dimensionless()
FIRST = vi.System(
    epsilon=0.1, kappa=0.65, alpha12_hat=0, gamma12_hat=0, gamma1_hat=0.3, gamma2_hat=0.7, sigma20_hat=-0.5,
    sigma_e_hat=0.1, f10_hat=1.4, f20_hat=0,
)  # fmt: skip
SECOND = FIRST.with_(gamma2_hat=0.3, sigma20_hat=0.4, sigma_e_hat=0, f10_hat=0, f20_hat=1.2)
"""FIRST and SECOND have asymmetric responses too; the module that takes no part is another one."""
MACHINES = pytest.mark.parametrize("machine", [MACHINE, FIRST, SECOND], ids=["machine", "first", "second"])


def company(machine):
    """The machine beside another one that is driven, too, and that it does not feel."""
    (module,) = machine.modules
    return machine.with_(**{f"f{3 - module}0_hat": 1.7})


def places(responses, module, names):
    """Distinct numbers (n, d) of a module in some responses, sorted."""
    numbers = [np.concatenate([np.ravel(getattr(one, name)[module - 1]) for name in names]) for one in responses]
    return np.unique(np.round(numbers, 9), axis=0)


def same_numbers(alone, together, module, names):
    """The numbers of the module are the same in both lists; those of the other module are NaN in the first."""
    np.testing.assert_allclose(places(alone, module, names), places(together, module, names), rtol=0, atol=2e-9)
    assert np.isnan(places(alone, 3 - module, names)).all()


def holds(many, few):
    """True if each of few complex numbers is among the many, as often."""
    left = list(many)
    for value in few:
        nearest = int(np.argmin(np.abs(np.array(left) - value)))
        if abs(left.pop(nearest) - value) > 1e-7 * (1 + abs(value)):
            return False
    return True


def partner(one, others, module, names=("C",)):
    """The response among others that is the same one in a module."""
    return min(others, key=lambda o: sum(np.abs(getattr(o, n) - getattr(one, n))[module - 1].max() for n in names))
