"""All results of the default build -> the page to open first."""

from pathlib import Path

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.html.figure_texts import figure_texts
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.results_page import page

with running(snakemake) as out:
    texts = figure_texts(ROOT, snakemake.params.config)
    titles = {name: text["title"] for name, text in texts.items() if "title" in text}
    Path(out.html).write_text(page(Path(snakemake.output.html).parent, titles), encoding="utf-8")
