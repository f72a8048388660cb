"""Exact system: event-driven simulation with closed-form flights, and periodic orbits."""
