"""Balls as absorbers: linear systems for comparison, tuned absorbers and free decay."""
