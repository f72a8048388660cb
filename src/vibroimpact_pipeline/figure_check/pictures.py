"""Pictures drawn from tables, and their comparison: pixels of PNG, sums of SVG and PDF."""

import base64
import hashlib
import io
import re
import zlib
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.ndimage import minimum_filter

from vibroimpact.figures.kit import style
from vibroimpact.figures.kit.versions import drawn_with

KINDS = "png", "pdf", "svg"
DECIMALS = 3
"""To which numbers in PDF and SVG are rounded, in points: their last digits follow from the layout, which another
processor may round otherwise; a thousandth of a point is a hundredth of a pixel."""
SHRINK, SPREAD = 2, 3
"""The page shows squares of so many pixels as one, and a changed pixel as wide as so many of these."""


def environment() -> dict[str, str]:
    """Return the versions of all libraries that determine a picture."""
    return {**drawn_with(), "numpy": version("numpy"), "pillow": version("pillow")}


def draw(module: str, tables: dict, figure: str, folder) -> dict[str, Path]:
    """Draw a figure from its tables with its module; return the files by kind."""
    files = {kind: Path(folder) / f"{figure}.{kind}" for kind in KINDS}
    style.save(style.drawn(import_module(f"vibroimpact.figures.{module}"), tables), files)
    return files


def pixels(content: bytes) -> np.ndarray:
    """Return the RGBA values of a PNG file, (height, width, 4).

    Raises:
        OSError: it is none.
    """
    with Image.open(io.BytesIO(content), formats=["PNG"]) as picture:
        return np.asarray(picture.convert("RGBA"))


def sums(files: dict[str, Path]) -> dict[str, str]:
    """Return the SHA-256 of each file without metadata and compression."""
    return {kind: hashlib.sha256(SHOWN[kind](path.read_bytes())).hexdigest() for kind, path in files.items()}


def _png(content):
    shown = pixels(content)
    return str(shown.shape).encode() + shown.tobytes()


def _svg(content):
    """Return the text of an SVG without metadata; embedded pictures count by their pixels."""
    content = re.sub(rb"<metadata>.*?</metadata>", b"", content, flags=re.DOTALL)
    embedded = re.compile(rb"data:image/png;base64,\s*([^\"]+)")
    return _rounded(embedded.sub(lambda found: _png(base64.b64decode(found[1])).hex().encode(), content))


def _pdf(content):
    """Return the unpacked objects of a PDF, without document information, lengths and cross-reference table."""
    objects = dict(re.findall(rb"(?ms)^(\d+) 0 obj\s(.*?)\sendobj$", content))
    (info,) = re.findall(rb"/Info (\d+) 0 R", content)
    shown = [body for number, body in objects.items() if number != info and not body.strip().isdigit()]
    return b"\n".join(_unpacked(body) for body in shown)


def _unpacked(body):
    head, opened, stream = body.partition(b"stream\n")
    if opened and b"/FlateDecode" in head:
        stream = zlib.decompressobj().decompress(stream)
    return head + opened + _rounded(stream)


def _rounded(content):
    return re.sub(rb"\d+\.\d{4,}", lambda found: b"%.*f" % (DECIMALS, float(found[0])), content)


SHOWN = {"png": _png, "pdf": _pdf, "svg": _svg}


def small(picture: np.ndarray) -> bytes:
    """Return a picture (height, width, 4) as a small lossless PNG file: without alpha, or grey, where possible."""
    opaque, grey = (picture[..., 3] == 255).all(), (picture[..., :3] == picture[..., :1]).all()
    content = io.BytesIO()
    Image.fromarray(picture).convert("RGBA" if not opaque else "L" if grey else "RGB").save(
        content, "PNG", optimize=True
    )
    return content.getvalue()


def smaller(picture: np.ndarray) -> bytes:
    """Return a picture (height, width, channels) as a PNG file of reduced size for a page."""
    content = io.BytesIO()
    Image.fromarray(picture).reduce(SHRINK).save(content, "PNG")
    return content.getvalue()


def address(png: bytes) -> str:
    """Return the content of a PNG file as a data: URL."""
    return "data:image/png;base64," + base64.b64encode(png).decode()


def difference(reference: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Return both pictures overlaid in pale grey, with removed ink in orange and added ink in blue."""
    before, after = (picture[..., :3].min(axis=-1).astype(int) for picture in (reference, new))
    paint = np.stack([255 - (255 - np.minimum(before, after)) // 5] * 3, axis=-1).astype(np.uint8)
    for ink, colour in ((after - before, (200, 80, 0)), (before - after, (0, 90, 200))):
        paint[minimum_filter(np.where(ink > 0, 0, 1), SPREAD * SHRINK) == 0] = colour
    return paint
