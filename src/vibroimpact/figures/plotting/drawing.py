"""Draw parts of a mechanical drawing: springs, dampers, ground, balls, coordinates. Lengths are in mm on paper."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, Rectangle

from vibroimpact.figures.plotting.style import BLACK, LIGHT_GREY, new_figure

OUTLINE, LINE, THIN = 1.1, 0.9, 0.5
"""Line widths in points: bodies, springs and dampers, auxiliary lines."""
SYMBOL = 10
"""Size of symbols in points, chosen so that their subscripts have a size of 7 points."""
HATCH = 1.5
"""Distance between the hatches of the ground, and their length along and across its surface, in mm."""


def sheet(width: float, height: float) -> tuple[Figure, object]:
    """Return a figure and its only axes, without frame; coordinates are in mm from the lower left corner."""
    figure = new_figure(width, height, layout=None)
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, width), ylim=(0, height))
    axes.set_axis_off()
    return figure, axes


def polyline(axes, x, y, linewidth=LINE, **style):
    """Draw a line through points, and return it."""
    style = {"color": BLACK, "solid_capstyle": "round", "solid_joinstyle": "round"} | style
    return axes.plot(x, y, linewidth=linewidth, **style)[0]


def symbol(axes, x, y, text, **style):
    """Write a symbol centred on a point, and return the text."""
    style = {"fontsize": SYMBOL, "ha": "center", "va": "center"} | style
    return axes.text(x, y, text, **style)


def centre_line(axes, x, bottom, top):
    """Draw a vertical centre line."""
    polyline(axes, [x, x], [bottom, top], THIN, linestyle=(0, (7, 2, 1.5, 2)))


def ground(axes, x, y, outside):
    """Draw the ground through the points (x, y), hatched on the side of the unit vector `outside`."""
    polyline(axes, x, y, OUTLINE)
    start, end = np.array([x[0], y[0]]), np.array([x[-1], y[-1]])
    run = np.linalg.norm(end - start)
    along = (end - start) / run
    outside = np.array(outside)
    for distance in np.arange(0.5 * HATCH, run, HATCH):
        foot = start + distance * along
        tip = foot + HATCH * (outside - along)
        polyline(axes, [foot[0], tip[0]], [foot[1], tip[1]], THIN, solid_capstyle="butt")


def spring(axes, x0, x1, y):
    """Draw a linear spring with five teeth from (x0, y) to (x1, y)."""
    zigzag = np.linspace(x0 + 2.0, x1 - 2.0, 11)
    offset = np.concatenate([[0.0], np.resize([1.5, -1.5], 10), [0.0]])
    middles = np.concatenate([zigzag[:1], 0.5 * (zigzag[1:] + zigzag[:-1]), zigzag[-1:]])
    polyline(axes, [x0, *middles, x1], [y, *(y + offset), y])


def damper(axes, x0, x1, y):
    """Draw a viscous damper from (x0, y) to (x1, y), with the cup on the left and the piston on the right."""
    height, length = 1.5, 4.0
    left, right = 0.5 * (x0 + x1 - length), 0.5 * (x0 + x1 + length)
    piston = left + 0.45 * length
    polyline(axes, [x0, left], [y, y])
    polyline(axes, [right, left, left, right], [y + height, y + height, y - height, y - height])
    polyline(axes, [piston, piston], [y - 0.65 * height, y + 0.65 * height], 1.8 * LINE, solid_capstyle="butt")
    polyline(axes, [piston, x1], [y, y])


def body(axes, x, y, width, height, **style):
    """Draw a rigid body with its lower left corner at (x, y)."""
    style = {"facecolor": LIGHT_GREY, "edgecolor": BLACK, "linewidth": OUTLINE} | style
    axes.add_patch(Rectangle((x, y), width, height, **style))


def ball(axes, x, y, radius, **style):
    """Draw a ball centred at (x, y)."""
    style = {"facecolor": "white", "edgecolor": BLACK, "linewidth": OUTLINE} | style
    axes.add_patch(Circle((x, y), radius, **style))


def arrow(axes, tail, head, style="-|>", linewidth=LINE, size=6.0):
    """Draw an arrow between two points, with its tip exactly on the second point."""
    axes.add_patch(
        FancyArrowPatch(
            tail,
            head,
            arrowstyle=f"{style},head_length=0.5,head_width=0.2",
            mutation_scale=size,
            linewidth=linewidth,
            color=BLACK,
            shrinkA=0,
            shrinkB=0,
            joinstyle="miter",
            capstyle="butt",
        )
    )
