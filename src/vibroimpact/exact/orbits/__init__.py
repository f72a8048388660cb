"""Find all exact 1:1 orbits, with two impacts per cycle and module, and their Floquet multipliers."""
