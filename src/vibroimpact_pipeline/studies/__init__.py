"""Pipeline of the studies: config, claims and report."""
