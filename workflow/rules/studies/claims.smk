# Claims of the chapter, judged by the results of earlier stages. With parameters or settings other than those of
# claims.yaml, the claims that depend on them are not judged, and the page gives the reason.

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
    "equal_samples": "results/simulations/equal/float64/samples.csv",
    "equal_events": "results/simulations/equal/float64/events.csv",
    "equal_summary": "results/simulations/equal/float64/summary.json",
    "weak_samples": "results/simulations/weak/reference/samples.csv",
    "weak_events": "results/simulations/weak/reference/events.csv",
    "weak_summary": "results/simulations/weak/reference/summary.json",
}

# Results that this config does not build.
ABSENT = {
    *({"special_points"} if "companion_branches" not in MADE else ()),
    *({"epsilon_orders"} if "companion_epsilon" not in MADE else ()),
    *({"absorber"} if "companion_absorber" not in MADE else ()),
    *({"clearance"} - SWEEPS.keys()),
    *(name for name in EVIDENCE if name.startswith(("equal_", "weak_")) and name.split("_")[0] not in config["cases"]),
}


rule claims:
    input:
        **{name: path for name, path in EVIDENCE.items() if name not in ABSENT},
        claims=checkout_path("docs/studies/claims.yaml"),
    output:
        json=report("results/claims.json", category="Tables", labels={"name": "claims", "kind": "json"}),
        markdown="results/claims.md",
    params:
        config={name: config.get(name) for name in ("system", "cases", "stability", "regimes", "sweeps")},
        code=code("studies/claims", "docs/studies/claims.yaml"),
    log:
        "results/logs/claims.log",
    conda:
        "../../envs/vibroimpact.yaml"
    script:
        "../../scripts/studies/claims.py"
