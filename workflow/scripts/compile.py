"""Compile the engine into the cache of the checkout, so that the first build does not have to."""

from pathlib import Path

from environment import settle
from vibroimpact.checks.sources import Sources

settle(Path.cwd(), Sources())

from vibroimpact.exact.simulation import simulate  # noqa: E402  (Numba reads the environment when it is imported)
from vibroimpact.system import System  # noqa: E402

system = System(
    epsilon=0.1,
    kappa=0.65,
    alpha12_hat=1.0,
    gamma1_hat=0.2,
    gamma2_hat=0.2,
    gamma12_hat=0.2,
    sigma20_hat=0.5,
    sigma_e_hat=0.2,
    f10_hat=1.0,
    f20_hat=1.0,
)
simulate(system, [0.0] * 8, cycles=1, sample_times=[0.0])
