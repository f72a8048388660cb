"""The figure check as one offline HTML page: reference, new picture, difference and numbers of every figure."""

import base64
import io
from contextlib import suppress
from pathlib import Path

from jinja2 import Environment
from PIL import ImageChops, ImageFilter

from vibroimpact_pipeline.figure_check import check, pictures
from vibroimpact_pipeline.figure_check.table_distances import KINDS
from vibroimpact_pipeline.html.policy import guarded

TEMPLATE = Path(__file__).with_name("page.html.j2")
SPREAD = 7
"""Width in pixels of the mark of a changed one, which a page would not show at its own size."""


def page(verdicts: list[dict], reference, build) -> str:
    """Return the page for verdicts of the figure check; `reference` and `build` are folders, as in `check.check`."""
    environment = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    template = environment.from_string(TEMPLATE.read_text(encoding="utf-8"))
    shown = {verdict["figure"]: _pictures(verdict, reference, build) for verdict in verdicts}
    return guarded(template.render(verdicts=check.ordered(verdicts), shown=shown, check=check, kinds=KINDS))


def _pictures(verdict, reference, build):
    """Return reference, new picture and difference as PNG files; of a figure that has passed the reference alone."""
    files, shown = {}, []
    for name, folder in (("Reference", Path(reference)), ("New", (Path(build) / verdict["stem"]).parent)):
        with suppress(Exception):  # the verdict says so, whatever the library raises
            content = (folder / f"{verdict['figure']}.png").read_bytes()
            shown.append(pictures.picture(content))
            files[name] = content
        if verdict["status"] == check.PASSED:
            break
    if len(files) == 2:
        files["Difference"] = difference(*shown)
    return {name: "data:image/png;base64," + base64.b64encode(content).decode() for name, content in files.items()}


def difference(old, new) -> bytes:
    """Return a PNG file, white where two pictures are alike and dark where not; of two sizes, the part of both."""
    unlike = ImageChops.difference(old.convert("RGB"), new.convert("RGB"))
    content = io.BytesIO()
    ImageChops.invert(unlike).filter(ImageFilter.MinFilter(SPREAD)).save(content, "PNG")
    return content.getvalue()
