"""Write names of curves at positions where the names cover no line, marker or other name."""

from itertools import pairwise

import numpy as np
from matplotlib.transforms import Bbox

from vibroimpact.figures.plotting.style import GREY, HALO

STEP, GAP = 4.0, 1.6
"""Distance between the places that are tried for a name, and smallest distance from a name to a line or marker, in
points."""
LEADER = 5.0
"""Distance in points between a name and its curve above which a leader line connects them."""
CLEAR_DISTANCE = 50.0
"""A place where the curve of a name is not obvious is used if no good place is within this distance, in points."""
LEAD_MARGIN = 3.0
"""Points by which a name without a leader line must be nearer to its own curve than to other named curves."""

UNCLEAR, OVERLAPS = 1, 2
"""Defects of a place. A place with a defect is used only if no better place is found. UNCLEAR: it is not obvious to
which curve the name belongs. OVERLAPS: the name covers something."""


def name_curves(figure, panels: dict, **style) -> None:
    """Write the name of each curve next to the curve, in the colour of the curve.

    If possible, the names cover no line, marker, text or inset. Call this function last, since the positions of the
    names depend on the limits of the axes and on the layout.

    Parameters
    ----------
    panels : dict
        The keys are axes, and the values are lists of pairs. A pair contains the name of a curve, and a list of the
        Line2D objects that draw this curve.
    style
        Text properties of the names.
    """
    figure.draw_without_rendering()
    for axes, curves in panels.items():
        _Names(axes, figure.dpi / 72.0).write(curves, style)


def name_walls(axes, name: str = "wall") -> None:
    """Write a name at the right ends of the lines at the walls W = +-1."""
    for wall in (-1.0, 1.0):
        place = {"xycoords": axes.get_yaxis_transform(), "textcoords": "offset points"}
        axes.annotate(name, (1.0, wall), (3, 0), va="center", linespacing=0.9, fontsize=10, **place)


class _Names:
    """Names of the curves in one set of axes; lengths are in pixels."""

    def __init__(self, axes, point):
        self.axes, self.point = axes, point
        self.to_data = axes.transData.inverted().transform
        self.avoided = {line: _outline(line, point) for line in axes.lines}
        self.boxes = [text.get_window_extent() for text in axes.texts]
        self.boxes += [inset.get_tightbbox() for inset in axes.child_axes]

    def write(self, curves, style):
        curves = [(name, lines) for name, lines in curves if any(len(self.avoided[line]) for line in lines)]
        outlines = [np.concatenate([self.avoided[line] for line in lines]) for _, lines in curves]
        for n, (name, lines) in enumerate(curves):
            own, others = outlines[n], outlines[:n] + outlines[n + 1 :]
            look = {"color": lines[0].get_color(), "ha": "center", "va": "center"}
            text = self.axes.text(0, 0, name, **HALO | look | style)
            size = text.get_window_extent()
            place, start, end = self._place(
                np.array([size.width, size.height]) / 2, own, np.concatenate([own[:0], *others])
            )
            text.set_position(self.to_data(place))
            self.boxes.append(text.get_window_extent())
            if np.hypot(*(end - start)) > LEADER * self.point:
                ends = self.to_data([start, end]).T
                (leader,) = self.axes.plot(*ends, color=GREY, linewidth=0.5, scalex=False, scaley=False)
                self.avoided[leader] = _outline(leader, self.point)

    def _place(self, half, own, others):
        """Return the centre of a name near its curve, and both ends of the leader line from the name to the curve.

        half: half the width and half the height of the name, shape (2,).
        own: discs that cover the curve, as in `_outline`, shape (n, 3).
        others: discs that cover all other named curves, shape (m, 3).
        """
        frame, margin = self.axes.get_window_extent(), half + GAP * self.point
        x = np.arange(frame.x0 + margin[0], frame.x1 - margin[0], STEP * self.point)
        y = np.arange(frame.y0 + margin[1], frame.y1 - margin[1], STEP * self.point)
        places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        gaps = _gaps(places[:, None], half, own).min(axis=1)
        avoided, found = np.concatenate(list(self.avoided.values())), {}
        for n in np.argsort(gaps.round(3), kind="stable"):
            if gaps[n] > CLEAR_DISTANCE * self.point and UNCLEAR in found:
                break
            place = places[n]
            end = own[_gaps(place, half, own).argmin(), :2]
            start = np.clip(end, place - half, place + half)
            led = np.hypot(*(end - start)) > LEADER * self.point
            leader = start + np.linspace(0.05, 1.0, 25)[:, None] * (end - start)
            covers = (
                _gaps(place, half, avoided).min() < GAP * self.point
                or Bbox([place - half - self.point, place + half + self.point]).count_overlaps(self.boxes)
                or (led and any(box.contains(*one) for box in self.boxes for one in leader))
            )
            if led:
                unclear = _gaps(leader[:, None], self.point, others).min(initial=np.inf) < 0
            else:
                unclear = _gaps(place, half, others).min(initial=np.inf) < gaps[n] + LEAD_MARGIN * self.point
            if not covers and not unclear:
                return place, start, end
            found.setdefault(OVERLAPS if covers else UNCLEAR, (place, start, end))
        return found[min(found)]


def _outline(line, point):
    """Return discs that cover a line and its markers, shape (n, 3).

    The columns are centre x, centre y and radius in pixels. point: length of a typographic point in pixels.
    """
    corners = line.get_transform().transform(line.get_xydata())
    corners = corners[np.isfinite(corners).all(axis=1)]
    marked = line.get_marker() not in ("", "None", None)
    parts = [np.column_stack([corners, np.full(len(corners), marked * line.get_markersize() / 2 * point)])]
    for start, end in pairwise(corners) if line.get_linestyle() != "None" else ():
        steps = 1 + int(np.hypot(*(end - start)) / (GAP * point))
        between = start + np.linspace(0.0, 1.0, steps)[:, None] * (end - start)
        parts.append(np.column_stack([between, np.full(steps, line.get_linewidth() / 2 * point)]))
    return np.concatenate(parts)


def _gaps(place, half, points):
    """Return the distances of discs from a rectangle.

    place: centre of the rectangle. half: half the width and half the height of the rectangle. points: discs as in
    `_outline`, shape (n, 3).
    """
    apart = np.maximum(np.abs(points[:, :2] - place) - half, 0.0)
    return np.hypot(apart[..., 0], apart[..., 1]) - points[:, 2]
