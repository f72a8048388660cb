# Compare the figures of the studies with their reference set, figures/studies/.


rule study_check:
    input:
        rules.companions.input,
    params:
        figures={name: SCENES.get(name, {}) for name in STUDY_DRAWINGS},
        reference="figures/studies",
        page="results/study_check",
        strict=False,
        code=code("figure_check"),
    threads: ALL_CORES
    script:
        "../../scripts/figure_check.py"


use rule study_check as study_check_strict with:
    params:
        strict=True,
