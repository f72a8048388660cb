"""Colour and marker of each integrator, the same in every figure that compares them."""

from itertools import cycle

# The palettes of Okabe and Ito and of Tol are told apart by colour-blind readers, too; the markers say the same.
_OKABE_ITO = "#000000", "#D55E00", "#56B4E9", "#0072B2", "#009E73", "#CC79A7", "#E69F00"
_TOL = "#8C6D31", "#882255", "#999933", "#44AA99", "#332288", "#AA4499", "#7F7F7F"
_COLOURS = *_OKABE_ITO, *_TOL
_MARKERS = "*", "D", "o", "s", "^", "v", "P", "X", "<", ">", "d", "p", "H", "8", "h"


def looks(methods) -> dict[str, dict]:
    """Colour and marker for names of methods, by their order (unique names, first appearance)."""
    names = list(dict.fromkeys(methods))
    return {
        name: {"color": colour, "marker": marker}
        for name, colour, marker in zip(names, cycle(_COLOURS), cycle(_MARKERS), strict=False)
    }
