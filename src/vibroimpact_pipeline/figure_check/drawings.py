"""The pictures of a figure: the PNG against that of its reference, its PDF and SVG against the PNG beside them."""

import numpy as np

from vibroimpact_pipeline.figure_check import pictures, vector_files
from vibroimpact_pipeline.figure_check.verdicts import FAILED, NOT_COMPARABLE, PASSED

MAPS = {
    "square": pictures.change,
    "wide square": pictures.wide_change,
    "whole picture": pictures.mean_change,
    "surroundings": pictures.near_change,
}
OVER = {"largest": pictures.largest, "share": pictures.share}
DRAWN, SIMULATED = "drawn", "simulated"


def kind_of(figure: str, limits: dict) -> str:
    """Whether the lines of a figure follow from theory, or from chaotic motions."""
    return SIMULATED if figure in limits["simulated"] else DRAWN


def compare(figure: str, reference, new, vectors: dict, same_versions: bool, limits: dict) -> tuple[dict, list[str]]:
    """What the pictures say: a status, each measure with its distance and limit, and reasons, one line each.

    Args:
        reference, new: PNG files.
        vectors: the PDF and the SVG by kind.
        same_versions: whether both PNG files were drawn by the same versions.
        limits: part "picture" of tolerances.yaml.
    """
    old_squares, new_squares = (_squares(path) for path in (reference, new))
    measures, reasons = [], []
    if old_squares.shape[:2] != new_squares.shape[:2]:
        reasons.append(f"picture: {_size(new_squares)} instead of {_size(old_squares)}")
    else:
        applied = limits["versions"]["same" if same_versions else "other"][kind_of(figure, limits)]
        measures += [_measured("png", name, old_squares, new_squares, limits) for name in applied]
    for kind, path in vectors.items():
        try:
            drawn = vector_files.DRAWN[kind](path) / np.float32(255)
        except Exception as error:
            reasons.append(f"{kind}: unreadable: {' '.join(str(error).split())}")
            continue
        if not np.allclose(drawn.shape[:2], new_squares.shape[:2], rtol=0, atol=1):
            reasons.append(f"{kind}: {_size(drawn)} instead of {_size(new_squares)}, the size of the PNG")
        else:
            height, width = np.minimum(drawn.shape, new_squares.shape)[:2] - 1  # a page may end within a pixel
            parts = [squares[:height, :width] for squares in (new_squares, drawn)]
            measures += [_measured(kind, name, *parts, limits) for name in limits["vectors"]]
    for entry in measures:
        if not entry["distance"] <= entry["limit"]:
            said = limits["measures"][entry["measure"]]["said"].format(entry["distance"])
            reasons.append(f"{WHAT[entry['file']]}: {said}, limit {entry['limit']:g}")
    status = FAILED if reasons else PASSED if same_versions else NOT_COMPARABLE
    return {"status": status, "measures": measures}, reasons


WHAT = {"png": "picture", "pdf": "pdf, against the PNG", "svg": "svg, against the PNG"}


def _squares(path):
    return pictures.squares(pictures.colours(path), pictures.SQUARE)


def _measured(file, name, old, new, limits):
    entry = limits["measures"][name]
    far = OVER[entry["over"]](MAPS[entry["of"]](old, new))
    return {"file": file, "measure": name, "distance": far, "limit": entry["limit"]}


def _size(squares):
    """As printed."""
    height, width = (length * 25.4 / vector_files.DOTS for length in squares.shape[:2])
    return f"{width:.0f} x {height:.0f} mm"
