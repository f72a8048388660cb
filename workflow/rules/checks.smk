# The figures against the reference set in figures/, which no rule writes to: `make accept` does, with a reason.


# Has no output, so that it compares anew each time; what it says is on the terminal, too.
rule figure_check:
    input:
        rules.figures.input,
        rules.companions.input,
    params:
        figures=config["figures"] | dict.fromkeys(MADE, {}),
        strict=False,
        code=PIPELINE,
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
        figures=config["figures"] | dict.fromkeys(MADE, {}),
        strict=True,
        code=PIPELINE,
    log:
        "results/logs/figure_check_strict.log",
