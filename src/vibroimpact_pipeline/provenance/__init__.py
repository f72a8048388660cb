"""Where a figure comes from: the record that goes with it, and whether the tree would still make it so."""
