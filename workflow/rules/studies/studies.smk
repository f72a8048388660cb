# The studies go beyond the chapter. To remove the studies, delete all folders and files named `studies`.


include: "stability.smk"
include: "sweeps.smk"
include: "claims.smk"
include: "report.smk"


rule studies:
    input:
        rules.companions.input,
        rules.stability.input,
        rules.claims.output,
        rules.sweeps.input,
