# The figures against the reference set in figures/, which no rule writes to: `make accept` does, with a reason.

import time

REFERENCE_FILES = sorted(
    own(f"figures/{path.name}") for path in (ROOT / "figures").glob("*.*") if path.name != "CHANGES.md"
)


# Compares anew each time it is asked for, since the date of a file does not tell whether its content is the same.
rule compare_figures:
    input:
        rules.figures.input,
        rules.companions.input,
        reference=REFERENCE_FILES,
    output:
        page="results/figure_check/index.html",
        verdicts="results/figure_check/figure_check.json",
        summary="results/figure_check/summary.md",
    params:
        asked=time.time_ns(),
        code=code("workflow/scripts/compare_figures.py"),
    log:
        "results/logs/compare_figures.log",
    benchmark:
        "results/benchmarks/compare_figures.tsv"
    threads: ALL_CORES
    script:
        "../scripts/compare_figures.py"


# Has no output, so that it judges anew each time: the page stays to be read where it fails. No log either: what it says
# is for who has asked.
rule figure_check:
    input:
        rules.compare_figures.output.verdicts,
    script:
        "../scripts/figure_check.py"


# The same where it is a failure, too, that other versions of Matplotlib keep pixels from being compared.
use rule figure_check as figure_check_strict with:
    params:
        strict=True,
