"""Style shared by all figures, and functions that draw a figure and save it to files."""

import functools
import json
from io import BytesIO
from pathlib import Path

import matplotlib.style
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from vibroimpact import tables
from vibroimpact.figures.plotting.versions import recorded_versions

STYLE_FILE = Path(__file__).with_name("vibroimpact.mplstyle")

SINGLE_COLUMN, DOUBLE_COLUMN = 84.0, 174.0
"""Widths of a printed figure in mm."""

BLACK, GREY, LIGHT_GREY = "black", "0.55", "0.86"
STABLE = {"color": BLACK, "linewidth": 1.8, "linestyle": "-"}
UNSTABLE = {"color": BLACK, "linewidth": 1.0, "linestyle": (0, (4.5, 2.5))}
LEVEL = {"color": BLACK, "linewidth": 0.9, "linestyle": (0, (1, 1.8))}
"""Line styles of the chapter: stable branch bold solid, unstable branch dashed, B_min and C_min dotted."""
HALO = {"path_effects": [withStroke(linewidth=2.5, foreground="white")], "zorder": 4}
"""Text style, with a white outline, for a name that lines may cross."""

# Omit the date, so that the same figure always gives the same bytes.
_METADATA = {"png": {}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}


def styled(function):
    """Decorate a drawing function to use the shared style, independent of the caller's Matplotlib settings."""

    @functools.wraps(function)
    def in_style(*args, **kwargs):
        with matplotlib.style.context(STYLE_FILE, after_reset=True):
            return function(*args, **kwargs)

    return in_style


def new_figure(width: float, height: float, layout: str | None = "constrained") -> Figure:
    """Return an empty figure with exactly the given width and height in mm."""
    return Figure(figsize=(width / 25.4, height / 25.4), layout=layout)


def side_by_side(panels: int, most: int = 3) -> tuple[int, int]:
    """Return the number of columns and the number of rows of a grid for `panels` panels.

    most: largest number of columns.
    """
    columns = min(panels, most)
    return columns, -(-panels // columns)


def heading(axes, letter: str = "", words: str = "") -> None:
    """Write the heading of a panel: its letter in bold, and words on its content."""
    axes.set_title("   ".join(filter(None, [letter and rf"$\mathbf{{{letter}}}$", words])), loc="left", pad=4)


def time_plot(axes, lines, walls: bool = True) -> None:
    """Draw lines against time. If `walls` is True, also draw the walls W = +-1.

    lines: one tuple (times, values, style) per line.
    """
    for wall in (-1.0, 1.0) if walls else ():
        axes.axhline(wall, color=BLACK, linewidth=0.4, zorder=0)
    for time, values, style in lines:
        axes.plot(time, values, **style)
        axes.set(xlim=(time.min(), time.max()) if len(time) else None)


def hatch_gaps(axes) -> None:
    """Hatch the cells of a map that have no value."""
    axes.patch.set(hatch="xxx", edgecolor=GREY)


@styled
def png(figure: Figure) -> bytes:
    """Return the PNG of a figure, to be shown but not saved."""
    buffer = BytesIO()
    figure.savefig(buffer, format="png")
    return buffer.getvalue()


@styled
def save(figure: Figure, outputs: dict) -> None:
    """Write a figure to the files outputs["png"], outputs["pdf"] and outputs["svg"].

    A file whose key is missing in `outputs` is not written. All files have the same layout. If `outputs` has the key
    "provenance", write the package versions to the file outputs["provenance"].
    """
    # The order of the files is fixed, since each drawing can change the last digits of the positions of the axes.
    for kind in (kind for kind in _METADATA if kind in outputs):
        figure.savefig(outputs[kind], format=kind, metadata=_METADATA[kind])
        figure.set_layout_engine(None)  # with a layout engine, each further file would be drawn twice
    if "provenance" in outputs:
        versions = json.dumps({"versions": recorded_versions()})
        Path(outputs["provenance"]).write_text(versions, encoding="utf-8")


def draw_tables(figure, read: dict) -> Figure:
    """Draw a figure from its tables.

    figure: Python module of the figure. read: data frames of the tables, keyed by the names of the tables. If the
    figure has only the table "csv", `figure.draw` gets this table. If the figure has other tables, `figure.draw` gets
    `read`. If the figure has no tables, `figure.draw` gets no argument.
    """
    if not read:
        return figure.draw()
    several = list(read) != ["csv"] or getattr(figure, "SPEC", {}).get("tables")
    return figure.draw(read if several else read["csv"])


def write_and_draw(figure, computed, outputs: dict) -> None:
    """Write the tables of a figure to files, and draw the figure from the tables as written.

    figure: Python module of the figure.
    computed: result of `figure.compute`.
    outputs: paths of the files to write. The path of a table has the name of the table as its key. The path of any
    other file has a key that `save` knows, such as "png". A table without a path is not written.
    """
    drawn = _by_name(computed)
    for name in drawn.keys() & outputs.keys():
        tables.write(drawn[name], outputs[name])
        drawn[name] = tables.read(outputs[name])
    save(draw_tables(figure, drawn), outputs)


def shown(figure, inputs: dict, *args, **settings) -> tuple:
    """Return the tables of a figure as `figure.compute` returns them, and the PNG of the figure as a path or as bytes.

    figure: Python module of the figure.
    inputs: paths of files. The path of a table has the name of the table as its key. The path of the PNG has the key
    "png".
    args, settings: arguments of `figure.compute`.

    If `inputs` contains paths, the tables are read from their files, and the PNG is returned as its path. If `inputs`
    is empty, the figure is computed and drawn, and the PNG is returned as bytes.
    """
    if not inputs:
        computed = figure.compute(*args, **settings)
        return computed, png(draw_tables(figure, _by_name(computed)))
    further = figure.SPEC.get("tables", {})
    made = {name: tables.read(inputs[name]) for name in (["csv"] if "columns" in figure.SPEC else []) + [*further]}
    return made if further else made.get("csv"), inputs["png"]


def _by_name(computed):
    return computed if isinstance(computed, dict) else {"csv": computed}
