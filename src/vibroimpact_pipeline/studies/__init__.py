"""The pipeline of the studies: their config, claims and report."""
