"""What the system does: recognising regimes, continuation, maps, measures of modulation."""
