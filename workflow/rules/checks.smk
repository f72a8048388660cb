# The figures against the reference set in figures/, which no rule writes to: `make accept` does, with a reason.


# Has no output, so that it compares each time; it prints its result on the terminal, too.
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
    log:
        "results/logs/figure_check.log",
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/figure_check.py"


# The same where it is a failure, too, that other versions of Matplotlib keep pictures from being compared.
use rule figure_check as figure_check_strict with:
    params:
        strict=True,
    log:
        "results/logs/figure_check_strict.log",


if STUDIES:

    include: "studies/checks.smk"
