"""Parts that several figures of the studies share."""
