"""Balls as absorbers: peaks in a band of frequencies, and linear systems for comparison."""
