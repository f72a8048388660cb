"""The figure check as one HTML page that reads offline: reference, new, difference and numbers of every figure."""

from pathlib import Path

from jinja2 import Environment

from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.check import PASSED, command, lines, ordered, share
from vibroimpact_pipeline.figure_check.tables import KINDS, UNITS
from vibroimpact_pipeline.report.policy import guarded

TEMPLATE = Path(__file__).with_name("page.html.j2")


def page(verdicts: list[dict], reference, build) -> str:
    """The page for verdicts of the figure check; reference, build: folders, as of `check.check`."""
    template = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True).from_string(
        TEMPLATE.read_text(encoding="utf-8")
    )
    return guarded(
        template.render(
            verdicts=ordered(verdicts),
            said=lines(verdicts),
            command=command,
            different=[verdict["figure"] for verdict in verdicts if verdict["status"] != PASSED],
            share=share,
            pictures={verdict["figure"]: _pictures(verdict, reference, build) for verdict in verdicts},
            kinds=KINDS,
            units=UNITS,
        )
    )


def _pictures(verdict, reference, build) -> dict[str, str]:
    """The pictures there are of a figure, by what they show: one if it has passed, which leaves no difference."""
    figure, found = verdict["figure"], {}
    for name, folder in (("reference", Path(reference)), ("new", Path(build) / "results/figures")):
        try:
            content = (folder / f"{figure}.png").read_bytes()
            if verdict["status"] == PASSED:
                return {"same": pictures.address(content)}
            found[name] = pictures.pixels(content)
        except Exception:
            continue  # the verdict says so, whatever the library has raised
    if len(found) == 2 and found["reference"].shape == found["new"].shape:
        found["difference"] = pictures.difference(**found)
    return {name: pictures.address(pictures.smaller(picture)) for name, picture in found.items()}
