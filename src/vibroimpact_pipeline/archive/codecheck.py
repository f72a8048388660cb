"""The manifest of a CODECHECK (codecheck.org.uk): every figure with the command that makes it."""

import yaml

from vibroimpact_pipeline.archive.citation import Citation
from vibroimpact_pipeline.archive.figures import Figure

CODECHECK = "codecheck.yml"
SPECIFICATION = "https://codecheck.org.uk/spec/config/1.0/"
TIMED = "It shows run times, which differ from run to run."
SAME = "On a processor like the one it was made on the file comes out the same, byte for byte."


def codecheck(figures: list[Figure], texts: dict[str, dict], cited: Citation) -> dict:
    """The entries of codecheck.yml.

    Args:
        figures: those of the build.
        texts: what is said of each figure, see `report.figure_texts`.
        cited: what the checkout says of itself.
    """
    chapter = cited.chapter()
    return {
        "version": SPECIFICATION,
        "paper": {"title": chapter["title"], "authors": chapter["authors"], "reference": chapter["section"]},
        "source": f"{cited.project['name']} {cited.project['version']}, a replication by "
        + ", ".join(author["name"] for author in cited.authors()),
        "manifest": [_entry(figure, texts[figure.name]["title"]) for figure in figures],
    }


def command(figure: str) -> str:
    """What makes a figure and what it needs, also where it is there already."""
    return f"snakemake --cores 2 --forcerun {figure} -- {figure}"


def _entry(figure, title):
    return {
        "file": figure.picture,
        "comment": f"{title}. {TIMED if figure.timed else SAME}",
        "command": command(figure.name),
    }


def page(figures: list[Figure], texts: dict[str, dict], cited: Citation) -> str:
    """The text of codecheck.yml."""
    return "---\n" + yaml.safe_dump(codecheck(figures, texts, cited), sort_keys=False, allow_unicode=True, width=120)
