"""Slow variables measured in a constructed leading-order response are those from which it is constructed."""

from types import SimpleNamespace

import numpy as np
import pytest

from chapter import system_of
from vibroimpact.exact.measures.slow_variables import amplitude_and_lag, measure

SYSTEM = system_of("equal")
B, PSI, C = np.array([0.3, 0.7]), np.array([2.5, -1.2]), np.array([1.2, 1.6])
AT_PLUS = np.array([0.3, 0.97])  # phase of the impact with the wall +1


def constructed_motion():
    """Return times, displacements and impacts for U_i = B_i sin(Omega tau - psi_i) and Y_i = -Z_i / (1 + epsilon).

    Z_i is a triangle wave of amplitude C_i.
    """
    tau = 500 * SYSTEM.period + np.arange(4 * 60) / 60 * SYSTEM.period
    U = B * np.sin(SYSTEM.Omega * tau[:, None] - PSI)
    turns = np.abs((tau[:, None] / SYSTEM.period - AT_PLUS + 0.5) % 1.0 - 0.5)
    Y = -C * (1 - 4 * turns) / (1 + SYSTEM.epsilon)
    X = U - SYSTEM.epsilon * Y
    displacements = np.stack([X[:, 0], Y[:, 0], X[:, 1], Y[:, 1]], axis=1)
    rows = [(m, w, n) for n in range(500, 504) for m in (1, 2) for w in (1, -1)]
    module, wall, cycle = np.array(rows).T
    ball = -wall * C[module - 1] / (1 + SYSTEM.epsilon)
    impacts = {
        "module": module,
        "wall": wall,
        "tau": (cycle + AT_PLUS[module - 1] + (wall < 0) * 0.5) * SYSTEM.period,
        "Y1": np.where(module == 1, ball, 99.0),
        "Y2": np.where(module == 2, ball, 99.0),
    }
    return tau, displacements, impacts


def test_slow_variables_and_impact_phases_are_recovered():
    found = measure(SYSTEM, *constructed_motion())
    np.testing.assert_allclose(found.B, B, rtol=1e-12)
    np.testing.assert_allclose(found.psi, PSI, rtol=1e-10)
    np.testing.assert_allclose(found.C, C, rtol=1e-12)
    np.testing.assert_allclose(found.impact_phases, [[0.3, 0.8], [0.97, 0.47]], atol=1e-12)


def test_the_distance_between_phasors_does_not_depend_on_full_turns():
    found = measure(SYSTEM, *constructed_motion())
    assert found.distance(SimpleNamespace(B=B, psi=PSI + 2 * np.pi)) == pytest.approx(0, abs=1e-10)
    assert found.distance(SimpleNamespace(B=B + np.array([0.03, 0.04]), psi=PSI)) == pytest.approx(0.05, rel=1e-9)
    assert found.distance(SimpleNamespace(B=B, psi=PSI + np.array([0, np.pi]))) == pytest.approx(1.4, rel=1e-9)


def test_a_ball_that_misses_a_wall_is_refused():
    tau, displacements, impacts = constructed_motion()
    keep = (impacts["module"] == 1) | (impacts["wall"] == 1)
    with pytest.raises(ValueError, match="module 2 has no impact at the wall -1"):
        measure(SYSTEM, tau, displacements, {name: values[keep] for name, values in impacts.items()})


def test_higher_harmonics_and_offsets_do_not_affect_the_first_harmonic():
    tau = np.arange(120) / 40 * SYSTEM.period
    phase = SYSTEM.Omega * tau
    wave = 0.5 * np.sin(phase - 0.7) + 0.2 * np.cos(3 * phase) + 0.1 * np.sin(2 * phase) + 0.3
    amplitude, lag = amplitude_and_lag(tau, wave[:, None], SYSTEM.Omega)
    np.testing.assert_allclose([amplitude[0], lag[0]], [0.5, 0.7], rtol=1e-12)


def test_phases_are_averaged_on_the_circle():
    cycles = [[-0.02, 1.02, 0.99, -5.99], [-0.25, -0.25, 1.75, 0.75], [0.4, 2.5, 0.4, 3.5], [0.5, 2.5, -1.5, 7.5]]
    tau, displacements = np.arange(40) / 40 * SYSTEM.period, np.zeros((40, 4))
    impacts = {
        "tau": np.ravel(cycles) * SYSTEM.period, "Y1": np.zeros(16), "Y2": np.zeros(16),
        "module": np.repeat([1, 2], 8), "wall": np.tile(np.repeat([1, -1], 4), 2),
    }  # fmt: skip
    (first, second), other = measure(SYSTEM, tau, displacements, impacts).impact_phases
    assert min(first, 1 - first) == pytest.approx(0, abs=1e-12)
    np.testing.assert_allclose([second, *other], [0.75, 0.45, 0.5], rtol=1e-12)
