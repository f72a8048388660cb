"""Draw pictures from tables, and compute checksums of picture files.

The checksum of a PNG covers its pixels. The checksum of an SVG or a PDF covers its content without metadata.
"""

import base64
import hashlib
import io
import re
import zlib
from importlib import import_module
from pathlib import Path

from PIL import Image

from vibroimpact.figures.plotting import style

KINDS = "png", "pdf", "svg"
DECIMALS = 3
"""Number of decimals to which lengths in PDF and SVG [points] are rounded before the checksum is computed. Further
digits depend on how the processor rounds the layout. 0.001 points are about a hundredth of a pixel."""
OFFSET = 0.000_314_159
"""Number that is added before rounding. Without it, lengths such as 0.8125 lie half-way between two rounded values, so
that their last digits, which depend on the processor, decide which one results."""


def draw(module: str, tables: dict, figure: str, folder) -> dict[str, Path]:
    """Draw a figure from its tables as PNG, PDF and SVG; return the paths of these files by kind."""
    files = {kind: Path(folder) / f"{figure}.{kind}" for kind in KINDS}
    style.save(style.draw_tables(import_module(module), tables), files)
    return files


def load_png(content: bytes) -> Image.Image:
    """Return the RGBA image in a PNG file.

    Raises
    ------
    OSError
        If the content is not a PNG file.
    """
    with Image.open(io.BytesIO(content), formats=["PNG"]) as opened:
        return opened.convert("RGBA")


def small(content: bytes) -> bytes:
    """Return a PNG file with the same pixels and without metadata.

    If the picture is opaque, the file has no alpha channel. If the picture is also grey, the file has grey levels only.
    """
    shown, smaller = load_png(content), io.BytesIO()
    modes = (shown.convert(mode) for mode in ("L", "RGB"))
    fits = (one for one in modes if one.convert("RGBA").tobytes() == shown.tobytes())
    next(fits, shown).save(smaller, "PNG", optimize=True)
    return smaller.getvalue()


def sums(files: dict[str, Path]) -> dict[str, str]:
    """Return the SHA-256 of each file by kind.

    Metadata, compression and the last digits of numbers have no effect on the SHA-256.
    """
    return {kind: hashlib.sha256(COMPARED_CONTENT[kind](path.read_bytes())).hexdigest() for kind, path in files.items()}


def _png(content):
    shown = load_png(content)
    return str((*shown.size[::-1], 4)).encode() + shown.tobytes()


def _svg(content):
    """Return the text of an SVG without metadata and with rounded numbers.

    Each embedded PNG is replaced by its pixels.
    """
    content = re.sub(rb"<metadata>.*?</metadata>", b"", content, flags=re.DOTALL)
    embedded = re.compile(rb"data:image/png;base64,\s*([^\"]+)")
    return _rounded(embedded.sub(lambda found: _png(base64.b64decode(found[1])).hex().encode(), content))


def _pdf(content):
    """Return the decompressed objects of a PDF with rounded numbers, without document metadata and stream lengths."""
    objects = dict(re.findall(rb"(?ms)^(\d+) 0 obj\s(.*?)\sendobj$", content))
    (info,) = re.findall(rb"/Info (\d+) 0 R", content)
    parts = []
    for body in (body for number, body in objects.items() if number != info and not body.strip().isdigit()):
        head, opened, stream = body.partition(b"stream\n")
        if opened and b"/FlateDecode" in head:
            stream = zlib.decompressobj().decompress(stream)
        parts.append(head + opened + _rounded(stream))
    return b"\n".join(parts)


def _rounded(content):
    return re.sub(rb"\d+\.\d{4,}", lambda found: b"%.*f" % (DECIMALS, float(found[0]) + OFFSET), content)


COMPARED_CONTENT = {"png": _png, "pdf": _pdf, "svg": _svg}
