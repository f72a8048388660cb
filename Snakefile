# Let `snakemake` find the pipeline. The method `include` is used, because the directive `include:` would not take over
# the default target.

workflow.include("workflow/Snakefile", overwrite_default_target=True)
