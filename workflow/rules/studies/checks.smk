# The figures of the studies against their reference set, figures/studies/.

STUDY_SCENES = {name: SCENES.get(name, {}) for name in STUDY_DRAWINGS}


use rule figure_check as study_check with:
    input:
        rules.companions.input,
    params:
        figures=STUDY_SCENES,
        reference="figures/studies",
        page="results/study_check",
        strict=False,
        code=code("figure_check"),
    log:
        "results/logs/study_check.log",


use rule figure_check_strict as study_check_strict with:
    input:
        rules.companions.input,
    params:
        figures=STUDY_SCENES,
        reference="figures/studies",
        page="results/study_check",
        strict=True,
        code=code("figure_check"),
    log:
        "results/logs/study_check_strict.log",
