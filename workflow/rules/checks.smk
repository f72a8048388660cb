# Compare figures with the reference set in figures/. Only `make accept` changes the set, and records the reason.


# The figure check has no output file, so that it always runs. It also prints the result on the terminal.
rule figure_check:
    input:
        [getattr(rules, name).output for name in (*config["figures"], *CHARTS)],
    params:
        figures=config["figures"] | {name: {} for name in CHARTS},
        reference="figures",
        page="results/figure_check",
        strict=False,
        code=code("figure_check"),
    threads: ALL_CORES
    script:
        "../scripts/figure_check.py"


# The strict check also fails if other versions of Matplotlib make pictures incomparable.
use rule figure_check as figure_check_strict with:
    params:
        strict=True,


if STUDIES:

    include: "studies/checks.smk"
