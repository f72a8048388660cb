"""All fixed points of the slow flow: the search, its proof, and what is read off the points."""
