"""Systems in which tests search for fixed points, each given by changes of the chapter's parameters."""

import numpy as np

from chapter import system_of

IDENTICAL = {"sigma20_hat": 0.0}
UNCOUPLED = {"alpha12_hat": 0.0, "gamma12_hat": 0.0}
UNDAMPED = {"gamma1_hat": 0.0, "gamma2_hat": 0.0, "gamma12_hat": 0.0}
FOLD = 0.6977803686883265  # f20_hat at which two fixed points of the chapter's system merge
NEARLY_ELASTIC = {
    "weak dampers": dict(
        kappa=1 - 3.3e-7, gamma1_hat=1.5e-9, gamma2_hat=8.7e-12, alpha12_hat=1.269, sigma20_hat=-1.186,
        sigma_e_hat=-0.475, f10_hat=1.502, f20_hat=-1.318,
    ),
    "weaker": dict(
        kappa=1 - 2.1e-12, gamma1_hat=3e-12, gamma2_hat=3.6e-12, alpha12_hat=0.888, sigma20_hat=0.305,
        sigma_e_hat=0.611, f10_hat=-1.397, f20_hat=-1.301,
    ),
    "no dampers": UNDAMPED | dict(kappa=1 - 1e-9),
}  # fmt: skip


def build(changes=None):
    return system_of("equal", **(changes or {}))


def single_module(e, force, kappa):
    """Return the real solutions C for one uncoupled module: B^2 |e + N|^2 = f^2, a quadratic equation in C."""
    rate = 8 / np.pi**2 - e * (1 + 2j * (1 - kappa) / (np.pi * (1 + kappa)))
    roots = np.roots([abs(rate) ** 2, 2 * (e * np.conj(rate)).real, abs(e) ** 2 - force**2])
    return np.sort(roots.real) if np.isreal(roots).all() else np.empty(0)
