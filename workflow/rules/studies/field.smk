# Compare a published program with exact orbits: snakemake field. This rule is not part of the default build. It runs the
# program CC by Weidemann et al. (2025) in Octave from the folder in the environment variable CC_PROGRAM
# (docs/studies/field.md).


rule field:
    output:
        program="results/field/chain_program.csv",
        exact="results/field/chain_exact.csv",
        evidence="results/field/chain_evidence.json",
    params:
        octave=str(ROOT / "workflow/scripts/studies/chain.m"),
        code=code("studies/field"),
    log:
        "results/logs/field.log",
    conda:
        "../../envs/vibroimpact.yaml"
    script:
        "../../scripts/studies/field.py"
