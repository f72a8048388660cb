"""A user's script that calls the public names and passes a strict type checker."""

import numpy as np

import vibroimpact as vi

system: vi.System = vi.System(
    epsilon=0.1, kappa=0.65, alpha12_hat=1.0, gamma1_hat=0.2, gamma2_hat=0.2, gamma12_hat=0.2,
    sigma20_hat=0.5, sigma_e_hat=0.2, f10_hat=1.0, f20_hat=0.89,
)  # fmt: skip
for point in vi.fixed_points(system):
    amplitude: float = float(point.C[0])
    print(point.label, amplitude, point.stability.theory)
run: vi.Run = vi.simulate(system, np.zeros(8), 20, sample_times=np.linspace(0.0, 10.0, 11))
impacts = run.events[run.events["kind"] == vi.IMPACT]
print(len(impacts), run.final.shape, run.certificate.decided)
runs = vi.simulate_many(system, np.zeros((2, 8)), 5)
print([one.cycles for one in runs])
outcomes = vi.ensemble([system, system.with_(f20_hat=1.0)], np.zeros(8), 30, settle=10)
print(outcomes["largest"].max())
stable = [orbit for orbit in vi.orbits(system) if orbit.admissible and orbit.stable]
for orbit in stable:
    print(orbit.symmetric, orbit.impact_phases[0, 0], abs(orbit.multipliers[0]), vi.prove(orbit).stability)
frame = vi.to_frame(stable)
print(frame.columns)
