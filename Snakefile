# From one config to every figure of the chapter:
# config -> fixed points -> orbits -> simulations -> figures and notebooks -> accuracy -> checks.


include: "workflow/rules/common.smk"


configfile: CONFIG_FILE


check_config()
DEPARTURES = departures(config)


include: "workflow/rules/provenance.smk"
include: "workflow/rules/fixed_points.smk"
include: "workflow/rules/simulations.smk"
include: "workflow/rules/stability.smk"
include: "workflow/rules/regimes.smk"
include: "workflow/rules/companions.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/accuracy.smk"
include: "workflow/rules/checks.smk"
include: "workflow/rules/report.smk"


rule all:
    default_target: True
    input:
        rules.stability.input,
        rules.figures.input,
        rules.companions.input,
        rules.accuracy.input,
        rules.claims.output,
