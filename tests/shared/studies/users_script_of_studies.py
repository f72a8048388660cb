"""A user's script that calls the public names of the studies and passes a strict type checker."""

import vibroimpact as vi
from vibroimpact.system.chapter import CASES, PARAMETERS

system: vi.System = vi.System(**PARAMETERS, **CASES["unequal"])
rows: list[dict[str, object]] = vi.sweep(system, {"f20_hat": [0.5, 0.9]}, ["fixed_points"])
print(vi.to_dataset(rows, ["f20_hat"]))
machine = vi.PhysicalSystem.single(M=120.0, m=6.0, k=3e5, c=240.0, F=40.0)
found: vi.Design = vi.design(machine, (7.9, 8.0), clearances=[0.002], restitutions=[0.5])
print(found.peak, found.machine.L, machine.dimensionless().epsilon)
