# The chapter's claims: each verdict follows from the results of the stages before. They are about the chapter's
# parameters and lean on some settings: with others none is judged, and the files say why.

import yaml

from vibroimpact_pipeline.chapter import digest

CLAIMS = own("docs/claims.yaml")
BEHIND = yaml.safe_load((ROOT / "docs/claims.yaml").read_text(encoding="utf-8"))["judged_with"]


def seen(path):
    """Whether the config has an entry, and the one that the claims lean on."""
    try:
        return digest(config_at(path)) == BEHIND[path]
    except KeyError:
        return False


OTHERS = [] if DEPARTURES else [path for path in BEHIND if not seen(path)]
UNLIKE = DEPARTURES + [f"{path} is not the one that docs/claims.yaml knows" for path in OTHERS]
# Cases whose direct integrations the claims are judged by.
CLAIMED_SIMULATIONS = ["equal", "weak"]
EVIDENCE = {
    "fixed_points": "results/fixed_points.csv",
    "orbits": "results/orbits.csv",
    "proofs": "results/proofs.json",
    "verdict_grid": "results/verdict_grid.csv",
    "modulation": "results/regimes/modulation.csv",
    "special_points": "results/regimes/special_points.csv",
    "epsilon_orders": "results/regimes/epsilon_orders.csv",
    "absorber": "results/absorber.csv",
    "clearance": "results/sweeps/clearance.csv",
} | {
    f"{case}_{name.split('.')[0]}": f"results/simulations/{case}/{name}"
    for case in CLAIMED_SIMULATIONS
    for name in ("samples.csv", "events.csv", "summary.json")
}


rule claims:
    input:
        **({} if UNLIKE else EVIDENCE),
        claims=CLAIMS,
    output:
        **in_report({"json": "results/claims.json", "markdown": "results/claims.md"}, "Tables", ("json",)),
    params:
        systems=all_systems(),
        unlike=UNLIKE,
        code=code("workflow/scripts/claims.py"),
    log:
        "results/logs/claims.log",
    benchmark:
        "results/benchmarks/claims.tsv"
    script:
        "../scripts/claims.py"
