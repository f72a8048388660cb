"""Code shared by the figures: style, drawing, files, and the motions and fixed points that notebooks show."""
