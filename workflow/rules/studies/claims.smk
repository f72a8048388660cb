# Judge the claims of the chapter. No claim is judged if the config has other parameters or settings than those for
# which the claims were written.

from vibroimpact_pipeline.studies.claims_config import reason_not_judged

EVIDENCE = {
    "fixed_points": "results/fixed_points.csv",
    "orbits": "results/orbits.csv",
    "proofs": "results/proofs.json",
    "verdict_grid": "results/verdict_grid.csv",
    "modulation": "results/regimes/modulation.csv",
    "special_points": "results/regimes/special_points.csv",
    "epsilon_orders": "results/regimes/epsilon_orders.csv",
    "equal_samples": "results/simulations/equal/float64/samples.csv",
    "equal_events": "results/simulations/equal/float64/events.csv",
    "equal_summary": "results/simulations/equal/float64/summary.json",
    "weak_samples": "results/simulations/weak/reference/samples.csv",
    "weak_events": "results/simulations/weak/reference/events.csv",
    "weak_summary": "results/simulations/weak/reference/summary.json",
}

NOT_JUDGED = reason_not_judged(config)


rule claims:
    input:
        **({} if NOT_JUDGED else EVIDENCE),
        claims=checkout_path("docs/studies/claims.yaml"),
    output:
        json=report("results/claims.json", category="Tables", labels={"name": "claims", "kind": "json"}),
    params:
        not_judged=NOT_JUDGED,
        code=code("studies/claims", "docs/studies/claims.yaml"),
    script:
        "../../scripts/studies/claims.py"
