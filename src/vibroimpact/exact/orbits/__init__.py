"""Find exact 1:1 orbits, with two impacts per forcing cycle and module, and compute their Floquet multipliers."""
