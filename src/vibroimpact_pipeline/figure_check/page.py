"""The figure check as one offline HTML page: reference, new picture, difference and numbers of every figure."""

from pathlib import Path

from jinja2 import Environment

from vibroimpact_pipeline.figure_check import check, pictures, tables
from vibroimpact_pipeline.report.policy import guarded

TEMPLATE = Path(__file__).with_name("page.html.j2")


def page(verdicts: list[dict], reference, build) -> str:
    """Return the page for verdicts of the figure check; `reference` and `build` are folders, as in `check.check`."""
    environment = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    template = environment.from_string(TEMPLATE.read_text(encoding="utf-8"))
    shown = {verdict["figure"]: _pictures(verdict, reference, build) for verdict in verdicts}
    return guarded(template.render(verdicts=check.ordered(verdicts), shown=shown, check=check, tables=tables))


def _pictures(verdict, reference, build) -> dict[str, str]:
    """Return the pictures of a figure by caption: one if it has passed, since nothing differs."""
    figure, found = verdict["figure"], {}
    for name, folder in (("reference", Path(reference)), ("new", Path(build) / "results/figures")):
        try:
            content = (folder / f"{figure}.png").read_bytes()
            if verdict["status"] == check.PASSED:
                return {"same": pictures.address(content)}
            found[name] = pictures.pixels(content)
        except Exception:
            continue  # the verdict says so, whatever the library has raised
    if len({picture.shape for picture in found.values()}) == 1 and len(found) == 2:
        found["difference"] = pictures.difference(**found)
    return {name: pictures.address(pictures.smaller(picture)) for name, picture in found.items()}
