"""What a figure shows, as data: line styles, labels, legends, axis limits and places, all without pixels.

Positions are fractions of their axes, widths and sizes points, colours hexadecimal with opacity. Places that follow
from the size of letters are left out: they differ between versions of FreeType.
"""

import matplotlib
import numpy as np
from matplotlib import ft2font
from matplotlib.axis import Axis
from matplotlib.collections import Collection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.spines import Spine
from matplotlib.text import Annotation, Text


def drawn_with() -> dict[str, str]:
    """Versions that decide on pixels."""
    return {"matplotlib": matplotlib.__version__, "freetype": ft2font.__freetype_version__}


def describe(figure: Figure) -> dict:
    """The visible artists of a figure as JSON data; axes in reading order, artists in drawing order."""
    figure.draw_without_rendering()  # settles layout and tick labels
    return {
        "width and height [mm]": _rounded(figure.get_size_inches() * 25.4),
        "texts": [_style_of_text(text) for text in _visible(figure.texts)],
        "legends": [_legend(legend) for legend in _visible(figure.legends)],
        "axes": [_axes(axes) for axes in sorted(_visible(figure.axes), key=_reading_order)],
    }


def _reading_order(axes):
    """Rows from above, a row from the left; the layout places axes of one row level to a millimetre or so."""
    box = axes.get_position()
    return round(-box.y1, 2), box.x0


def _axes(axes):
    legend = axes.get_legend()
    texts = [text for text in _visible(axes.texts) if text.get_text()]
    return {
        "titles": [axes.get_title(place) for place in ("left", "center", "right")],
        "labels": [axes.get_xlabel(), axes.get_ylabel()] if axes.axison else [],
        "xlim": _significant(axes.get_xlim()),
        "ylim": _significant(axes.get_ylim()),
        "scales": [axes.get_xscale(), axes.get_yscale()],
        "xticks": _tick_labels(axes.xaxis) if axes.axison else [],
        "yticks": _tick_labels(axes.yaxis) if axes.axison else [],
        "legend": _legend(legend) if legend and legend.get_visible() else None,
        "lines": [_line(line, axes) for line in _visible(axes.lines)],
        "patches": [_patch(patch, axes) for patch in _visible(axes.patches)],
        "collections": [_collection(collection, axes) for collection in _visible(axes.collections)],
        "texts": [_text(text, axes) for text in texts],
        "others": [type(child).__name__ for child in _visible(axes.get_children()) if not isinstance(child, KNOWN)],
    }


KNOWN = Line2D, Patch, Spine, Collection, Text, Legend, Axis
"""Kinds of artists described by themselves; of any other kind only its name is kept."""


def _tick_labels(axis):
    """Texts of the major ticks that can be seen; a tick at the end of an axis is, whatever the rounding."""
    low, high = sorted(axis.get_view_interval())
    slack = 1e-9 * (high - low)
    across = axis.axis_name == "y"
    labels = _visible(axis.get_ticklabels())
    return [text.get_text() for text in labels if low - slack <= text.get_position()[across] <= high + slack]


def _legend(legend):
    names = [text.get_text() for text in legend.get_texts()]
    styles = [_style_of_line(h) if isinstance(h, Line2D) else _style_of_patch(h) for h in legend.legend_handles]
    return [{"name": name, **style} for name, style in zip(names, styles, strict=True)]


def _line(line, axes):
    points = (line.get_transform() - axes.transAxes).transform(line.get_xydata())
    ends = {"from": _rounded(points[0]), "to": _rounded(points[-1])} if len(points) else {}
    return {"name": _name(line), **_style_of_line(line), "points": len(points), **ends, "box": _box(points)}


def _style_of_line(line):
    return {
        "colour": _hex(line.get_color()),
        "dashes": _dashes(line),
        "width": _rounded(line.get_linewidth()),
        "marker": str(line.get_marker()),
        "marker size": _rounded(line.get_markersize()),
        "marker colours": [_hex(line.get_markerfacecolor()), _hex(line.get_markeredgecolor())],
        "order": line.get_zorder(),
    }


