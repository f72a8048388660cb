"""Find all fixed points of the slow flow: search, balance of harmonics, and its real zeros."""
