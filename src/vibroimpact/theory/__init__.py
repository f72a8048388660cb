"""Analytical theory of the chapter: saw-tooth, slow invariant manifold, slow flow, fixed points."""
