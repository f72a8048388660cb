"""How far one picture is from another, told by squares of pixels, so that a shift by one pixel weighs little."""

import io

import numpy as np
from PIL import Image

GONE, ADDED, KEPT = (200, 80, 0), (0, 90, 200), (215, 215, 215)
"""Colours of ink in the picture of a difference: in the reference alone, in the new picture alone, in both."""


def grey(path) -> np.ndarray:
    """A PNG file as (height, width) of grey levels, 0 black to 1 white."""
    with Image.open(path) as picture:
        return np.asarray(picture.convert("L"), float) / 255


def squares(picture: np.ndarray, size: int) -> np.ndarray:
    """Mean of each square of size by size pixels; what is left over at the right and lower edges is white."""
    height, width = (-(-length // size) * size for length in picture.shape)
    padded = np.ones((height, width))
    padded[: picture.shape[0], : picture.shape[1]] = picture
    return padded.reshape(height // size, size, width // size, size).mean(axis=(1, 3))


def distance(reference: np.ndarray, new: np.ndarray, size: int) -> float:
    """Largest change of a square's mean grey, 0 to 1, between pictures of the same shape."""
    return float(np.abs(squares(new, size) - squares(reference, size)).max())


def overlay(reference: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Picture (height, width, 3) of what is gone, added and kept, on white."""
    old_ink, new_ink = (1 - picture[..., None] for picture in (reference, new))
    kept = np.minimum(old_ink, new_ink)
    paint = 255.0 - np.zeros(3)
    for ink, colour in ((kept, KEPT), (old_ink - kept, GONE), (new_ink - kept, ADDED)):
        paint = paint - ink * (255 - np.array(colour))
    return np.clip(paint, 0, 255).astype(np.uint8)


def png(picture: np.ndarray) -> bytes:
    """A picture, grey levels 0 to 1 or colours 0 to 255, as a small PNG file."""
    pixels = picture if picture.dtype == np.uint8 else np.round(255 * picture).astype(np.uint8)
    content = io.BytesIO()
    Image.fromarray(pixels).save(content, "PNG", optimize=True)
    return content.getvalue()
