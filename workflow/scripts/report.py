"""Results -> the report: a site that reads offline, and a PDF."""

import json
import shutil
from pathlib import Path

import yaml

from vibroimpact.claims.judge import NOT_JUDGED
from vibroimpact.figures.kit.markdown import plain
from vibroimpact_pipeline.chapter import departures
from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.git import git
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.report.offline import linked
from vibroimpact_pipeline.report.pages import Pages, anchor
from vibroimpact_pipeline.report.results import Results
from vibroimpact_pipeline.report.site import write

SETTINGS = "report/report.yaml"


def collect(results, figure: str, folder: Path) -> None:
    """Copy the files of a figure and its notebook into the report."""
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
    """Return commit and date of the checkout, if git knows them."""
    described = git("describe", "--always", "--dirty=, with changes", root=root)
    if described is None:
        return "a copy without its history"
    return f"commit {described} of {git('show', '--no-patch', '--format=%cs', root=root)}"


def groups(figures: list[str], config: dict) -> dict[str, list[str]]:
    """Return the figures of the report in groups, in the order of display."""
    chapter = [figure for figure in figures if figure.startswith("fig10_")]
    companions = [figure for figure in figures if figure.startswith("companion_")]
    return {
        "chapter": chapter,
        "own": [figure for figure in figures if figure not in chapter + companions],
        "companions": companions,
        "accuracy": ["work_precision", "hazards"],
        "models": ["scene_models"],
        "animations": list(config["report"]["animations"]),
        "force_sweep": ["force_sweep"],
    }


with running(snakemake) as out:
    params, folder = snakemake.params, Path(out.site)
    results_folder = Path(snakemake.output.site).parent
    settings = yaml.safe_load((ROOT / SETTINGS).read_text(encoding="utf-8"))
    judged = all(claim["verdict"] != NOT_JUDGED for claim in json.loads((results_folder / "claims.json").read_text()))
    results, shown = Results(results_folder, judged), groups(params.figures, params.config)
    tables = [*("results/fixed_points.csv", "results/orbits.csv", "results/claims.json"), *params.tables]
    for figure in (figure for group in shown.values() for figure in group):
        collect(results, figure, folder)
    for picture in (ROOT / "docs").glob("*.png"):
        copy(picture, folder / "figures")
    for table in tables:
        copy(results_folder / Path(table).relative_to("results"), folder / "data")
    pages = Pages(ROOT, results, settings, params.config, shown, tables, departures(params.config))
    write(folder, ROOT, pages, settings, f"Built from {plain(version(ROOT))}.")
