"""Parts of pages that are read offline: formulas, and what a browser may load."""
