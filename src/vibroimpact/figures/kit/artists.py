"""What a figure shows, as data: backgrounds, styles, labels, ticks, legends, axis limits and places, without pixels.

Positions are fractions of their axes, widths and sizes points, colours hexadecimal with opacity. Places that follow
from the size of letters are left out: they differ between versions of FreeType.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import Collection
from matplotlib.colors import to_hex, to_rgba
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.spines import Spine
from matplotlib.text import Annotation, Text


def describe(figure: Figure) -> dict:
    """The visible artists of a figure as JSON data; axes in reading order, artists in drawing order."""
    figure.draw_without_rendering()  # settles layout and tick labels
    return {
        "width and height [mm]": _rounded(figure.get_size_inches() * 25.4),
        "background": _background(figure.patch),
        "texts": [_style_of_text(text) for text in _visible(figure.texts)],
        "legends": [_legend(legend) for legend in _visible(figure.legends)],
        "others": _others(figure),
        "axes": [_axes(axes) for axes in sorted(_visible(with_insets(figure)), key=_reading_order)],
    }


def with_insets(figure: Figure) -> list[Axes]:
    """The axes of a figure, each with those inside it."""
    return [each for axes in figure.axes for each in (axes, *axes.child_axes)]


def _reading_order(axes):
    """Rows from above, a row from the left; the layout places axes of one row level to a millimetre or so."""
    box = axes.get_position()
    return round(-box.y1, 2), box.x0


def _axes(axes):
    legend = axes.get_legend()
    framed = axes.axison and axes.get_frame_on()
    return {
        "background": _background(axes.patch) if framed else "none",
        "spines": {side: _spine(spine) for side, spine in axes.spines.items() if spine.get_visible() and framed},
        "titles": [_style_of_text(title) for title in _written([axes._left_title, axes.title, axes._right_title])],
        "xlim": _significant(axes.get_xlim()),
        "ylim": _significant(axes.get_ylim()),
        "scales": [axes.get_xscale(), axes.get_yscale()],
        "x axis": _axis(axes.xaxis) if axes.axison else None,
        "y axis": _axis(axes.yaxis) if axes.axison else None,
        "legend": _legend(legend) if legend and legend.get_visible() else None,
        "lines": [_line(line, axes) for line in _visible(axes.lines)],
        "patches": [_patch(patch, axes) for patch in _visible(axes.patches)],
        "collections": [_collection(collection, axes) for collection in _visible(axes.collections)],
        "texts": [_text(text, axes) for text in _written(axes.texts)],
        "others": _others(axes),
    }


KNOWN = Line2D, Patch, Spine, Collection, Text, Legend, Axis, Axes
"""Kinds of artists described by themselves; of any other kind only its name is kept."""


def _others(parent):
    """Artists that are described nowhere else; a figure's own lines and patches are, its background aside."""
    known = KNOWN if isinstance(parent, Axes) else (Axes, Legend, Text)
    children = _visible(child for child in parent.get_children() if child is not parent.patch)
    return [type(child).__name__ for child in children if not isinstance(child, known)]


def _background(patch):
    """Colours of what lies behind everything else, or "none"."""
    return [_hex(patch.get_facecolor()), _edge(patch)] if patch.get_visible() else "none"


def _edge(patch):
    """The colour of an edge that can be seen."""
    return _hex(patch.get_edgecolor()) if patch.get_linewidth() else "none"


def _spine(spine):
    return {
        "colour": _hex(spine.get_edgecolor()),
        "width": _rounded(spine.get_linewidth()),
        "dashes": str(spine.get_linestyle()),
    }


def _axis(axis):
    """Label, tick labels, marks and grid lines of an axis; styles that ticks share once, majors before minors."""
    major, minor = (_within_view(axis, ticks) for ticks in (axis.get_major_ticks(), axis.get_minor_ticks()))
    labels = [text for tick in major for text in _written([tick.label1, tick.label2])]
    further = [text for tick in minor for text in _written([tick.label1, tick.label2])]
    return {
        "label": [_style_of_text(text) for text in _written([axis.label])],
        "ticks": [text.get_text() for text in labels],
        "minor ticks": [text.get_text() for text in further],
        "lettering": _distinct(_lettering(text) for text in [*labels, *further]),
        "factor": [_style_of_text(text) for text in _written([axis.offsetText])],
        "marks": [_distinct(_marks(tick) for tick in ticks) for ticks in (major, minor)],
        "grid": [_distinct(_grid(tick) for tick in ticks if tick.gridline.get_visible()) for ticks in (major, minor)],
    }


def _within_view(axis, ticks):
    """Ticks that can be seen; a tick at the end of an axis is, whatever the rounding."""
    scaled = axis.get_transform().transform
    low, high = sorted(scaled(axis.get_view_interval()))
    slack = 1e-9 * (high - low)
    return [tick for tick in _visible(ticks) if low - slack <= scaled(tick.get_loc()) <= high + slack]


def _marks(tick):
    """The marks of a tick on both sides of its axes."""
    return [
        {
            "mark": str(line.get_marker()),
            "size": _rounded(line.get_markersize()),
            "width": _rounded(line.get_markeredgewidth()),
            "colour": _hex(line.get_markeredgecolor(), line.get_alpha()),
        }
        for line in _visible([tick.tick1line, tick.tick2line])
    ]


