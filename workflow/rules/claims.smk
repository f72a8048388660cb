# The chapter's claims: each verdict follows from the results of the stages before.

from vibroimpact.system.chapter import CASES, PARAMETERS

CLAIMS = own("docs/claims.yaml")
# Cases whose direct integrations the claims are judged by.
CLAIMED_SIMULATIONS = ["equal", "weak"]


def claims_apply():
    """Whether the config has the chapter's parameters, which the claims are about."""
    forced = all(forces.items() <= config["cases"].get(case, {}).items() for case, forces in CASES.items())
    return forced and config["system"] == PARAMETERS


rule claims:
    input:
        **{
            f"{case}_{name.split('.')[0]}": f"results/simulations/{case}/{name}"
            for case in CLAIMED_SIMULATIONS
            for name in ("samples.csv", "events.csv", "summary.json")
        },
        claims=CLAIMS,
        fixed_points="results/fixed_points.csv",
        orbits="results/orbits.csv",
        proofs="results/proofs.json",
        verdict_grid="results/verdict_grid.csv",
        modulation="results/regimes/modulation.csv",
        special_points="results/regimes/special_points.csv",
        epsilon_orders="results/regimes/epsilon_orders.csv",
    output:
        **in_report({"json": "results/claims.json", "markdown": "results/claims.md"}, "Tables", ("json",)),
    params:
        systems=all_systems(),
        code=code("workflow/scripts/claims.py"),
    log:
        "results/logs/claims.log",
    benchmark:
        "results/benchmarks/claims.tsv"
    script:
        "../scripts/claims.py"
