# Compare figures with the reference set in figures/. Only `make accept` changes the set.


# This rule has no output files, so that it always runs. If STRICT=1 is set, a figure that cannot be compared with its
# reference also counts as failed.
rule figure_check:
    input:
        [getattr(rules, name).output for name in (*config["figures"], *CHARTS)],
    params:
        figures=config["figures"] | {name: {} for name in CHARTS},
        reference="figures",
        page="results/figure_check",
        code=code("figure_check"),
    threads: ALL_CORES
    script:
        "../scripts/figure_check.py"


if STUDIES:

    # The figures of the studies have a reference set of their own.
    use rule figure_check as study_check with:
        input:
            rules.companions.input,
        params:
            figures={name: SCENES.get(name, {}) for name in STUDY_DRAWINGS},
            reference="figures/studies",
            page="results/study_check",
