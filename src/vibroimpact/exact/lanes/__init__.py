"""Simulate eight runs at once in the lanes of vector instructions; `ensemble.ensemble` is the entry point."""
