"""Select the eight methods that the accuracy charts show (the tables contain more), and draw their curves."""

from vibroimpact.figures.plotting.style import BLACK

LOOKS = {
    "this engine": (BLACK, "*", 6.5),
    "modal scan": ("0.45", "h", 4.5),
    "heyoka": ("#0072B2", "s", 3.6),
    "RK4, compiled": ("#D55E00", "D", 3.2),
    "DOP853": ("#A87900", "o", 3.6),
    "Moreau-Jean": ("#00805C", "^", 3.8),
    "penalty": ("#882255", "v", 3.8),
    "Ivanov, events": ("#B0568A", "P", 4.2),
}
"""Colour, marker and marker size of each method in the charts; all colours are dark enough for text on white."""
DASHES = {
    "modal scan": (0, (5, 1, 1, 1, 1, 1)),
    "RK4, compiled": "--",
    "DOP853": "-.",
    "penalty": (0, (6, 2)),
    "Ivanov, events": (0, (2, 1)),
}
"""Line styles of the methods whose lines are not solid, to separate them in grey print."""
HOLLOW = "hollow: missed or spurious impacts"


def mark(method: str) -> dict:
    """Return the style of the markers of a method."""
    color, marker, size = LOOKS[method]
    return {"color": color, "marker": marker, "markersize": size, "markeredgewidth": 0.7, "linestyle": "none"}


def draw_method(axes, method: str, x, y, wrong) -> list:
    """Draw the curve of a method, with hollow markers where `wrong` is True, and return its lines."""
    width = 1.6 if method == "this engine" else 0.8
    return [
        *axes.plot(x, y, **mark(method) | {"linestyle": DASHES.get(method, "-"), "linewidth": width}),
        *axes.plot(x[wrong], y[wrong], **mark(method), markerfacecolor="white"),
    ]
