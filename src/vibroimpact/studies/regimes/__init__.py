"""Regimes of the motion: recognition, continuation, basins, measures of modulation."""
