# Prove that lists of fixed points and orbits are complete, judge stability, and measure modulation.


rule proofs:
    input:
        expand("results/orbits/{case}.search.json", case=all_systems()),
    output:
        json="results/proofs.json",
    params:
        systems=all_systems(),
        code=code("studies/proofs"),
    script:
        "../../scripts/studies/proofs.py"


# Judge stability on a grid of forcing amplitudes, by the theory and by exact orbits.
rule verdict_grid:
    output:
        **in_report({"csv": "results/verdict_grid.csv"}, "Tables"),
    params:
        system=config["system"] | {"f10_hat": 0.0, "f20_hat": 0.0},  # the grid sets the forces
        settings=config["stability"]["verdict_grid"],
        code=code("studies/verdict_grid"),
    script:
        "../../scripts/studies/verdict_grid.py"


# Compute measures of modulation and Lyapunov spectra for every case.
rule modulation:
    output:
        measures="results/regimes/modulation.csv",
        windows="results/regimes/modulation_windows.csv",
        spectra="results/regimes/spectra.csv",
    params:
        systems=all_systems(),
        settings=config["regimes"]["modulation"] | {"observation": config["regimes"]["observation"]},
        code=code("studies/modulation"),
    script:
        "../../scripts/studies/modulation.py"


# Judge the stability of the fixed points of all cases for decreasing epsilon.
rule verdicts_by_epsilon:
    output:
        csv="results/verdicts_by_epsilon.csv",
    params:
        systems=all_systems(),
        epsilon=config["stability"]["verdict_grid"]["epsilon"],
        code=code("studies/verdicts_by_epsilon"),
    script:
        "../../scripts/studies/verdicts_by_epsilon.py"


rule stability:
    input:
        rules.modulation.output,
        rules.proofs.output,
        rules.verdict_grid.output,
        rules.verdicts_by_epsilon.output,
