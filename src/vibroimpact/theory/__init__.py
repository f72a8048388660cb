"""The chapter's analytical approach: saw-tooth, slow invariant manifold, slow flow, fixed points."""
