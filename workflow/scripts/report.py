"""Results -> the report: a site that reads offline, and a PDF."""

import shutil
from pathlib import Path

import yaml

from job import running
from vibroimpact.figures.kit.markdown import plain
from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.git import git
from vibroimpact_pipeline.report.offline import linked
from vibroimpact_pipeline.report.pages import Pages, anchor
from vibroimpact_pipeline.report.results import Results
from vibroimpact_pipeline.report.site import write

SETTINGS = "report/report.yaml"


def main(root, results, shown: dict, tables, config: dict, departures: list[str], judged: bool, folder) -> None:
    """Write the report into a new folder.

    Args:
        root: the checkout.
        results: directory of the results.
        shown: names of figures by group.
        tables: paths of further results to download.
        config: of the pipeline.
        departures: where it departs from the chapter's parameters, a line each.
        judged: whether the claims have been judged.
    """
    settings = yaml.safe_load((Path(root) / SETTINGS).read_text(encoding="utf-8"))
    results, folder = Results(results, judged), Path(folder)
    for group in shown.values():
        for figure in group:
            collect(results, figure, folder)
    for table in tables:
        copy(table, folder / "data")
    shutil.copytree(results.root / "api", folder / "api")
    pages = Pages(root, results, settings, config, shown, tables, departures)
    write(folder, root, pages, settings, f"Built from {plain(version(root))}.")


def collect(results, figure: str, folder: Path) -> None:
    """Copy the files of a figure, and the notebook that made it, into the report."""
    for path in results.files(figure).values():
        copy(path, folder / "figures")
    if notebook := results.notebook(figure):
        text = linked(notebook.read_text(encoding="utf-8"), f"../figures.html#{anchor(figure)}")
        (folder / "notebooks").mkdir(exist_ok=True)
        (folder / "notebooks" / notebook.name).write_text(text, encoding="utf-8")


def copy(path, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(path, folder)


def version(root) -> str:
    """The commit of the checkout and its date, as far as git tells."""
    described = git("describe", "--always", "--dirty=, with changes", root=root)
    if described is None:
        return "a copy without its history"
    return f"commit {described} of {git('show', '--no-patch', '--format=%cs', root=root)}"


if "snakemake" in globals():
    with running(snakemake):
        params, tables, folder = snakemake.params, snakemake.input.tables, Path(snakemake.output[0])
        root, results = root_of(snakemake), folder.parent
        main(root, results, params.shown, tables, params.config, params.departures, params.judged, folder)
