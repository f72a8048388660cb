"""Prove that the lists of fixed points and of symmetric orbits are complete."""
