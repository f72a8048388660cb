"""All figures against their references -> the verdicts as JSON and Markdown, and the page to read."""

import json

from job import running
from vibroimpact.figures.kit.files import replacing
from vibroimpact.figures.specs import made, specs
from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.figure_check.check import check_all, lines
from vibroimpact_pipeline.figure_check.page import page


def main(config: dict, reference, build, outputs: dict, processes: int = 1) -> None:
    """Compare, and write each of the outputs: page, verdicts, summary."""
    found = check_all(made(config, specs()), reference, build, processes)
    print(*lines(found), sep="\n")
    written = {
        "page": page(found, reference, build),
        "verdicts": json.dumps(found, indent=1, allow_nan=False) + "\n",
        "summary": "### Figure check\n\n" + "".join(f"- {line}\n" for line in lines(found)),
    }
    for name, text in written.items():
        with replacing(outputs[name]) as file:
            file.write_text(text, encoding="utf-8")


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.config, root_of(snakemake) / "figures", ".", dict(snakemake.output.items()), snakemake.threads)
