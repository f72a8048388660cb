# Let `snakemake` find the pipeline. The directive `include:` would not take over the default target.

workflow.include("workflow/Snakefile", overwrite_default_target=True)
