"""The figure check: compare tables and pictures with the reference set."""
