"""How far one picture is from another, told by squares of pixels, so that a shift by one pixel weighs little."""

import io

import numpy as np
from PIL import Image
from scipy.ndimage import maximum_filter

GONE, ADDED, KEPT = (200, 80, 0), (0, 90, 200), (215, 215, 215)
"""Colours of ink in the picture of a difference: in the reference alone, in the new picture alone, in both."""
SQUARE = 4
"""Side in pixels of the squares that are compared, 0.17 mm in print."""
SPREAD = 5
"""A changed pixel is shown as wide as 5, so that no change is too fine to be seen."""


def grey(path) -> np.ndarray:
    """A PNG file as (height, width) of grey levels, 0 black to 1 white."""
    with Image.open(path) as picture:
        return np.asarray(picture.convert("L"), np.float32) / np.float32(255)


def squares(picture: np.ndarray, size: int) -> np.ndarray:
    """Mean of each square of size by size pixels; what is left over at the right and lower edges is white."""
    height, width = (-(-length // size) * size for length in picture.shape)
    padded = Image.new("F", (width, height), 1.0)
    padded.paste(Image.fromarray(picture.astype(np.float32, copy=False)))
    return np.asarray(padded.reduce(size))


def largest_change(reference: np.ndarray, new: np.ndarray) -> float:
    """Largest change of a square's mean grey, 0 to 1, between pictures of the same shape."""
    return float(_change(reference, new).max())


def share_changed(reference: np.ndarray, new: np.ndarray) -> float:
    """Share of the squares whose mean grey changes by more than half between pictures of the same shape."""
    return float((_change(reference, new) > 0.5).mean())


MEASURES = {"drawn": largest_change, "simulated": share_changed}
SAID = {
    "drawn": f"a square of {SQUARE} pixels changes by {{:.2g}} of grey",
    "simulated": f"{{:.2g}} of all squares of {SQUARE} pixels change by more than half of grey",
}
"""How far a picture is from its reference: where lines follow from theory, and where they follow from simulation."""


def _change(reference, new):
    return np.abs(squares(new, SQUARE) - squares(reference, SQUARE))


def overlay(reference: np.ndarray, new: np.ndarray, size: int) -> np.ndarray:
    """Picture (height, width, 3) of what is gone, added and kept, on white, with squares of pixels as one."""
    kept = squares(np.maximum(reference, new), size)
    gone, added = (maximum_filter(1 - squares(1 - change, size), SPREAD) for change in _changes(reference, new))
    paint = 255 - (1 - kept)[..., None] * (255 - np.array(KEPT))
    for ink, colour in ((gone, GONE), (added, ADDED)):
        paint = (1 - ink[..., None]) * paint + ink[..., None] * np.array(colour)
    return np.round(paint).astype(np.uint8)


def _changes(reference, new):
    """Ink in one picture alone, 0 to 1, where it is more than half black."""
    return [np.where(change > 0.5, change, 0.0) for change in (new - reference, reference - new)]


def png(picture: np.ndarray) -> bytes:
    """A picture, grey levels 0 to 1 or colours 0 to 255, as a small PNG file."""
    pixels = picture if picture.dtype == np.uint8 else np.round(255 * picture).astype(np.uint8)
    content = io.BytesIO()
    Image.fromarray(pixels).save(content, "PNG")
    return content.getvalue()
