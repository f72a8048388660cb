# `snakemake` in this directory finds the pipeline. Included by hand, since `include:` leaves its default target behind.

workflow.include("workflow/Snakefile", overwrite_default_target=True)
