"""All fixed points of the slow flow: the search, the balance of harmonics and its real zeros."""