def _grid(tick):
    line = tick.gridline
    return {
        "colour": _hex(line.get_color(), line.get_alpha()),
        "dashes": _dashes(line),
        "width": _rounded(line.get_linewidth()),
    }


def _distinct(entries):
    """Entries without repetitions, in their order."""
    found = []
    for entry in entries:
        if entry not in found:
            found.append(entry)
    return found


def _legend(legend):
    names = legend.get_texts()
    styles = [_style_of_line(h) if isinstance(h, Line2D) else _style_of_patch(h) for h in legend.legend_handles]
    framed = legend.get_frame_on() and legend.get_frame().get_visible()
    return {
        "frame": _style_of_patch(legend.get_frame()) if framed else "none",
        "title": [_style_of_text(title) for title in _written([legend.get_title()])],
        "entries": [
            {"name": name.get_text(), **style, "lettering": _lettering(name)}
            for name, style in zip(names, styles, strict=True)
        ],
    }


def _line(line, axes):
    points = (line.get_transform() - axes.transAxes).transform(line.get_xydata())
    ends = {"from": _rounded(points[0]), "to": _rounded(points[-1])} if len(points) else {}
    return {"name": _name(line), **_style_of_line(line), "points": len(points), **ends, "box": _box(points)}


def _style_of_line(line):
    return {
        "colour": _hex(line.get_color(), line.get_alpha()),
        "dashes": _dashes(line),
        "width": _rounded(line.get_linewidth()),
        "marker": str(line.get_marker()),
        "marker size": _rounded(line.get_markersize()),
        "marker colours": [
            _hex(colour, line.get_alpha()) for colour in (line.get_markerfacecolor(), line.get_markeredgecolor())
        ],
        "marker edge": _rounded(line.get_markeredgewidth()),
        "order": line.get_zorder(),
        **_effects(line),
    }


def _effects(artist):
    """Shadows, outlines and the like, by their kinds, of an artist that has any."""
    effects = [type(effect).__name__ for effect in artist.get_path_effects() or ()]
    return {"effects": effects} if effects else {}


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
        **_effects(patch),
    }


def _collection(collection, axes):
    """Lines, areas, or (with offsets in data units) markers; the box is around what the data say.

    Of faces that show values on a scale, the scale is kept: the values themselves are in the table.
    """
    markers = collection.get_offset_transform().contains_branch(axes.transData)
    to_axes = (collection.get_offset_transform() if markers else collection.get_transform()) - axes.transAxes
    points = [collection.get_offsets()] if markers else [path.vertices for path in collection.get_paths()]
    scale = None if collection.get_array() is None else _scale(collection)
    shapes = [len(path.vertices) for path in collection.get_paths()] if markers else []
    return {
        "name": _name(collection),
        "kind": type(collection).__name__,
        "faces": [_hex(colour) for colour in (collection.get_facecolor() if scale is None else scale)],
        "edges": [_hex(colour) for colour in collection.get_edgecolor()],
        "widths": _rounded(collection.get_linewidth()),
        "dashes": ["solid" if dashes is None else _rounded(dashes) for _, dashes in collection.get_linestyle()],
        "hatch": collection.get_hatch() or "",
        "shapes": _distinct(shapes),
        "sizes": _distinct(_rounded(np.ravel(collection.get_sizes()))) if hasattr(collection, "get_sizes") else [],
        "points": sum(len(part) for part in points),
        "box": _box(to_axes.transform(np.concatenate(points))) if points else [],
        "order": collection.get_zorder(),
        **_effects(collection),
    }


def _scale(collection):
    """Twelve colours from the lowest to the highest value.

    At elevenths: at eighths a map of 256 colours goes from one to the next, and the last digit of a value decides.
    """
    return collection.to_rgba(np.linspace(*collection.get_clim(), 12), alpha=collection.get_alpha())


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
        **_lettering(text),
        "align": [text.get_ha(), text.get_va()],
    }


def _lettering(text):
    arrow, box = getattr(text, "arrow_patch", None), text.get_bbox_patch()
    return {
        "font": [*text.get_fontfamily(), text.get_fontstyle()],
        "size": _rounded(text.get_fontsize()),
        "weight": str(text.get_fontweight()),
        "colour": _hex(text.get_color(), text.get_alpha()),
        "rotation": _rounded(text.get_rotation()),
        **({"box": _style_of_patch(box)} if box else {}),
        **({"arrow": _style_of_patch(arrow)} if arrow else {}),
        **_effects(text),
    }


def _visible(artists):
    return [artist for artist in artists if artist.get_visible()]


def _written(texts):
    """Texts that say something, or point somewhere."""
    return [text for text in _visible(texts) if text.get_text() or getattr(text, "arrow_patch", None)]


def _name(artist):
    """The label that was given, not the one that Matplotlib makes up."""
    label = str(artist.get_label())
    return "" if label.startswith("_") else label


def _hex(colour, alpha=None):
    """A colour, with the opacity of its artist where that has one of its own."""
    return "none" if isinstance(colour, str) and colour == "none" else to_hex(to_rgba(colour, alpha), keep_alpha=True)


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
