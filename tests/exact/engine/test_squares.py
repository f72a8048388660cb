"""Integrals of the squares of the boxes' positions along a flight, against quadrature of the matrix exponential."""

import numpy as np
import pytest
from numba import njit
from scipy.integrate import quad_vec
from scipy.linalg import expm

from vibroimpact.exact.engine.flow import CONTACT_STATES, flow_of, jet, node
from vibroimpact.exact.engine.squares import (
    POSITIONS,
    integrals_of,
    potential,
    squares_along,
    squares_before,
    squares_of,
)
from vibroimpact.system.matrices import rate_matrix

CHANGES = {
    "chapter": {},
    "undamped": dict(gamma1_hat=0, gamma2_hat=0, gamma12_hat=0),
    "hardly damped": dict(gamma1_hat=1e-7, gamma2_hat=3e-7, gamma12_hat=0),
    "twins, uncoupled": dict(alpha12_hat=0, gamma12_hat=0, gamma1_hat=0, gamma2_hat=0, sigma20_hat=0),
    "heavy balls": dict(epsilon=1.0),
    "stiff": dict(alpha12_hat=1e3),
    "unforced": dict(f10_hat=0, f20_hat=0),
}


@njit
def by_forms(flow, forms, mode, z, t):
    boxes, j = (z[0], z[1], z[2], z[3]), int(t * flow.density + 0.5)
    one, two = squares_before(forms, mode, j, boxes, z[4], z[5])
    there, sine, cosine = node(flow, mode, boxes, z[4], z[5], j)
    jets, rest = jet(flow.coefficients, mode, there, sine, cosine), t - j * flow.spacing
    return one + squares_along(jets[0], rest), two + squares_along(jets[1], rest)


@njit
def at(squares, mode, z):
    return potential(squares, mode, (z[0], z[1], z[2], z[3]), z[4], z[5])


def test_potentials_serve_where_there_is_damping(chapter):
    without = {name for name, changes in CHANGES.items() if squares_of(chapter(**changes)).forms.size}
    assert without == {"undamped", "hardly damped", "twins, uncoupled", "stiff"}


@pytest.mark.parametrize("changes", CHANGES.values(), ids=CHANGES)
@pytest.mark.parametrize("mode", range(4))
def test_the_integral_is_that_of_quadrature(chapter, changes, mode):
    system = chapter(**changes)
    rate, rng = rate_matrix(system, CONTACT_STATES[mode]), np.random.default_rng(mode)
    for t in (1e-3, 0.02, 1.234, 3.0):
        z = np.concatenate([rng.normal(size=4), [np.sin(0.3), np.cos(0.3)]])
        exact = quad_vec(lambda x, z=z: (expm(rate * x) @ z)[:2] ** 2, 0.0, t, epsabs=1e-15, epsrel=1e-13)[0]
        np.testing.assert_allclose(
            by_forms(flow_of(system), integrals_of(system, POSITIONS), mode, z, t), exact, rtol=2e-13
        )
        if not squares_of(system).forms.size:
            end, drift = expm(rate * t) @ z, squares_of(system).drifts[mode]
            by_potential = np.subtract(at(squares_of(system), mode, end), at(squares_of(system), mode, z)) + drift * t
            np.testing.assert_allclose(by_potential, exact, rtol=1e-11, atol=1e-12)
