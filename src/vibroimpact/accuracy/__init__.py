"""Compute reference solutions, and measure the error and the cost of each method."""
