"""How far one picture is from another, told by squares of pixels, so that a shift by one pixel weighs little.

A picture is an array (height, width, channels) of bytes: one channel where all of it is grey, else three. A change is
largest over the channels, so that a red letter is as far from a black one as a blank.
"""

import io
from functools import lru_cache, reduce
from pathlib import Path

import numpy as np
from PIL import Image, ImageChops
from scipy.ndimage import maximum_filter, minimum_filter

GONE, ADDED, KEPT = (200, 80, 0), (0, 90, 200), (215, 215, 215)
"""Colours of ink in the picture of a difference: in the reference alone, in the new picture alone, in both."""
SQUARE = 4
"""Side in pixels of the squares that are compared, 0.17 mm in print."""
WIDE = 16
"""Side in squares of the wide squares, 2.7 mm in print."""
REACH = 4
"""Where letters may lie elsewhere, squares are compared with those up to 4 away, 0.68 mm in print."""
SPREAD = 5
"""A changed pixel is shown as wide as 5, so that no change is too fine to be seen."""
BEHIND = (255, 0, 255)
"""What shows through where a picture is transparent: a colour that no figure has."""


def colours(path) -> np.ndarray:
    """A PNG file as a picture that cannot be written to: who looks at the same file again gets the same one."""
    return _decoded(Path(path).read_bytes())


@lru_cache(maxsize=2)
def _decoded(content):
    """By what the file holds, not by its name: those of a figure and of its reference."""
    picture = of_png(content)
    picture.flags.writeable = False
    return picture


def of_png(content: bytes) -> np.ndarray:
    with Image.open(io.BytesIO(content)) as image:
        return of_image(image)


def of_image(image: Image.Image) -> np.ndarray:
    if image.mode == "L":
        return np.asarray(image)[..., None]
    seen = _over(image, BEHIND) if image.has_transparency_data else image.convert("RGB")
    red, green, blue = seen.split()
    if all(ImageChops.difference(red, other).getbbox() is None for other in (green, blue)):
        return np.asarray(red)[..., None]
    return np.asarray(seen)


def _over(image, colour):
    seen = image.convert("RGBA")
    if seen.getchannel("A").getextrema() != (255, 255):
        seen = Image.alpha_composite(Image.new("RGBA", seen.size, colour), seen)
    return seen.convert("RGB")


def squares(picture: np.ndarray, size: int) -> np.ndarray:
    """Mean of each square of size by size pixels, 0 black to 1 white; what is left over at the edges is white."""
    filled = _filled(picture, size, 255)
    kind = np.uint16 if picture.dtype == np.uint8 else np.float32  # has room for the sum of a square of 16 by 16 bytes
    rows = sum(filled[row::size].astype(kind) for row in range(size))
    return sum(rows[:, column::size] for column in range(size)) / np.float32(255 * size * size)


def smaller(picture: np.ndarray, size: int) -> np.ndarray:
    """The picture with each square of size by size pixels as one."""
    return np.round(255 * squares(picture, size)).astype(np.uint8)


def _filled(picture, size, value):
    """A picture with its height and width made multiples of a size."""
    height, width = (-length % size for length in picture.shape[:2])
    return np.pad(picture, [(0, height), (0, width), (0, 0)], constant_values=value) if height or width else picture


def change(reference: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Change (height, width) of the mean of each square, 0 to 1, between squares of two pictures of one shape."""
    return _over_channels(np.abs(new - reference))


def wide_change(reference: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Change of each wide square, in which lines weigh little and a background weighs much."""
    filled = _filled(new - reference, WIDE, 0.0)
    rows = sum(filled[row::WIDE] for row in range(WIDE))
    return _over_channels(np.abs(sum(rows[:, column::WIDE] for column in range(WIDE)))) / WIDE**2


def mean_change(reference: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Change of the mean of all squares: that of the background, where lines and shades move both ways."""
    return np.abs((new - reference).mean(axis=(0, 1))).max()


def near_change(reference: np.ndarray, new: np.ndarray) -> np.ndarray:
    """How much lighter than all, or darker than all, the squares around it in the other picture each square is.

    Programs that draw the same place letters and edges a little apart, which this forgives; what one has drawn and the
    other has not remains.
    """
    reference, new = np.broadcast_arrays(reference, new)
    reach = 2 * REACH + 1, 2 * REACH + 1, 1
    outside = [
        part
        for one, other in ((reference, new), (new, reference))
        for part in (one - maximum_filter(other, reach), minimum_filter(other, reach) - one)
    ]
    return _over_channels(reduce(np.maximum, outside))


def _over_channels(changes):
    """The largest; where there is one channel, without the search for it, which takes long."""
    return changes[..., 0] if changes.shape[-1] == 1 else changes.max(axis=-1)


def largest(changes: np.ndarray) -> float:
    return float(changes.max())


def share(changes: np.ndarray) -> float:
    """Share of the squares that change by more than half."""
    return float((changes > 0.5).mean())


def overlay(reference: np.ndarray, new: np.ndarray, size: int) -> np.ndarray:
    """Picture (height, width, 3) of what is gone, added and kept, on white, with squares of pixels as one."""
    reference, new = (picture.mean(axis=-1, keepdims=True, dtype=np.float32) for picture in (reference, new))
    kept = squares(np.maximum(reference, new), size)
    inks = [np.where(shift > 127, shift, 0) for shift in (new - reference, reference - new)]
    gone, added = (maximum_filter(1 - squares(255 - ink, size), (SPREAD, SPREAD, 1)) for ink in inks)
    paint = 255 - (1 - kept) * (255 - np.array(KEPT))
    for ink, colour in ((gone, GONE), (added, ADDED)):
        paint = (1 - ink) * paint + ink * np.array(colour)
    return np.round(paint).astype(np.uint8)


def png(picture: np.ndarray, effort: int = 9) -> bytes:
    """A picture as a PNG file, without loss: grey where it is, with a palette where that has room for its colours.

    effort: 0 to 9, time that is spent on making it small.
    """
    image = Image.fromarray(picture[..., 0] if picture.shape[-1] == 1 else picture)
    if image.mode == "RGB" and (used := image.getcolors(256)):
        image = _with_palette(picture, [colour for _, colour in used])
    content = io.BytesIO()
    image.save(content, "PNG", compress_level=effort)
    return content.getvalue()


def _with_palette(picture, used):
    weights = np.array([1 << 16, 1 << 8, 1])
    keys = np.array(used) @ weights
    order = np.argsort(keys)
    image = Image.fromarray(np.searchsorted(keys[order], picture @ weights).astype(np.uint8))
    image.putpalette([int(level) for at in order for level in used[at]])
    return image
