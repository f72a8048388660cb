"""Write the data package of a build, which describes every column of every table."""

import csv
import json
from pathlib import Path

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.data_dictionary import files, read
from vibroimpact_pipeline.datapackage import data_package
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.specs import spec_of

import yaml


def header(path):
    """Return the column names of a CSV file."""
    with open(path, encoding="utf-8", newline="") as table:
        return next(csv.reader(table))


with running(snakemake) as out:
    specs, data = read(ROOT)
    made = {figure: spec_of(figure, scene, specs) for figure, scene in snakemake.params.figures.items()}
    cited = yaml.safe_load(Path(snakemake.input.citation).read_text(encoding="utf-8"))
    build = snakemake.output.json.removesuffix("results/datapackage.json")  # prefix, if a module has one
    headers = {path.removeprefix(build): header(path) for path in snakemake.input if path.endswith(".csv")}
    package = data_package(headers, files(specs | made, data), data["units"], cited)
    text = json.dumps(package, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    Path(out.json).write_text(text, encoding="utf-8")
