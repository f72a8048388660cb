"""Exact 1:1 orbits, two impacts per cycle and module: all of them, with their Floquet multipliers."""
