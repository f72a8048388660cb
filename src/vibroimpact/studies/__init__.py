"""Studies of a system in one call: continuation, sweeps, attractors, sections, exponents, linear absorbers."""
