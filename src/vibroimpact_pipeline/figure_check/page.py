"""Make the offline HTML page of the figure check, with the pictures and distances of each figure."""

import base64
import io
from contextlib import suppress
from pathlib import Path

from PIL import ImageChops, ImageFilter

from vibroimpact_pipeline.figure_check import check, pictures
from vibroimpact_pipeline.figure_check.table_distances import KINDS
from vibroimpact_pipeline.html.policy import rendered

TEMPLATE = Path(__file__).with_name("page.html.j2")
SPREAD = 7
"""Width to which a changed pixel is enlarged to make it visible [pixels]."""


def page(verdicts: list[dict], reference, build) -> str:
    """Return the page for the verdicts.

    `reference` is the folder of the reference set, and `build` is the folder that contains results/.
    """
    shown = {verdict["figure"]: _pictures(verdict, reference, build) for verdict in verdicts}
    return rendered(TEMPLATE, verdicts=check.ordered(verdicts), shown=shown, check=check, kinds=KINDS)


def _pictures(verdict, reference, build):
    """Return the reference picture, the new picture and their difference as data URLs, by name.

    If the figure passed, return only the reference picture.
    """
    files, shown = {}, []
    for name, folder in (("Reference", Path(reference)), ("New", (Path(build) / verdict["stem"]).parent)):
        with suppress(Exception):  # the verdict reports unreadable files
            content = (folder / f"{verdict['figure']}.png").read_bytes()
            shown.append(pictures.load_png(content))
            files[name] = content
        if verdict["status"] == check.PASSED:
            break
    if len(files) == 2:
        files["Difference"] = difference(*shown)
    return {name: "data:image/png;base64," + base64.b64encode(content).decode() for name, content in files.items()}


def difference(old, new) -> bytes:
    """Return a PNG that is dark where two pictures differ, and white where they agree.

    If one picture is larger, the part that extends beyond the other picture is not shown.
    """
    changed = ImageChops.difference(old.convert("RGB"), new.convert("RGB"))
    content = io.BytesIO()
    ImageChops.invert(changed).filter(ImageFilter.MinFilter(SPREAD)).save(content, "PNG")
    return content.getvalue()
