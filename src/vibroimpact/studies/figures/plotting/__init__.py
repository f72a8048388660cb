"""Drawing functions that several figures of the studies share."""
