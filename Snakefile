# `snakemake` in this directory finds the pipeline by this file. The method `include` is used instead of the directive
# `include:`, which would not take over the default target.

workflow.include("workflow/Snakefile", overwrite_default_target=True)
