"""Colour and marker of each integrator, the same in every figure that compares them."""

from itertools import cycle

# Okabe and Ito's palette, told apart by colour-blind readers too; the markers tell the same without colour.
_COLOURS = "#000000", "#D55E00", "#56B4E9", "#0072B2", "#009E73", "#CC79A7", "#E69F00", "#8C6D31", "#7F7F7F"
_MARKERS = "*", "D", "o", "s", "^", "v", "P", "X", "h"


def looks(methods) -> dict[str, dict]:
    """Colour and marker for names of methods, by their order (unique names, first appearance)."""
    names = list(dict.fromkeys(methods))
    return {
        name: {"color": colour, "marker": marker}
        for name, colour, marker in zip(names, cycle(_COLOURS), cycle(_MARKERS), strict=False)
    }
