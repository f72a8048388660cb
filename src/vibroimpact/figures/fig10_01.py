"""Figure 10.1: the vibro-impact system to be considered."""

from matplotlib.figure import Figure

from vibroimpact.figures.plotting import drawing
from vibroimpact.figures.plotting.style import SINGLE_COLUMN, styled

SPEC = {
    "title": "The mechanical system",
    "notebook": "drawings",
    "caption": "Fig. 10.1. The vibro-impact system: two boxes of mass :math:`M`, tied to the ground by :math:`k_i`, "
        ":math:`c_i` and to each other by :math:`k_{12}`, :math:`c_{12}`, under forces :math:`F_i(t)`. In each box a "
        "ball of mass :math:`m` moves freely in a straight cavity.",
    "alt": "Technical drawing. Two boxes of mass M in a row on rollers, each with a ball of mass m in a straight "
        "cavity. Springs and dampers tie box 1 to the left support, the boxes to each other, and box 2 to the right "
        "support. Arrows show the forces F1 and F2 and the coordinates x and y of boxes and balls.",
    "equations": [r"\begin{aligned} M\ddot x_1 + c_1\dot x_1 + k_1 x_1 - c_{12}(\dot x_2 - \dot x_1) - k_{12}(x_2 - "
        r"x_1) &= F_{10}\sin(\omega_1 t) \\ M\ddot x_2 + c_2\dot x_2 + k_2 x_2 + c_{12}(\dot x_2 - \dot x_1) + "
        r"k_{12}(x_2 - x_1) &= F_{20}\sin(\omega_2 t) \\ m\ddot y_1 = 0, \qquad m\ddot y_2 &= 0 \end{aligned} "
        r"\tag{10.1}"],
    "method": "drawing to scale, without computed quantities",
}  # fmt: skip

WIDTH, HEIGHT = SINGLE_COLUMN, 39.0
WALLS = 3.0, 81.0
FLOOR, WHEEL = 3.5, 1.1
BOX_WIDTH, BOX_HEIGHT = 18.0, 19.0
BOTTOM = FLOOR + 2 * WHEEL
TOP = BOTTOM + BOX_HEIGHT
SPRING, FORCE, DAMPER = BOTTOM + 15.8, BOTTOM + 8.4, BOTTOM + 4.6
GAP = (WALLS[1] - WALLS[0] - 2 * BOX_WIDTH) / 3
LEFTS = WALLS[0] + GAP, WALLS[0] + 2 * GAP + BOX_WIDTH
CAVITY_HEIGHT, CAVITY_MARGIN, BALL_OFFSET = 6.0, 1.8, 3.0
X_LEVEL, Y_LEVEL = TOP + 10.0, TOP + 5.0


def compute() -> dict:
    """Return no tables, since the drawing shows no computed numbers."""
    return {}


@styled
def draw() -> Figure:
    """Draw the two modules: boxes M with balls m in straight cavities, on springs and dampers, under forces F_i(t)."""
    figure, axes = drawing.sheet(WIDTH, HEIGHT)
    drawing.ground(axes, [WALLS[0], WALLS[0]], [TOP + 1.5, FLOOR], outside=(-1, 0))
    drawing.ground(axes, WALLS, [FLOOR, FLOOR], outside=(0, -1))
    drawing.ground(axes, [WALLS[1], WALLS[1]], [FLOOR, TOP + 1.5], outside=(1, 0))
    ends = [(WALLS[0], LEFTS[0]), (LEFTS[0] + BOX_WIDTH, LEFTS[1]), (LEFTS[1] + BOX_WIDTH, WALLS[1])]
    for (start, end), index in zip(ends, ("1", "12", "2"), strict=True):
        _suspension(axes, start, end, index)
    for left, index in zip(LEFTS, "12", strict=True):
        _module(axes, left, index)
    return figure


def _suspension(axes, start, end, index):
    drawing.spring(axes, start, end, SPRING)
    drawing.damper(axes, start, end, DAMPER)
    middle = 0.5 * (start + end)
    drawing.symbol(axes, middle, SPRING + 1.8, f"$k_{{{index}}}$", va="bottom")
    drawing.symbol(axes, middle, DAMPER - 1.8, f"$c_{{{index}}}$", va="top")


def _module(axes, left, index):
    centre, cavity = left + 0.5 * BOX_WIDTH, TOP - CAVITY_MARGIN - CAVITY_HEIGHT
    ball = centre + BALL_OFFSET, cavity + 0.5 * CAVITY_HEIGHT
    for wheel in (left + 3, left + BOX_WIDTH - 3):
        drawing.ball(axes, wheel, FLOOR + WHEEL, WHEEL, linewidth=drawing.LINE)
    drawing.body(axes, left, BOTTOM, BOX_WIDTH, BOX_HEIGHT)
    inside = BOX_WIDTH - 2 * CAVITY_MARGIN
    drawing.body(axes, left + CAVITY_MARGIN, cavity, inside, CAVITY_HEIGHT, facecolor="white", linewidth=drawing.LINE)
    drawing.ball(axes, *ball, 0.5 * CAVITY_HEIGHT - 0.2, linewidth=drawing.LINE)
    drawing.symbol(axes, *ball, "$m$")
    drawing.symbol(axes, centre, 0.5 * (BOTTOM + cavity), "$M$")
    for x, foot, level, name in ((centre, TOP, X_LEVEL, "x"), (ball[0], ball[1] + 2.8, Y_LEVEL, "y")):
        drawing.centre_line(axes, x, foot, level + 1.5)
        drawing.arrow(axes, (x, level), (x + 7.0, level), linewidth=0.7 * drawing.LINE)
        drawing.symbol(axes, x + 7.8, level, f"${name}_{index}$", ha="left")
    right = left + BOX_WIDTH
    drawing.arrow(axes, (right, FORCE), (right + 9.0, FORCE), linewidth=2 * drawing.LINE, size=8.0)
    drawing.symbol(axes, right + 6.2, FORCE + 0.9, rf"$F_{index}(t)$", va="bottom")
