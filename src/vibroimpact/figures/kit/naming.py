"""Names written at lines, where they are clear of every line of their axes."""

import numpy as np

GAP, CLEAR = 2.5, 6.0
"""In points: from a line to its name; a place is as good as any if other lines are so far from the name."""
WIDTH = 0.22
"""Half the width of a letter, on average, by the size of the lettering."""
INNER, PARTS = (0.2, 0.8), 100
"""Part of a curve where its name may stand; number of parts that curves are cut into."""


def name_lines(axes, named: dict, size: float = 8.5) -> None:
    """Write a name above or below one of its curves, in the middle of the axes rather than at their sides.

    Every line that was drawn before is kept clear of, as far as there is room.

    Args:
        named: name -> (colour, curves), each curve an array (n, 2) in data coordinates.
    """
    points, lines = 72.0 / axes.figure.dpi, [line for line in axes.lines if line.get_linestyle() != "None"]
    taken = [points * _fine(line.get_transform().transform(line.get_xydata())) for line in lines]
    for name, (colour, curves) in named.items():
        half = size * np.array([WIDTH * len(name), 0.5])
        own = np.concatenate([_fine(curve, *INNER) for curve in curves])
        shift = np.array([[0.0, half[1] + GAP], [0.0, -half[1] - GAP]])
        places = (points * axes.transData.transform(own) + shift[:, None]).reshape(-1, 2)
        best = np.argmax(_room(places, half, np.concatenate(taken), points * axes.bbox.get_points()))
        offset = {"textcoords": "offset points", "ha": "center", "va": "center", "fontsize": size}
        behind = {"bbox": {"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.3}, "zorder": 5}
        axes.annotate(name, own[best % len(own)], shift[best // len(own)], color=colour, **offset, **behind)
        taken.append(_fine(places[best] + half * [[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]))


def _room(places, half, taken, frame):
    """Return a score for each place of a label of this half width and height: its distance from all others, up to a
    limit.
    """
    clear = (np.abs(places[:, None] - taken) - half).max(axis=2).min(axis=1)
    inside = np.minimum(places - half - frame[0], frame[1] - places - half).min(axis=1)
    aside = np.abs(places[:, 0] - frame[:, 0].mean()) / np.ptp(frame[:, 0])
    return np.where(inside > 0, np.minimum(clear, CLEAR), -np.inf) - aside


def _fine(corners, first=0.0, last=1.0):
    """Return PARTS points along a part of a polyline of corners (n, 2), evenly over its corners."""
    at, steps = np.linspace(first, last, PARTS) * (len(corners) - 1), np.arange(len(corners))
    return np.column_stack([np.interp(at, steps, column) for column in np.transpose(corners)])
