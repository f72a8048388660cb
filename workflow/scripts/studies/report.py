"""Build the report from results. The report is an offline website with an article as PDF."""

import json
import shutil
from pathlib import Path

from vibroimpact_pipeline.chapter import departures
from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.git import GitRefused, git
from vibroimpact_pipeline.html.offline import linked
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.studies.report.pages import Pages, anchor
from vibroimpact_pipeline.studies.report.results import Results
from vibroimpact_pipeline.studies.report.site import write

from vibroimpact.studies.claims.judge import NOT_JUDGED


def collect(results, figures, tables, folder: Path) -> None:
    """Copy figures, their notebook pages and further tables to the folder of the report."""
    for part in ("figures", "notebooks", "data"):
        (folder / part).mkdir(parents=True)
    for figure in figures:
        for path in results.files(figure).values():
            shutil.copy(path, folder / "figures")
        if notebook := results.notebook(figure):
            text = linked(notebook.read_text(encoding="utf-8"), f"../figures.html#{anchor(figure).replace('_', '-')}")
            (folder / "notebooks" / notebook.name).write_text(text, encoding="utf-8")
    for table in tables:
        shutil.copy(results.root / Path(table).relative_to("results"), folder / "data")


def version(root) -> str:
    """Return a text with commit and date of the checkout, or with the reason why the commit is unknown."""
    try:
        described = git("describe", "--always", "--dirty=, with uncommitted changes", root=root)
    except GitRefused:
        return "a copy whose git history is not readable"
    if described is None:
        return "a copy without git history"
    return f"commit {described} of {git('show', '--no-patch', '--format=%cs', root=root)}"


def groups(figures: list[str], charts: list[str]) -> dict[str, list[str]]:
    """Return the figures of the report by group, in the order of display."""
    chapter = [figure for figure in figures if figure.startswith("fig10_")]
    companions = [figure for figure in figures if figure.startswith("companion_")]
    return {
        "chapter": chapter,
        "own": [figure for figure in figures if figure not in (*chapter, *companions, "nudge")],
        "companions": companions,
        "accuracy": list(charts),
        "nudge": [figure for figure in figures if figure == "nudge"],
    }


with running(snakemake) as out:
    params, folder, root = snakemake.params, Path(out.site), Path(snakemake.output.site).parent
    claims = json.loads((root / "claims.json").read_text(encoding="utf-8"))
    results = Results(root, judged=all(claim["verdict"] != NOT_JUDGED for claim in claims))
    shown = groups(params.figures, params.charts)
    tables = [*("results/fixed_points.csv", "results/orbits.csv", "results/claims.json"), *params.tables]
    pages = Pages(ROOT, results, params.config, shown, [Path(table).name for table in tables])
    collect(results, pages.pictures, tables, folder)
    write(folder, ROOT, pages, version(ROOT), departures(params.config))
