"""The PDF and the SVG of a figure, as libraries draw them that share no code with Matplotlib; letters of the PDF."""

import unicodedata
from collections import Counter
from functools import lru_cache

import matplotlib.style
import numpy as np
import pypdfium2
import resvg_py
from matplotlib.mathtext import MathTextParser

from vibroimpact.figures.kit.style import STYLE_FILE
from vibroimpact_pipeline.figure_check import pictures

DOTS = 150
"""Per inch: a pixel is a square of the PNG."""
FINER = 2
POINTS = 72
CSS_DOTS = 96
"""Of SVG, per inch."""


def drawn_pdf(path) -> np.ndarray:
    """The page of a PDF as a picture, made of one of more pixels: lines thinner than a pixel are drawn as wide as one.

    Raises:
        ValueError: no page, or more than one.
    """
    with pypdfium2.PdfDocument(path) as document:
        bitmap = _page(document).render(scale=FINER * DOTS / POINTS, rev_byteorder=True)
        return pictures.smaller(pictures.of_image(bitmap.to_pil()), FINER)


def drawn_svg(path) -> np.ndarray:
    """An SVG as a picture; what is transparent is seen as in a PNG."""
    drawn = resvg_py.svg_to_bytes(svg_path=str(path), dpi=CSS_DOTS, zoom=DOTS / CSS_DOTS, skip_system_fonts=True)
    return pictures.of_png(drawn)


DRAWN = {"pdf": drawn_pdf, "svg": drawn_svg}


def letters_of_pdf(path) -> Counter:
    """The letters on the page of a PDF, without blanks."""
    with pypdfium2.PdfDocument(path) as document:
        return _letters(_page(document).get_textpage().get_text_range())


def _page(document):
    if len(document) != 1:
        raise ValueError(f"{len(document)} pages instead of 1")
    return document[0]


def letters_of_texts(texts) -> Counter:
    """The letters that texts of a figure are set in, formulas too, without blanks."""
    lines = (line for text in texts for line in text.split("\n"))
    return _letters("".join(_set_formula(line) if _is_formula(line) else line for line in lines))


@lru_cache
def _set_formula(line):
    with matplotlib.style.context(STYLE_FILE, after_reset=True):
        return "".join(chr(glyph[2]) for glyph in MathTextParser("path").parse(line, POINTS).glyphs)


def _is_formula(line):
    """Whether Matplotlib sets a line as a formula: where its dollar signs, those with a backslash aside, are paired."""
    dollars = line.count("$") - line.count("\\$")
    return dollars > 0 and dollars % 2 == 0


def _letters(characters):
    return Counter(letter for letter in characters if not (letter.isspace() or unicodedata.category(letter) == "Cc"))


def texts_of(artists) -> list[str]:
    """All texts of a description of artists that are drawn: names of artists are not, but for those in legends."""
    if isinstance(artists, list):
        return [text for part in artists for text in texts_of(part)]
    if not isinstance(artists, dict):
        return []
    found = []
    for key, entry in artists.items():
        if key in ("ticks", "minor ticks"):
            found += entry
        elif key == "entries":
            found += [each["name"] for each in entry]
        elif key == "text":
            found.append(entry)
        else:
            found += texts_of(entry)
    return found
