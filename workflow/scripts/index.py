"""Write the index page of the results, with the figures of the chapter, of speed and accuracy, and of studies."""

from pathlib import Path

from vibroimpact_pipeline.html.figure_texts import figure_texts
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.results_page import page

with running(snakemake) as out:
    texts = figure_texts(snakemake.params.config)
    chapter, results = snakemake.params.config["figures"], Path(snakemake.output.html).parent
    groups = {
        "The chapter": {name: texts[name]["title"] for name in chapter},
        "Speed and accuracy": {name: texts[name]["title"] for name in snakemake.params.charts},
        "Studies": snakemake.params.studies,
    }
    Path(out.html).write_text(page(results, groups), encoding="utf-8")
