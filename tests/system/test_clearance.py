"""The clearance enters (10.2) through the forces alone, and only as F / L: one curve of performance for all of them."""

from dataclasses import replace

import numpy as np
import pytest

import vibroimpact as vi

PLANT = vi.PhysicalSystem(
    M=3.0, m=0.3, k1=48.0, k2=50.0, k12=4.0, c1=0.2, c2=0.3, c12=0.1, F10=1.5, F20=-0.9, omega1=4.1, omega2=4.1,
    L=0.25, kappa=0.65,
)  # fmt: skip
FORCES = ("f10_hat", "f20_hat")


@pytest.mark.parametrize("factor", [0.1, 3.0])
def test_a_clearance_is_a_force(factor):
    system, wider = PLANT.dimensionless(), replace(PLANT, L=factor * PLANT.L).dimensionless()
    for name in FORCES:
        assert getattr(wider, name) * factor == pytest.approx(getattr(system, name), rel=1e-14)
    assert wider.with_(**{name: getattr(system, name) for name in FORCES}) == system


def test_displacement_per_force_depends_on_clearance_per_force_alone():
    """The largest |x| / F over L / F, from metres and newtons and back; the curve is not flat."""
    curve = []
    for ratio in (0.03, 0.1, 0.3):  # L / F10
        points = []
        for force in (0.75, 1.5, 6.0):
            plant = replace(PLANT, F10=force, F20=-0.6 * force, L=ratio * force)
            outcome = vi.ensemble(plant.dimensionless(), np.zeros(8), 25)
            points.append(outcome["largest"] * plant.L / force)
        np.testing.assert_allclose(points, [points[0]] * 3, rtol=1e-9)
        curve.append(points[0][0])
    assert np.abs(np.diff(curve)).min() > 0.01 * max(curve)
