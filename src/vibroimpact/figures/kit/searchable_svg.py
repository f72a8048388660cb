"""A backend of Matplotlib: SVG of outlines, which look the same on every machine, under words that can be searched.

Words alone would need the font where they are read, and lie elsewhere without it. So the words are transparent: they
are found, marked, copied and read aloud, and it is the outlines that are seen.
"""

import io
import unicodedata

from matplotlib.backends.backend_mixed import MixedModeRenderer
from matplotlib.backends.backend_svg import FigureCanvasSVG, RendererSVG
from matplotlib.cbook import open_file_cm
from matplotlib.mathtext import MathTextParser


class Renderer(RendererSVG):
    """Draws each line of a text as outlines and, as wide and transparent, as words."""

    def draw_text(self, gc, x, y, s, prop, angle, ismath=False, mtext=None):
        super().draw_text(gc, x, y, s, prop, angle, ismath, mtext)
        width, _, _ = self.get_text_width_height_descent(s, prop, ismath)
        self.writer.element(
            "text",
            _words(s) if ismath else s,
            attrib={
                "transform": f"translate({x:.2f} {y:.2f}) rotate({-angle or 0:g})",
                "style": f"font: {prop.get_size():g}px serif; fill-opacity: 0",
                "textLength": f"{width:.2f}",
                "lengthAdjust": "spacingAndGlyphs",
            },
        )


def _words(formula):
    """A formula as plain letters, in the order in which it is set."""
    glyphs = MathTextParser("path").parse(formula, 72).glyphs
    return unicodedata.normalize("NFKC", "".join(chr(glyph[2]) for glyph in glyphs))


class FigureCanvas(FigureCanvasSVG):
    """Writes a figure as SVG with this renderer."""

    def print_svg(self, filename, *, metadata=None, **_):
        dpi, size = self.figure.dpi, self.figure.get_size_inches()
        self.figure.dpi = self.fixed_dpi
        with open_file_cm(filename, "wb") as file:
            text = io.TextIOWrapper(file, encoding="utf-8", newline="\n", write_through=True)
            vectors = Renderer(*(self.fixed_dpi * size), text, image_dpi=dpi, metadata=metadata)
            renderer = MixedModeRenderer(self.figure, *size, dpi, vectors)
            self.figure.draw(renderer)
            renderer.finalize()
            text.detach()