def _dashes(line):
    """Lengths of dashes and gaps in line widths; "solid", or "none" for markers alone."""
    if line.get_linestyle() in ("None", "none", "", " "):
        return "none"
    pattern = line._unscaled_dash_pattern[1]  # Matplotlib has no public name for it
    return "solid" if pattern is None else _rounded(pattern)


def _patch(patch, axes):
    path = (patch.get_transform() - axes.transAxes).transform_path(patch.get_path())
    return {"name": _name(patch), **_style_of_patch(patch), "points": len(path), "box": _box(path.vertices)}


def _style_of_patch(patch):
    return {
        "kind": type(patch).__name__,
        "face": _hex(patch.get_facecolor()),
        "edge": _hex(patch.get_edgecolor()),
        "width": _rounded(patch.get_linewidth()),
        "dashes": str(patch.get_linestyle()),
        "hatch": patch.get_hatch() or "",
        "order": patch.get_zorder(),
    }


def _collection(collection, axes):
    """Lines, areas, or (with offsets in data units) markers; the box is around what the data say.

    Of faces that show values on a scale, the scale is kept: the values themselves are in the table.
    """
    markers = collection.get_offset_transform().contains_branch(axes.transData)
    to_axes = (collection.get_offset_transform() if markers else collection.get_transform()) - axes.transAxes
    points = [collection.get_offsets()] if markers else [path.vertices for path in collection.get_paths()]
    scale = None if collection.get_array() is None else collection.to_rgba(np.linspace(*collection.get_clim(), 9))
    return {
        "name": _name(collection),
        "kind": type(collection).__name__,
        "faces": [_hex(colour) for colour in (collection.get_facecolor() if scale is None else scale)],
        "edges": [_hex(colour) for colour in collection.get_edgecolor()],
        "widths": _rounded(collection.get_linewidth()),
        "dashes": ["solid" if dashes is None else _rounded(dashes) for _, dashes in collection.get_linestyle()],
        "points": sum(len(part) for part in points),
        "box": _box(to_axes.transform(np.concatenate(points))) if points else [],
        "order": collection.get_zorder(),
    }


def _text(text, axes):
    if isinstance(text, Annotation):
        in_data = text.xycoords == "data"
        place = (axes.transData - axes.transAxes).transform(text.xy) if in_data else text.xy
        return {**_style_of_text(text), "at": _rounded(place), "offset": _rounded(text.xyann)}
    place = (text.get_transform() - axes.transAxes).transform(text.get_position())
    return {**_style_of_text(text), "at": _rounded(place)}


def _style_of_text(text):
    return {
        "text": text.get_text(),
        "size": _rounded(text.get_fontsize()),
        "weight": str(text.get_fontweight()),
        "colour": _hex(text.get_color()),
        "align": [text.get_ha(), text.get_va()],
        "rotation": _rounded(text.get_rotation()),
    }


def _visible(artists):
    return [artist for artist in artists if artist.get_visible()]


def _name(artist):
    """The label that was given, not the one that Matplotlib makes up."""
    label = str(artist.get_label())
    return "" if label.startswith("_") else label


def _hex(colour):
    return to_hex(colour, keep_alpha=True) if not isinstance(colour, str) or colour != "none" else "none"


def _box(points):
    """[x0, y0, x1, y1] around points."""
    points = np.asarray(points, float)
    points = points[np.isfinite(points).all(axis=1)]
    return _rounded([*points.min(axis=0), *points.max(axis=0)]) if len(points) else []


def _rounded(values):
    """Numbers to 6 decimals as JSON takes them: a thousandth of what can be seen; never a negative zero."""
    return (np.round(np.asarray(values, float), 6) + 0.0).tolist()


def _significant(values):
    return [float(f"{value:.12g}") for value in values]
