"""Prove that no fixed point and no symmetric orbit is missing."""
