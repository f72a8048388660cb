"""Print largest displacements of two coupled 10 kg machines: without absorbers, with linear absorbers, with balls."""

import numpy as np

import vibroimpact as vi
from vibroimpact.studies.absorbers.references import compared

FREQUENCIES = 2 * np.pi * np.linspace(2.9, 3.5, 61)  # angular frequencies [rad/s]


def machines(L, omega=FREQUENCIES[0]):
    return vi.PhysicalSystem(
        M=10.0, m=0.5, L=L, kappa=0.65,  # masses [kg], clearance [m]
        k1=4000.0, k2=4100.0, k12=100.0, c1=4.0, c2=4.0, c12=2.0,  # stiffness [N/m], damping [N s/m]
        F10=2.0, F20=2.0, omega1=omega, omega2=omega,  # forces [N], frequencies [rad/s]
    )  # fmt: skip


plant = machines(L=0.01)
system, band = plant.dimensionless(), (FREQUENCIES[0] / plant.omega10, FREQUENCIES[-1] / plant.omega10)
for name, linear in compared(system, band).items():
    print(f"{name}: up to {1000 * plant.L * linear.peak(band):.2f} mm")
for L in (0.002, 0.005, 0.015, 0.05):
    outcomes = vi.ensemble([machines(L, omega).dimensionless() for omega in FREQUENCIES], np.zeros(8), 200, settle=150)
    print(f"L = {1000 * L:.0f} mm: up to {1000 * L * outcomes['largest'].max():.1f} mm")
