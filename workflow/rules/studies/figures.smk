# Companion figures. Each has a rule of the same name and a module in src/vibroimpact/studies/figures/.

# Arguments of `compute` for each figure: `settings` of the config, named by the last key of their path (* stands for all
# settings of a section except `case`); `inputs`; the system of a `case`; the `systems` of all cases. A figure is omitted
# if the config lacks one of these entries or of `needs`.
COMPANIONS = {
    "companion_10_05": {"settings": ["stability.companion_10_05.C_range"]},
    "companion_10_08": {
        "case": "figures.fig10_08.case",
        "inputs": {
            "points": "results/fixed_points/{case}.csv",
            "samples": "results/simulations/{case}/float64/samples.csv",
            "events": "results/simulations/{case}/float64/events.csv",
        },
    },
    "companion_absorber": {
        "case": "sweeps.clearance.case",
        "settings": [
            *(f"sweeps.clearance.{name}" for name in ("band", "starts", "seed", "cycles", "settle")),
            "regimes.observation",
        ],
        "inputs": {
            "response": "results/sweeps/frequency_response.csv",
            "clearance": "results/sweeps/clearance.csv",
            "design": "results/sweeps/design.csv",
        },
    },
    "companion_asymmetric": {
        "systems": True,
        "settings": ["system.kappa", "regimes.asymmetric.*"],
        "inputs": {"orbits": "results/orbits.csv"},
    },
    "companion_basins": {
        "case": "regimes.basins.case",
        "settings": ["regimes.basins.case", "regimes.basins.points", "regimes.observation"],
    },
    "companion_branches": {
        "case": "regimes.branches.case",
        "systems": True,
        "settings": ["regimes.branches.*", "regimes.observation"],
    },
    "companion_coupling": {"systems": True, "needs": ["cases.equal"]},
    "companion_epsilon": {"systems": True, "settings": ["regimes.epsilon.*"]},
    "companion_field": {"needs": ["cases.equal"]},
    "companion_horizon": {
        "case": "figures.fig10_11.case",
        "settings": ["cases.{case}.simulation.initial_state"],
        "inputs": {"strobe": "results/simulations/{case}/reference/strobe.csv"},
        "needs": ["cases.{case}.simulation.digits"],
    },
    "companion_regime_map": {
        "case": "sweeps.regime_map.case",
        "systems": True,
        "settings": ["sweeps.regime_map.starts"],
        "inputs": {"table": "results/sweeps/regime_map.csv"},
    },
    "companion_response": {
        "case": "sweeps.frequency_response.case",
        "settings": ["sweeps.clearance.band"],
        "inputs": {
            "frequency": "results/sweeps/frequency_response.csv",
            "force": "results/sweeps/clearance.csv",
        },
    },
    "companion_stability": {"inputs": {"points": "results/fixed_points.csv"}},
}


MADE = {figure: found for figure, takes in COMPANIONS.items() if (found := companion(figure, **takes))}

for figure, found in MADE.items():

    rule:
        name:
            figure
        input:
            **found.inputs,
        output:
            **files(figure, "Companion figures", CAPTION),
        params:
            **found.params,
            code=code("figure", module_of(figure)),
        log:
            f"results/logs/figures/{figure}.log",
        benchmark:
            f"results/benchmarks/figures/{figure}.tsv"
        conda:
            "../../envs/vibroimpact.yaml"
        script:
            "../../scripts/figure.py"


# Machines in SI units, each with a page like the figures of the chapter.
SCENES |= {name: entry | {"like": "machines"} for name, entry in config["machines"].items()}

for figure in config["machines"]:

    rule:
        name:
            figure
        output:
            **files(figure, "Companion figures", CAPTION),
        params:
            **scene(figure, section="machines"),
        log:
            f"results/logs/figures/{figure}.log",
        conda:
            "../../envs/vibroimpact.yaml"
        script:
            "../../scripts/figure.py"


STUDY_PAGES = by_notebook(config["machines"])

for notebook, shown in STUDY_PAGES.items():
    pages_of, given = pages(shown)

    rule:
        name:
            f"pages_{notebook}"
        input:
            **read_by(notebook, shown),
        output:
            **pages_of,
        params:
            pages=given,
            code=code("notebook", NOTEBOOKS[notebook], *(spec(figure)["module"] for figure in shown)),
        log:
            f"results/logs/notebooks/{notebook}.log",
        conda:
            "../../envs/vibroimpact.yaml"
        script:
            "../../scripts/notebook.py"


STUDY_DRAWINGS = [*MADE, *config["machines"]]
ALL_FIGURES += STUDY_DRAWINGS
config["captions"] |= {figure: caption(figure) for figure in STUDY_DRAWINGS}


rule companions:
    input:
        [getattr(rules, figure).output for figure in STUDY_DRAWINGS],
        [getattr(rules, f"pages_{notebook}").output for notebook in STUDY_PAGES],
