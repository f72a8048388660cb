"""Figure 10.2: a single module of the system and the characteristic dimension."""

from matplotlib.figure import Figure

from vibroimpact.figures.plotting import drawing
from vibroimpact.figures.plotting.style import SINGLE_COLUMN, styled

SPEC = {
    "title": "A single module",
    "notebook": "drawings",
    "caption": "Fig. 10.2. A single module of the system and the characteristic dimension :math:`L`.",
    "alt": "Technical drawing of one box with a ball in its cavity and the characteristic dimension L, the free path "
        "of the ball to either wall from the middle.",
    "equations": [r"|x_i - y_i| \le L, \qquad X_i = x_i/L, \quad Y_i = y_i/L, \quad W_i = X_i - Y_i"],
    "method": "drawing to scale, without computed quantities",
}  # fmt: skip

WIDTH, HEIGHT = SINGLE_COLUMN, 46.0
L, RADIUS, OFFSET = 20.0, 5.0, 8.0
"""Free path of the ball to either side, radius of the ball, and its displacement y - x, in mm on paper."""
ORIGIN, CENTRE, BOTTOM = 5.0, 47.0, 10.0
BOX_WIDTH, BOX_HEIGHT = 62.0, 19.0
CAVITY_BOTTOM, AXIS = 13.5, 18.5
X_LEVEL, Y_LEVEL, L_LEVEL = 41.0, 35.0, 4.0


def compute() -> dict:
    """Return no tables, since the drawing shows no computed numbers."""
    return {}


@styled
def draw() -> Figure:
    """Draw one module; its ball (at y) touches a wall of its box (at x) where |x - y| = L."""
    figure, axes = drawing.sheet(WIDTH, HEIGHT)
    drawing.body(axes, CENTRE - 0.5 * BOX_WIDTH, BOTTOM, BOX_WIDTH, BOX_HEIGHT)
    length = 2 * (L + RADIUS)
    drawing.body(axes, CENTRE - 0.5 * length, CAVITY_BOTTOM, length, 2 * RADIUS, facecolor="white")
    for wall in (-1, 1):
        drawing.ball(
            axes, CENTRE + wall * L, AXIS, RADIUS, facecolor="none", linestyle=(0, (3, 2)), linewidth=drawing.LINE
        )
        drawing.centre_line(axes, CENTRE + wall * L, L_LEVEL - 1.5, AXIS + RADIUS + 1.5)
        ends = (CENTRE, L_LEVEL), (CENTRE + wall * L, L_LEVEL)
        drawing.arrow(axes, *ends, style="<|-|>", linewidth=drawing.THIN)
        drawing.symbol(axes, CENTRE + wall * 0.5 * L, L_LEVEL + 0.8, "$L$", va="bottom")
    drawing.ball(axes, CENTRE + OFFSET, AXIS, RADIUS)
    drawing.centre_line(axes, CENTRE, L_LEVEL - 1.5, X_LEVEL + 1.5)
    drawing.centre_line(axes, CENTRE + OFFSET, AXIS + RADIUS, Y_LEVEL + 1.5)
    drawing.centre_line(axes, ORIGIN, Y_LEVEL - 1.5, X_LEVEL + 1.5)
    for x, level, name in ((CENTRE, X_LEVEL, "$x_i$"), (CENTRE + OFFSET, Y_LEVEL, "$y_i$")):
        drawing.arrow(axes, (ORIGIN, level), (x, level), linewidth=0.7 * drawing.LINE)
        drawing.symbol(axes, 0.5 * (ORIGIN + CENTRE), level + 0.8, name, va="bottom")
    drawing.symbol(axes, CENTRE + OFFSET, AXIS, "$m$")
    drawing.symbol(axes, CENTRE - 0.5 * L, CAVITY_BOTTOM + 2 * RADIUS + 2.7, "$M$")
    return figure
