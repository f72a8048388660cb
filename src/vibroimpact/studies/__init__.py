"""Studies of a system in one call: continuation, sweeps, attractors, sections, exponents, design of a ball."""
